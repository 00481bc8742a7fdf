// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/contradictions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "trueflank/base/units.h"
#include "trueflank/design/design_keys.h"
#include "trueflank/design/design_name.h"
#include "trueflank/design/machine_contradictions.h"

namespace trueflank {
namespace {

class Contradictions {
 public:
  Contradictions(const GearboxDesign& design, bool kind_known, Reading& reading)
      : design_(design), kind_known_(kind_known), reading_(reading) {}

  void report() {
    if (reading_.good("name")) check_name();
    if (kind_known_) {
      check_kind();
      check_meshes();
    }
    check_gearbox();
    check_rack();
    for (const GearDesign& gear : design_.gears) {
      gear_ = &gear;
      check_tip_and_thinning();
      check_thickness();
      check_modifications();
      if (gear.kind == GearKind::kInternal) {
        check_bolts();
        check_halves();
        check_outer_diameter();
        check_cutter();
      } else {
        check_bore_kind();
        check_bore_size();
      }
    }
    check_bodies();
    if (design_.carrier) check_carrier();
    if (design_.machine) report_machine_contradictions(design_, kind_known_, reading_);
  }

 private:
  [[nodiscard]] std::string key(const std::string& name) const { return gear_->name + "." + name; }
  [[nodiscard]] bool good(const std::string& name) const { return reading_.good(key(name)); }
  [[nodiscard]] bool has(const std::string& name) const { return reading_.has(key(name)); }
  void wrong(const std::string& name, std::string message, std::string remedy) {
    reading_.contradiction(key(name), std::move(message), std::move(remedy));
  }

  void check_name() {
    if (!is_design_name(design_.name))
      reading_.report({.code = ErrorCode::kOutOfRange,
                       .message = "empty, too long or not printable",
                       .key = "name",
                       .remedy = "one line of 1 to 100 characters"});
  }

  void check_kind() {
    const std::string kind = "kind \"" + design_.topology.kind + "\"";
    if (!design_.topology.has_planets() && reading_.good("gearbox.planets") && design_.planets != 1)
      reading_.contradiction("gearbox.planets", kind + " has no planets", "no such key");
    if (design_.topology.meshes.empty() && reading_.good("gearbox.centre_distance_mm"))
      reading_.contradiction("gearbox.centre_distance_mm", "a single gear has no centre distance",
                             "no such key, or kind \"pair\"");
  }

  void check_gearbox() {
    if (design_.herringbone && design_.helix_angle_rad == 0.0 &&
        reading_.good("gearbox.herringbone") &&
        (!reading_.has("gearbox.helix_angle_deg") || reading_.good("gearbox.helix_angle_deg")))
      reading_.contradiction("gearbox.herringbone", "herringbone teeth need a helix angle",
                             "a helix_angle_deg other than 0, or false");
    check_groove();
    if (reading_.good("gearbox.backlash_mm") && reading_.good("gearbox.module_mm") &&
        design_.backlash_mm > design_.module_mm)
      reading_.contradiction("gearbox.backlash_mm", "more than one module",
                             "at most " + plain_mm(design_.module_mm));
  }

  void check_groove() {
    const std::string groove = "gearbox.relief_groove_mm";
    if (!reading_.good(groove) || design_.relief_groove_mm == 0.0) return;
    if (!design_.herringbone) {
      if (!reading_.has("gearbox.herringbone") || reading_.good("gearbox.herringbone"))
        reading_.contradiction(groove, "a groove between halves, and the teeth are no herringbone",
                               "herringbone = true, or no such key");
      return;
    }
    for (const GearDesign& gear : design_.gears)
      if (reading_.good(gear.name + ".face_width_mm") &&
          design_.relief_groove_mm >= gear.face_width_mm)
        return reading_.contradiction(groove, "leaves " + gear.name + " no teeth",
                                      "less than its face width, " + plain_mm(gear.face_width_mm));
  }

  void check_rack() {
    const BasicRack& rack = design_.rack;
    const auto at = [&](const char* name) {  // a named rack may have the value
      return reading_.has(std::string("rack.") + name) ? std::string("rack.") + name
                                                       : std::string("rack.profile");
    };
    if (rack.grinding_stock > 0.0 && !(rack.grinding_stock < rack.protuberance) &&
        reading_.good(at("grinding_stock")))
      reading_.contradiction(at("grinding_stock"),
                             "not less than the protuberance: grinding would leave a step",
                             "a stock below protuberance, or 0");
    if (!(rack.protuberance > 0.0) || !reading_.good(at("protuberance"))) return;
    if (!(rack.protuberance_angle_rad < rack.pressure_angle_rad))
      reading_.contradiction(at("protuberance_angle_deg"), "not below the pressure angle",
                             "a smaller protuberance_angle_deg");
    const auto ring = [](const GearDesign& gear) { return gear.kind == GearKind::kInternal; };
    if (!design_.gears.empty() && std::all_of(design_.gears.begin(), design_.gears.end(), ring))
      reading_.contradiction(at("protuberance"), "there is no external gear: a rack cuts no rings",
                             "a rack without protuberance");
  }

  void check_thickness() {
    const bool series = has("thickness_allowance"), upper = has("thickness_upper_um"),
               lower = has("thickness_lower_um");
    if (!series && !upper && !lower) return;
    if (has("thinning_um"))
      wrong("thinning_um", "the tooth thickness is given twice", "thinning_um or an allowance");
    if (series && (upper || lower))
      wrong("thickness_allowance", "the allowance is given twice", "a series or numbers");
    else if (upper != lower)
      wrong(upper ? "thickness_upper_um" : "thickness_lower_um", "the other allowance is missing",
            "both thickness_upper_um and thickness_lower_um");
    else if (good("thickness_upper_um") && good("thickness_lower_um") &&
             gear_->thickness->lower_mm > gear_->thickness->upper_mm)
      wrong("thickness_lower_um", "above the upper allowance", "at most thickness_upper_um");
  }

  [[nodiscard]] std::optional<double> module_mm(const GearDesign& gear) const {
    const std::string own = gear.name + ".module_mm";
    if (reading_.has(own)) return reading_.good(own) ? gear.module_mm : std::nullopt;
    for (const char* shared : {"gearbox.module_mm", "stage2.module_mm"})
      if (reading_.has(shared) && !reading_.good(shared)) return std::nullopt;
    if (!reading_.has("gearbox.module_mm")) return std::nullopt;
    return module_of(design_, gear);
  }

  void check_mesh(const std::string& name1, const std::string& name2) {
    const GearDesign *gear1 = find_gear(design_, name1), *gear2 = find_gear(design_, name2);
    if (!gear1 || !gear2) return;
    gear_ = gear2;
    const auto module1 = module_mm(*gear1), module2 = module_mm(*gear2);
    if (module1 && module2 && *module1 != *module2) {
      const std::string differ = name1 + " and " + name2 +
                                 " mesh, but their modules are " + plain_mm(*module1) + " and " +
                                 plain_mm(*module2);
      const GearDesign& own = gear2->module_mm ? *gear2 : *gear1;
      reading_.contradiction(own.name + ".module_mm", differ, "one module for gears that mesh");
    }
    if (gear2->kind == GearKind::kInternal && reading_.good(gear1->name + ".teeth") &&
        good("teeth") && gear2->teeth <= gear1->teeth)
      wrong("teeth", "not more than the " + std::to_string(gear1->teeth) + " of " + name1,
            "more than " + std::to_string(gear1->teeth));
  }

  void check_meshes() {
    const Topology& topology = design_.topology;
    for (const TopologyMesh& mesh : topology.meshes)
      check_mesh(topology.gears[static_cast<std::size_t>(mesh.gear1)].name,
                 topology.gears[static_cast<std::size_t>(mesh.gear2)].name);
  }

  /// Root circle as designed, external or ring; nothing where a value is missing or wrong.
  [[nodiscard]] std::optional<double> root_diameter_mm() const {
    const auto module = module_mm(*gear_);
    if (!module || !good("teeth") || !good("shift")) return std::nullopt;
    for (const char* of_others : {"gearbox.helix_angle_deg", "rack.dedendum"})
      if (reading_.has(of_others) && !reading_.good(of_others)) return std::nullopt;
    const double d = gear_->teeth * *module / std::cos(design_.helix_angle_rad);
    const double sign = gear_->kind == GearKind::kInternal ? 1.0 : -1.0;
    return d + 2.0 * *module * (sign * design_.rack.dedendum + *gear_->shift);
  }

  void check_tip_and_thinning() {
    const auto module = module_mm(*gear_);
    if (good("thinning_um") && module && *gear_->thinning_mm > *module)
      wrong("thinning_um", "more than one module",
            "at most " + plain_number(*module * 1e3) + " um");
    const auto root = root_diameter_mm();
    if (!good("tip_diameter_mm") || !root) return;
    const double tip = *gear_->tip_diameter_mm;
    if (gear_->kind == GearKind::kExternal ? tip <= *root : tip >= *root)
      wrong("tip_diameter_mm", "on the wrong side of the root circle",
            (gear_->kind == GearKind::kExternal ? "more than " : "less than ") + plain_mm(*root));
  }

  /// An amount and the measure that places it need each other.
  void check_relief(const std::string& amount, const std::string& place, const std::string& shape,
                    double amount_um, const std::string& remedy) {
    const std::string table = "modifications.";
    if (good(table + amount) && amount_um > 0.0 && !has(table + place))
      reading_.missing(key(table + place), "missing, and " + amount + " needs it", remedy);
    if (good(table + place) && !has(table + amount))
      wrong(table + place, "without " + amount, amount + " beside it, or neither");
    if (good(table + shape) && !has(table + amount))
      wrong(table + shape, "without " + amount, amount + " beside it, or neither");
  }

  /// A relief starts on the tooth.
  void check_start(const std::string& name, double start_mm) {
    const std::string relief_key = "modifications." + name;
    if (!good(relief_key) || !good("tip_diameter_mm")) return;
    const double tip = *gear_->tip_diameter_mm;
    if (gear_->kind == GearKind::kExternal ? start_mm >= tip : start_mm <= tip)
      wrong(relief_key, "beyond the tip circle",
            (gear_->kind == GearKind::kExternal ? "less than " : "more than ") + plain_mm(tip));
  }

  void check_modifications() {
    const ModificationsDesign& m = gear_->modifications;
    check_relief("tip_relief_um", "tip_relief_start_diameter_mm", "tip_relief_shape",
                 m.tip_relief_um, "the diameter at which the tip relief starts");
    check_relief("root_relief_um", "root_relief_start_diameter_mm", "root_relief_shape",
                 m.root_relief_um, "the diameter at which the root relief starts");
    check_relief("end_relief_um", "end_relief_length_mm", "end_relief_shape", m.end_relief_um,
                 "how far the end relief reaches in from the end faces");
    check_start("tip_relief_start_diameter_mm", m.tip_relief_start_diameter_mm);
    check_start("root_relief_start_diameter_mm", m.root_relief_start_diameter_mm);
    if (!good("face_width_mm")) return;
    if (good("modifications.edge_chamfer_mm") && 2.0 * m.edge_chamfer_mm >= gear_->face_width_mm)
      wrong("modifications.edge_chamfer_mm", "leaves nothing of the face width",
            "less than " + plain_mm(0.5 * gear_->face_width_mm));
    if (good("modifications.end_relief_length_mm") &&
        2.0 * m.end_relief_length_mm > gear_->face_width_mm)
      wrong("modifications.end_relief_length_mm", "more than half the face width",
            "at most " + plain_mm(0.5 * gear_->face_width_mm));
  }

  void check_bore_kind() {
    const bool round = has("bore_mm"), hex = has("bore_hex_mm"), flat = has("bore_d_flat_mm");
    const bool width = has("bore_keyway_width_mm"), depth = has("bore_keyway_depth_mm");
    if (hex && round) wrong("bore_hex_mm", "a second bore beside bore_mm", "one of the two");
    for (const char* name : {"bore_keyway_width_mm", "bore_keyway_depth_mm", "bore_d_flat_mm"}) {
      if (!has(name)) continue;
      if (hex)
        wrong(name, "not for a hexagon", "one of the two");
      else if (!round)
        wrong(name, "needs a bore", "bore_mm beside it");
    }
    if (flat && (width || depth))
      wrong("bore_d_flat_mm", "a flat beside a keyway", "one of the two");
    if (width != depth) {
      const char* there = width ? "bore_keyway_width_mm" : "bore_keyway_depth_mm";
      const char* absent = width ? "bore_keyway_depth_mm" : "bore_keyway_width_mm";
      reading_.missing(key(absent), std::string("missing, and ") + there + " needs it",
                       "both, or neither");
    }
  }

  void check_bore_size() {
    const BoreDesign& bore = gear_->bore;
    const double d = bore.diameter_mm;
    if (good("bore_mm")) {
      if (good("bore_d_flat_mm") && (bore.d_flat_mm >= d || bore.d_flat_mm <= 0.5 * d))
        wrong("bore_d_flat_mm", "no flat of this bore",
              "more than " + plain_mm(0.5 * d) + " and less than " + plain_mm(d));
      if (good("bore_keyway_width_mm") && bore.keyway_width_mm >= d)
        wrong("bore_keyway_width_mm", "not narrower than the bore", "less than " + plain_mm(d));
    }
    const auto root = root_diameter_mm();
    const char* name = bore.kind == BoreKind::kHex ? "bore_hex_mm" : "bore_mm";
    if (!root || !good(name)) return;
    // the farthest point of the bore from the axis
    double reach = 0.5 * d;
    if (bore.kind == BoreKind::kHex) reach = d / std::sqrt(3.0);
    if (bore.kind == BoreKind::kKeyway && good("bore_keyway_width_mm") &&
        good("bore_keyway_depth_mm"))
      reach = std::hypot(reach + bore.keyway_depth_mm, 0.5 * bore.keyway_width_mm);
    if (2.0 * reach >= *root)
      wrong(name, "cuts through the root circle, which has " + plain_mm(*root),
            "a bore that stays inside the root circle");
  }

  /// What belongs to a whole body may be said again for its later gears, but not otherwise.
  void check_bodies() {
    const Topology& topology = design_.topology;
    if (!kind_known_) return;
    for (std::size_t i = 0; i < topology.gears.size(); ++i) {
      const GearDesign* first =
          find_gear(design_, topology.gears[static_cast<std::size_t>(
                                 topology.first_gear_of(topology.gears[i].member))].name);
      const GearDesign* later = find_gear(design_, topology.gears[i].name);
      if (!first || !later || first == later) continue;
      gear_ = later;
      const std::string body = topology.name_of(topology.gears[i].member);
      if (later->bore != BoreDesign{} && later->bore != first->bore) check_bore_of_body(*first, body);
      if (!later->material.empty() && later->material != first->material)
        wrong("material", "differs from " + first->name + "'s, and both are one body",
              "the material given in [" + first->name + "] alone");
    }
  }

  void check_bore_of_body(const GearDesign& first, const std::string& body) {
    for (const auto& bore_key : gear_keys())
      if (std::string_view(bore_key.rule.name).starts_with("bore_") && good(bore_key.rule.name))
        return wrong(bore_key.rule.name,
                     "differs from " + first.name + "'s bore, which goes through the " + body,
                     "the bore given in [" + first.name + "] alone");
  }

  void check_bolts() {
    const std::vector<std::string> names{"bolt_circle_diameter_mm", "bolt_count",
                                         "bolt_hole_diameter_mm"};
    const auto is_given = [&](const std::string& name) { return has(name); };
    const auto is_good = [&](const std::string& name) { return good(name); };
    const auto given = std::count_if(names.begin(), names.end(), is_given);
    if (given == 0) return;
    for (const std::string& name : names)
      if (!has(name))
        reading_.missing(key(name), "missing, and the bolt circle needs it",
                         "all of " + names[0] + ", " + names[1] + ", " + names[2]);
    if (given == 3 && std::all_of(names.begin(), names.end(), is_good)) check_bolt_places();
  }

  void check_bolt_places() {
    const BoltCircleDesign& bolts = gear_->bolt_circle;
    const double spacing = bolts.circle_diameter_mm * std::sin(kPi / bolts.count);
    if (bolts.count > 1 && spacing <= bolts.hole_diameter_mm)
      wrong("bolt_hole_diameter_mm", "makes the holes run into each other",
            "less than " + plain_mm(spacing));
    if (good("outer_diameter_mm") &&
        bolts.circle_diameter_mm + bolts.hole_diameter_mm >= *gear_->outer_diameter_mm)
      wrong("bolt_circle_diameter_mm", "puts the holes through the outer diameter",
            "less than " + plain_mm(*gear_->outer_diameter_mm - bolts.hole_diameter_mm));
    const auto root = root_diameter_mm();
    if (root && bolts.circle_diameter_mm - bolts.hole_diameter_mm <= *root)
      wrong("bolt_circle_diameter_mm", "puts the holes into the teeth",
            "more than " + plain_mm(*root + bolts.hole_diameter_mm));
  }

  void check_halves() {
    if (gear_->halves.value_or(false) && !design_.herringbone && good("halves"))
      wrong("halves", "halves part at the apex of herringbone teeth, and these teeth have none",
            "herringbone = true, or no such key");
    if (gear_->halves.value_or(false) && design_.herringbone && design_.machine && good("halves") &&
        !is_made_in_halves(design_, *gear_))
      wrong("halves", "the ring that drives out is one part with its cup in a [housing]",
            "no such key, or no [housing]");
  }

  void check_outer_diameter() {
    const auto root = root_diameter_mm();
    if (root && good("outer_diameter_mm") && *gear_->outer_diameter_mm <= *root)
      wrong("outer_diameter_mm", "leaves no rim around the root circle", "more than " + plain_mm(*root));
  }

  void check_cutter() {
    if (has("root") && !good("root")) return;
    const bool shaper = gear_->root == RingRoot::kShaper;
    if (shaper && !has("cutter"))
      reading_.missing(key("cutter"), "missing, and root = \"shaper\" needs it",
                       "a table [" + key("cutter") + "] with teeth, shift, tip_radius");
    // an explicit root = "fillet" lets the cutter rest
    if (!has("root") && gear_->cutter)
      wrong("cutter", "a cutter without root = \"shaper\"",
            "root = \"shaper\" in [" + gear_->name + "], or no cutter");
    if (gear_->cutter && good("cutter.teeth") && good("teeth") &&
        gear_->cutter->teeth >= gear_->teeth)
      wrong("cutter.teeth", "not fewer than the ring's " + std::to_string(gear_->teeth),
            "fewer than " + std::to_string(gear_->teeth));
  }

  void check_carrier() {
    const CarrierDesign& carrier = *design_.carrier;
    if (kind_known_ && !design_.topology.has_planets()) {
      const std::string& kind = design_.topology.kind;
      reading_.contradiction("carrier", "kind \"" + kind + "\" has no planets to carry",
                             "leave out [carrier]");
      return;
    }
    const bool has_diameter = reading_.has("carrier.bearing_diameter_mm");
    if (has_diameter != reading_.has("carrier.bearing_width_mm"))
      reading_.missing(has_diameter ? "carrier.bearing_width_mm" : "carrier.bearing_diameter_mm",
                       "the seat of a bearing needs both its diameter and its width",
                       "bearing_diameter_mm and bearing_width_mm, or neither");
    if (reading_.good("carrier.bearing_width_mm") && reading_.good("carrier.plate_thickness_mm") &&
        carrier.bearing_width_mm >= carrier.plate_thickness_mm)
      reading_.contradiction("carrier.bearing_width_mm", "the seat goes through the carrier's plate",
                             "less than " + plain_mm(carrier.plate_thickness_mm));
    check_pins(carrier);
  }

  /// The gears whose bores the pins go through, where their tables are there.
  void check_pins(const CarrierDesign& carrier) {
    const Topology& topology = design_.topology;
    for (std::size_t m = 0; m < topology.members.size(); ++m) {
      if (!topology.is_planet(static_cast<int>(m))) continue;
      const int gear = topology.first_gear_of(static_cast<int>(m));
      check_pin(carrier, find_gear(design_, topology.gears[static_cast<std::size_t>(gear)].name));
    }
  }

  void check_pin(const CarrierDesign& carrier, const GearDesign* planet) {
    if (!planet) return;
    const std::string bore = planet->name + ".bore_mm";
    if (!reading_.has(bore) && !(planet->bore.diameter_mm > 0.0)) {
      if (!reading_.has(planet->name + ".bore_hex_mm"))
        reading_.missing(bore, "the carrier's pins need a bore in " + planet->name,
                         "bore_mm in [" + planet->name + "], or no [carrier]");
    } else if (reading_.good(bore) && reading_.good("carrier.pin_diameter_mm") &&
               *carrier.pin_diameter_mm >= planet->bore.diameter_mm) {
      reading_.contradiction("carrier.pin_diameter_mm",
                             "the pin is not thinner than the planet's bore",
                             "less than " + plain_mm(planet->bore.diameter_mm));
    }
  }

  const GearboxDesign& design_;
  bool kind_known_;
  Reading& reading_;
  const GearDesign* gear_ = nullptr;
};

}  // namespace

void report_contradictions(const GearboxDesign& design, bool kind_known, Reading& reading) {
  Contradictions(design, kind_known, reading).report();
}

}  // namespace trueflank

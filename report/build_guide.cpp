// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/report/build_guide.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/base/contract.h"
#include "trueflank/base/tolerance.h"
#include "trueflank/check/quantity_text.h"
#include "trueflank/train/machine/set_screw.h"

namespace trueflank::io {
namespace {

enum class Kind {
  kInsert,
  kScrew,
  kBearing,
  kPin,
  kPillar,
  kPlanet,
  kSun,
  kFixedRing,
  kMotor,
  kOther
};

/// "carrier_top" -> "carrier top"
std::string words(std::string name) {
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}
/// the lid, but ring1 without an article
std::string the(const std::string& name) {
  const bool numbered = !name.empty() && is_digit(name.back());
  return (numbered ? "" : "the ") + name;
}
std::string counted(std::size_t count, const std::string& one, const std::string& many) {
  return count == 1 ? the(one) : std::to_string(count) + " " + many;
}
/// "6 x heat-set insert M3x5.7"
std::string ordered(std::size_t count, const std::string& what) {
  return count == 1 ? "the " + what : std::to_string(count) + " x " + what;
}

class Writer {
 public:
  Writer(const GearTrain& train, const PartShapes& shapes, const AssemblyOrder& order)
      : train_(train), shapes_(shapes), order_(order), machine_(*train.design.machine) {}

  BuildGuide write() {
    std::vector<bool> done(order_.units.size(), false);
    for (std::size_t i = 0; i < order_.units.size(); ++i) {
      if (done[i]) continue;
      int copies = 1;
      for (std::size_t j = i + 1; j < order_.units.size(); ++j)
        if (!done[j] && order_.units[j].name == order_.units[i].name) {
          done[j] = true;
          ++copies;
        }
      add_section(order_.units[i], copies);
    }
    return std::move(guide_);
  }

 private:
  [[nodiscard]] const PartShape& part(std::size_t body) const {
    return shapes_.parts[static_cast<std::size_t>(shapes_.assembly[body].part)];
  }
  [[nodiscard]] bool is_held(int member) const {
    const auto& fixed = train_.topology().fixed;
    return std::find(fixed.begin(), fixed.end(), member) != fixed.end();
  }
  [[nodiscard]] Kind kind_of(std::size_t body) const {
    const PartShape& p = part(body);
    if (p.name.starts_with("insert_")) return Kind::kInsert;
    if (p.name.starts_with("screw_")) return Kind::kScrew;
    if (p.name.starts_with("bearing_")) return Kind::kBearing;
    if (p.name.starts_with("pin_")) return Kind::kPin;
    if (p.name.starts_with("motor_")) return Kind::kMotor;
    if (p.name.ends_with("_pillar")) return Kind::kPillar;
    if (p.role == PartRole::kPlanet) return Kind::kPlanet;
    if (p.role == PartRole::kSun) return Kind::kSun;
    if ((p.role == PartRole::kRing || p.role == PartRole::kUpperRing) && is_held(p.member))
      return Kind::kFixedRing;
    return Kind::kOther;
  }

  void add_section(const AssemblyUnit& unit, int copies) {
    const bool last = &unit == &order_.units.back();
    GuideSection section{.title = last ? "The gearbox" : capitalised(words(unit.name)),
                         .copies = copies,
                         .steps = {}};
    if (copies > 1) section.title += " (make " + std::to_string(copies) + ")";
    std::vector<std::size_t> there;
    std::vector<GuideNeed> taken;  // what the others are put on
    for (std::size_t i = 0; i < unit.steps.size();) {
      std::size_t end = i + 1;  // kin, one after the other, is one step for a person
      while (end < unit.steps.size() && is_kin(unit.steps[i], unit.steps[end])) ++end;
      GuideStep step{.title = "", .there = there, .from = unit.steps[i].from};
      for (std::size_t k = i; k < end; ++k) {
        step.added.insert(step.added.end(), unit.steps[k].bodies.begin(),
                          unit.steps[k].bodies.end());
        add_needs(unit.steps[k], taken);
      }
      there.insert(there.end(), step.added.begin(), step.added.end());
      if (i > 0) {
        step.needs = std::move(taken);
        taken.clear();
        describe(unit, unit.steps[i], end - i, step);
        if (!step.tool.empty() &&
            std::count(guide_.tools.begin(), guide_.tools.end(), step.tool) == 0)
          guide_.tools.push_back(step.tool);
        section.steps.push_back(std::move(step));
      }
      i = end;
    }
    guide_.sections.push_back(std::move(section));
  }

  [[nodiscard]] const std::string& name_of(const AssemblyStep& step) const {
    return step.unit < 0 ? part(step.bodies.front()).name
                         : order_.units[static_cast<std::size_t>(step.unit)].name;
  }
  [[nodiscard]] bool is_kin(const AssemblyStep& a, const AssemblyStep& b) const {
    const bool planets = is_planet(a) && is_planet(b);
    return a.from == b.from && (name_of(a) == name_of(b) || planets);
  }
  [[nodiscard]] bool is_planet(const AssemblyStep& step) const {
    return name_of(step).starts_with("planet");
  }

  void add_needs(const AssemblyStep& step, std::vector<GuideNeed>& needs) const {
    const auto add = [&](const std::string& name, int count, bool made) {
      for (GuideNeed& need : needs)
        if (need.name == name) {
          need.count += count;
          return;
        }
      needs.push_back({name, count, made});
    };
    if (step.unit >= 0) return add(name_of(step) + ", as put together", 1, true);
    for (const std::size_t body : step.bodies)
      add(part(body).bought.empty() ? part(body).name : part(body).bought, 1,
          part(body).bought.empty());
  }

  // ------------------------------------------------------------------------------ words

  void describe(const AssemblyUnit& unit, const AssemblyStep& first, std::size_t items,
                GuideStep& step) const {
    const std::size_t body = first.bodies.front();
    const PartShape& p = part(body);
    const std::size_t count = first.unit >= 0 ? items : step.added.size();
    const std::string base =
        words(part(unit.steps.front().bodies.front()).bought.empty() ? name_of(unit.steps.front())
                                                                     : "motor");
    if (first.unit >= 0 && !is_planet(first)) return describe_unit(first, step);
    switch (kind_of(body)) {
      case Kind::kInsert:
        return describe_inserts(p, count, base, step);
      case Kind::kScrew:
        return describe_screws(p, count, step);
      case Kind::kBearing:
        return describe_bearing(p, count, base, step);
      case Kind::kPin:
        step.title =
            "Put " + counted(count, "pin", "pins") + " into the blind holes of the " + base;
        step.lines = {
            "Push each one down to the bottom of its hole. They cannot come out once the plate on "
            "top is on."};
        step.tool = "soft hammer or vice";
        return;
      case Kind::kPillar:
        step.title = "Stand " + counted(count, "pillar", "pillars") + " over the screw holes";
        step.lines = {"The holes of the pillars are in line with those of the plate under them."};
        return;
      case Kind::kPlanet:
        return describe_planets(count, step);
      case Kind::kSun:
        return describe_sun(p, step);
      case Kind::kFixedRing:
        step.title = "Lay " + the(p.name) + " into its seat";
        step.lines = {
            "Turn it until its holes are in line with the inserts of the housing: the screws of "
            "the lid go through it."};
        return;
      case Kind::kMotor:
        step.title = "Set the motor against the housing";
        return;
      case Kind::kOther:
        break;
    }
    step.title = "Put " + counted(count, words(p.name), words(p.name) + "s") + " on";
    if (p.name == "journal")
      step.lines = {"Its screw holes are in line with the inserts below it."};
    else if (p.name == "housing")
      step.lines = {
          "The collar of the motor goes into the hole of the floor; turn the housing until the "
          "holes for the motor's screws are in line."};
    else if (p.name == "lid")
      step.lines = {
          train_.topology().has_planets()
              ? "Turn it until its screw holes are in line with those of the ring and the housing."
              : "Its rim goes into the housing; its screw holes are in line with the housing's."};
    else if (p.name == "retainer")
      step.lines = {
          "It holds the outer ring of the bearing; its holes are in line with the inserts of the "
          "lid."};
    else if (p.name == "output")
      step.lines = {
          "Its holes for screws are in line with those of the journal; it clamps the inner ring of "
          "the bearing."};
  }

  void describe_inserts(const PartShape& p, std::size_t count, const std::string& base,
                        GuideStep& step) const {
    step.title = "Press " + ordered(count, p.bought) + " into " + the(base);
    step.lines = {
        "From the side that is shown on top, with the iron at the melting temperature of the "
        "plastic, until each one is flush or a little below the face. Let it cool before a screw "
        "pulls at it."};
    step.tool = "soldering iron with a tip for inserts";
  }

  void describe_screws(const PartShape& p, std::size_t count, GuideStep& step) const {
    const std::string what = p.name.substr(p.name.rfind('_') + 1);
    const FastenersDesign& f = machine_.fasteners;
    const Screw& screw = what == "motor"     ? f.motor
                         : what == "housing" ? f.housing
                         : what == "carrier" ? f.carrier
                                             : f.output;
    step.title = "Put in " + counted(count, "screw", "screws") + " " + p.bought;
    step.lines = {
        "Turn all of them in by hand first, then tighten them crosswise, in two rounds. In plastic "
        "stop when the head sits."};
    if (what == "motor")
      step.lines.push_back(machine_.motor.thread_depth_mm > 0.0
                               ? "They go into the threads of the motor."
                               : "They go through the motor's flange: hold a nut " + screw.name +
                                     " against it for each one.");
    step.tool = "hex key of " + number_text(screw.hex_mm, 1) + " mm";
  }

  static void describe_bearing(const PartShape& p, std::size_t count, const std::string& base,
                               GuideStep& step) {
    step.title = "Press " + ordered(count, p.bought) + " into " + the(base);
    step.lines = {"Push on the outer ring only, straight, until it stands on its shoulder."};
    step.tool = "tube as wide as the bearing's outer ring";
  }

  void describe_sun(const PartShape& p, GuideStep& step) const {
    step.title = "Slide " + the(words(p.name)) + " on the shaft of the motor";
    step.lines = {machine_.motor.flat_mm > 0.0
                      ? "The flat of its bore lies on the flat of the shaft."
                      : "The shaft is round: fix it with retaining compound."};
    add_filed_flat(step);
    add_set_screw(step);
    if (p.member != train_.topology().input) {
      step.title = "Put the " + words(p.name) + " between the planets";
      step.lines = {"It idles: it keeps the planets apart."};
    }
  }

  /// The motor of this name comes with a round shaft, the design's has a flat.
  void add_filed_flat(GuideStep& step) const {
    const Motor& motor = machine_.motor;
    const Motor* bought = find_element(standard_elements().motors, motor.name);
    if (!bought || bought->flat_mm > 0.0 || !(motor.flat_mm > 0.0)) return;
    step.lines.push_back("The motor comes with a round shaft: first file a flat on it, " +
                         number_text(motor.flat_length_mm, 1) + " mm long from its end, " +
                         number_text(motor.flat_mm, 1) +
                         " mm from the flat to the far side. Keep the chips out of the motor.");
  }

  /// Of the gear on the motor's shaft.
  void add_set_screw(GuideStep& step) const {
    const auto layout = machine_layout(train_);
    if (!layout || !layout->set_screw.is_there()) return;
    const auto& screw = layout->set_screw;
    if (!screw.on_flat) step.lines.clear();
    step.lines.push_back(set_screw_operation(*layout));
    if (screw.nut)
      step.lines.push_back("Slide the nut into its pocket from the motor's side. The hub stands " +
                           number_text(layout->hub.lower_mm - layout->floor.lower_mm, 1) +
                           " mm above the motor's face.");
    step.lines.push_back("Tighten the set screw now: the housing goes over the gear next.");
    for (const std::string& item : bought_for_set_screw(screw))
      step.needs.push_back({item, 1, false});
    step.tool = "drill of " +
                number_text(screw.nut ? screw.drill_mm
                                      : screw.screw.diameter_mm - screw.screw.diameter_mm / 6.0,
                            1) +
                (screw.nut ? " mm, " : " mm, tap, ") + "hex key of " +
                number_text(set_screw_key_mm(screw), 1) + " mm";
  }

  void describe_unit(const AssemblyStep& first, GuideStep& step) const {
    const std::string name = words(name_of(first));
    step.title = "Put " + the(name) + " on";
    if (name == "housing") step.title += " the motor";
    if (name == input_name()) add_filed_flat(step);
    const bool teeth = std::any_of(first.bodies.begin(), first.bodies.end(), [&](std::size_t body) {
      const PartRole role = part(body).role;
      return role == PartRole::kSun || role == PartRole::kPlanet || role == PartRole::kRing ||
             role == PartRole::kUpperRing;
    });
    if (teeth) {
      step.lines = {"Grease the teeth. Lower it without force and turn it, or the " + input_name() +
                    ", a little to and fro until all teeth stand in their gaps."};
      if (first.from == 0.0)
        step.lines = {
            "Herringbone teeth do not slide into each other along the axis: bring it to the " +
            input_name() +
            " from the side, and grease the teeth. Keep them together from "
            "here on."};
      if (is_helical()) step.lines.push_back("The teeth are helical: it turns as it goes in.");
      if (has_planet(first)) add_index(step);
    } else if (name == "housing" || name == "lid" || name == "output" || name.ends_with("top")) {
      step.lines = {"Turn it until its screw holes are in line with those below."};
    }
  }
  [[nodiscard]] std::string input_name() const {
    return train_.topology().has_planets() ? "sun"
                                           : train_.topology().name_of(train_.topology().input);
  }
  [[nodiscard]] bool has_planet(const AssemblyStep& step) const {
    return std::any_of(step.bodies.begin(), step.bodies.end(),
                       [&](std::size_t body) { return part(body).role == PartRole::kPlanet; });
  }
  [[nodiscard]] bool is_helical() const {
    return std::any_of(train_.gears.begin(), train_.gears.end(),
                       [](const TrainGear& gear) { return gear.twist.turn_rad_per_mm != 0.0; });
  }
  [[nodiscard]] bool is_compound() const {
    return train_.topology().gears_of(train_.topology().first_planet()).size() > 1;
  }

  void describe_planets(std::size_t count, GuideStep& step) const {
    step.title = "Put " + counted(count, "planet", "planets") + " on their pins";
    if (count == 1) step.title = "Put the planet on its pin";
    if (step.from == 0.0) {
      step.title = "Put the planets round the sun";
      step.lines = {
          "Herringbone teeth do not slide into each other along the axis: bring each planet "
          "to the sun from the side, and grease the teeth. Keep them together from here on."};
      return;
    }
    step.lines = {"They turn freely on their pins."};
  }

  /// Whether the planets that are put in have holes beside their bore in a face.
  [[nodiscard]] bool is_marked(const GuideStep& step) const {
    return std::any_of(step.added.begin(), step.added.end(), [&](std::size_t body) {
      const PartShape& planet = part(body);
      return planet.role == PartRole::kPlanet &&
             std::any_of(planet.slabs.begin(), planet.slabs.end(), [](const Slab& slab) {
               return std::any_of(slab.holes.begin(), slab.holes.end(), [](const Outline& hole) {
                 const CircleOutline* circle = std::get_if<CircleOutline>(&hole);
                 return circle && circle->centre.norm() > tolerance::kTouch_mm;
               });
             });
    });
  }

  /// How compound planets stand against each other: only so do all their teeth find gaps.
  void add_index(GuideStep& step) const {
    if (!is_compound()) return;
    const bool alike = train_.assembly.identical_planets;
    std::string line =
        alike ? "All planets are alike, yet it matters how each one is turned. "
              : "The planets differ: each has as many small holes in its face as its number. ";
    const int gear = train_.topology().first_gear_of(train_.topology().first_planet());
    const bool marked = is_marked(step);
    if (alike && marked)
      line += "Each has a small hole in its face, in line with a tooth of " +
              train_.gear(gear).name + ".";
    else
      line += "Mark one tooth of " + train_.gear(gear).name +
              " on every planet, on all of them the same one" +
              (alike ? " as seen from the teeth of the other gear" : ", the one beside the holes") +
              ".";
    line += std::string(
                " Seen from the output's side, against the line from the middle of the gearbox "
                "outwards through the planet, counter-clockwise, ") +
            (alike && marked ? "the hole" : "it") + " stands at ";
    const auto& positions = train_.phases.positions_rad(train_.topology().first_planet());
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double turned =
          train_.phases.rotation_rad(train_.topology().first_planet(), i) - positions[i];
      const double seen = way() > 0.0 ? turned : -turned;
      line += (i == 0                      ? ""
               : i + 1 == positions.size() ? " and "
                                           : ", ") +
              number_text(deg_from_rad(wrapped_rad(seen)), 1) + " deg (planet " +
              std::to_string(i + 1) + ")";
    }
    line += "; the planets stand at ";
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double at = way() > 0.0 ? positions[i] : -positions[i];
      line += (i == 0                      ? ""
               : i + 1 == positions.size() ? " and "
                                           : ", ") +
              number_text(deg_from_rad(wrapped_rad(at)), 1);
    }
    step.lines.push_back(line + " deg.");
  }

  /// +1 where the output is above the motor in the assembly's z.
  [[nodiscard]] double way() const {
    const auto height = [&](const char* name) {
      for (const Placement& body : shapes_.assembly)
        if (shapes_.parts[static_cast<std::size_t>(body.part)].name.starts_with(name))
          return body.translation_mm[2];
      return 0.0;
    };
    return height("output") >= height("motor_") ? 1.0 : -1.0;
  }

  const GearTrain& train_;
  const PartShapes& shapes_;
  const AssemblyOrder& order_;
  const MachineDesign& machine_;
  BuildGuide guide_;
};

}  // namespace

BuildGuide build_guide(const GearTrain& train, const PartShapes& shapes,
                       const AssemblyOrder& order) {
  TRUEFLANK_EXPECTS(train.design.machine.has_value() && order.exists());
  return Writer(train, shapes, order).write();
}

}  // namespace trueflank::io

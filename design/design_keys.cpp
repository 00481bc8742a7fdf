// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_keys.h"

#include <algorithm>
#include <deque>

#include "trueflank/base/units.h"
#include "trueflank/design/file_units.h"
#include "trueflank/design/key_values.h"
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

using namespace key_values;

/// A text for the tables, which hold plain pointers: made once, kept for good.
const char* kept(std::string text) {
  static std::deque<std::string> texts;
  return texts.emplace_back(std::move(text)).c_str();
}

/// "3k: sun, two rings and compound planets; simple: ..."
const char* of_every_kind(const char* head, const char* TrainKind::*meaning) {
  std::string text = head;
  const char* separator = "";
  for (const TrainKind& kind : train_kinds()) {
    if (*(kind.*meaning) == '\0') continue;
    text += separator + std::string(kind.name) + ": " + kind.*meaning;
    separator = "; ";
  }
  return kept(std::move(text));
}

std::vector<const char*> kind_choices() {
  std::vector<const char*> names;
  for (const TrainKind& kind : train_kinds()) names.push_back(kind.name);
  return names;
}

/// Members of all kinds, each once.
std::vector<const char*> member_choices(std::vector<std::string> TrainKind::*members) {
  std::vector<const char*> names;
  for (const TrainKind& kind : train_kinds())
    for (const std::string& member : kind.*members)
      if (std::find(names.begin(), names.end(), member) == names.end()) names.push_back(member.c_str());
  return names;
}

/// "simple: "carrier"; pair: "wheel"": of kinds whose output may be left out.
const char* usual_outputs() {
  std::string text;
  for (const TrainKind& kind : train_kinds())
    if (!kind.output_required && !kind.outputs.empty())
      text += (text.empty() ? "" : "; ") + std::string(kind.name) + ": \"" + kind.outputs.front() + '"';
  return kept(std::move(text));
}

/// "number of planets, of kinds 3k and simple".
const char* planets_meaning() {
  std::vector<std::string> kinds;
  for (const TrainKind& kind : train_kinds())
    if (train_topology(kind.name).has_planets()) kinds.emplace_back(kind.name);
  std::string text = "number of planets, of kinds ";
  for (std::size_t i = 0; i < kinds.size(); ++i)
    text += (i == 0 ? "" : i + 1 == kinds.size() ? " and " : ", ") + kinds[i];
  return kept(std::move(text));
}

/// Kind, output and input stand for a topology: the reader makes it of all three.
template <class Target>
void taken_by_the_reader(Target&, const KeyValue&) {}

}  // namespace

GearKind usual_kind(const std::string& gear_name) {
  return gear_name.starts_with("ring") ? GearKind::kInternal : GearKind::kExternal;
}

bool may_be_ring(const std::string& gear_name) {
  return gear_name == "wheel" || gear_name == "gear";
}

bool stands_in(KeyPlace place, const std::string& gear_name, GearKind kind) {
  switch (place) {
    case KeyPlace::kExternalGear: return kind == GearKind::kExternal;
    case KeyPlace::kRing: return kind == GearKind::kInternal;
    case KeyPlace::kMaybeRing: return may_be_ring(gear_name);
    default: return true;
  }
}

const std::vector<DesignKey<GearboxDesign>>& file_keys() {
  static const std::vector<DesignKey<GearboxDesign>> keys{
      {{.name = "format", .type = KeyType::kWhole, .lower = 1, .upper = 1, .required = true,
        .meaning = "version of this format"},
       KeyPlace::kAnywhere,
       [](GearboxDesign&, const KeyValue&) {},
       [](const GearboxDesign&) { return whole_value(kDesignFormat); }},
      {{.name = "name", .type = KeyType::kText, .by_default = "the file's name",
        .meaning = "name of the design in reports, at most 100 characters"},
       KeyPlace::kAnywhere,
       [](GearboxDesign& d, const KeyValue& v) { d.name = text(v); },
       [](const GearboxDesign& d) { return d.name.empty() ? Value() : Value(d.name); }},
      {{.name = "tools", .type = KeyType::kText, .by_default = "none",
        .meaning = "TOML file with racks, cutters and processes of one's own ([made](made.md)); a "
                   "relative path starts at this file"},
       KeyPlace::kAnywhere,
       [](GearboxDesign& d, const KeyValue& v) { d.tools_file = text(v); },
       [](const GearboxDesign& d) { return d.tools_file.empty() ? Value() : Value(d.tools_file); }},
  };
  return keys;
}

const std::vector<DesignKey<GearboxDesign>>& gearbox_keys() {
  using D = GearboxDesign;
  static const std::vector<DesignKey<D>> keys{
      {{.name = "kind", .type = KeyType::kChoice, .choices = kind_choices(), .required = true,
        .meaning = of_every_kind("", &TrainKind::meaning)},
       KeyPlace::kAnywhere,
       taken_by_the_reader<D>,
       [](const D& d) { return Value(d.topology.kind); }},
      {{.name = "output", .type = KeyType::kChoice, .choices = member_choices(&TrainKind::outputs),
        .required = true, .by_default = usual_outputs(),
        .meaning = of_every_kind("member that drives out. ", &TrainKind::output_meaning)},
       KeyPlace::kOutput,
       taken_by_the_reader<D>,
       [](const D& d) {
         return d.topology.has_planets() ? Value(d.topology.name_of(d.topology.output)) : Value();
       }},
      {{.name = "input", .type = KeyType::kChoice, .choices = member_choices(&TrainKind::inputs),
        .by_default = "the sun, the pinion",
        .meaning = of_every_kind("member that drives in. ", &TrainKind::input_meaning)},
       KeyPlace::kAnywhere,
       taken_by_the_reader<D>,
       [](const D& d) {
         const TrainKind* kind = find_train_kind(d.topology.kind);
         const std::string input = d.topology.name_of(d.topology.input);
         return kind && !kind->inputs.empty() && input != kind->inputs.front() ? Value(input) : Value();
       }},
      {{.name = "planets", .type = KeyType::kWhole, .lower = 1, .upper = 50, .required = true,
        .meaning = planets_meaning()},
       KeyPlace::kPlanetary,
       [](D& d, const KeyValue& v) { d.planets = whole(v); },
       [](const D& d) { return d.topology.has_planets() ? whole_value(d.planets) : Value(); }},
      {{.name = "module_mm", .unit = "mm", .lower = 0.01, .upper = 100, .required = true,
        .meaning = "module of every gear that does not set its own; with a helix the normal "
                   "module"},
       KeyPlace::kUnlessEveryGear,
       [](D& d, const KeyValue& v) { d.module_mm = number(v); },
       [](const D& d) { return Value(d.module_mm); }},
      {{.name = "centre_distance_mm", .unit = "mm", .lower = 0.01, .upper = 100000,
        .by_default = "from the shifts",
        .meaning = "distance of the axes; shifts that are omitted are solved from it for zero "
                   "backlash"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.centre_distance_mm = number(v); },
       [](const D& d) { return if_given(d.centre_distance_mm); }},
      {{.name = "friction", .lower = 0, .upper = 1, .by_default = "0.1",
        .meaning = "coefficient of friction of the tooth flanks, for the efficiency"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.friction = number(v); },
       [](const D& d) { return Value(d.friction); }},
      {{.name = "backlash_mm", .unit = "mm", .lower = 0, .upper = 100, .by_default = "0",
        .meaning = "circumferential backlash of every mesh at its working pitch circle, made by "
                   "thinning the teeth of both gears alike; at most one module"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.backlash_mm = number(v); },
       [](const D& d) { return Value(d.backlash_mm); }},
      {{.name = "tips", .type = KeyType::kChoice, .choices = {"clear", "standard"},
        .by_default = "\"clear\"",
        .meaning = "clear: a tip that would reach into its mate's root fillet ends short of it by 0.03 "
                   "module of the line of action, and the report says by how much; standard: the tip "
                   "circles of the book. A tip_diameter_mm that is given is kept"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) {
         d.tips = text(v) == "standard" ? TipCircles::kStandard : TipCircles::kClear;
       },
       [](const D& d) {
         return d.tips == TipCircles::kStandard ? Value(std::string("standard")) : Value();
       }},
      {{.name = "corner_contact_limit_um", .unit = "um", .lower = 0, .upper = 10000,
        .by_default = "5 um per mm of module",
        .meaning = "how far a tip corner or fillet may touch ahead of the driving flanks before the check "
                   "corner_contact fails"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.corner_contact_limit_mm = mm_from_um(number(v)); },
       [](const D& d) {
         return d.corner_contact_limit_mm ? Value(file_um(*d.corner_contact_limit_mm)) : Value();
       }},
      {{.name = "layer_gap_mm", .unit = "mm", .lower = 0, .upper = 1000, .by_default = "1",
        .meaning = "3k, stepped: axial gap between planet1 (z = 0 to its face width) and planet2 above it; "
                   "two-stage: between the stages, with the plates of their carriers"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.layer_gap_mm = number(v); },
       [](const D& d) { return unless(d.layer_gap_mm, D{}.layer_gap_mm); }},
      {{.name = "helix_angle_deg", .unit = "deg", .lower = -60, .upper = 60, .by_default = "0",
        .meaning = "helix angle of the sun, the pinion or the gear, right hand positive; the mates "
                   "follow"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.helix_angle_rad = rad_from_deg(number(v)); },
       [](const D& d) { return unless(file_deg(d.helix_angle_rad), 0.0); }},
      {{.name = "material", .type = KeyType::kText, .by_default = "\"scm440-hb280\"",
        .meaning = "material of every gear that does not set its own, for strength and inertia: "
                   "docs/strength.md lists them, --materials FILE adds to them"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.material = text(v); },
       [](const D& d) { return d.material.empty() ? Value() : Value(d.material); }},
      {{.name = "herringbone", .type = KeyType::kFlag, .by_default = "false",
        .meaning = "two halves of opposite hands; needs a helix angle"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.herringbone = std::get<bool>(v); },
       [](const D& d) { return d.herringbone ? Value(true) : Value(); }},
      {{.name = "relief_groove_mm", .unit = "mm", .lower = 0, .upper = 1000, .by_default = "0",
        .meaning = "herringbone: width of the groove between the halves, at mid face of every gear; "
                   "less than the face width"},
       KeyPlace::kAnywhere,
       [](D& d, const KeyValue& v) { d.relief_groove_mm = number(v); },
       [](const D& d) { return unless(d.relief_groove_mm, 0.0); }},
  };
  return keys;
}

const std::vector<DesignKey<StageDesign>>& stage_keys() {
  using S = StageDesign;
  static const std::vector<DesignKey<S>> keys{
      {{.name = "planets", .type = KeyType::kWhole, .lower = 1, .upper = 50, .required = true,
        .meaning = "number of planets of the stage"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.planets = whole(v); },
       [](const S& s) { return whole_value(s.planets); }},
      {{.name = "module_mm", .unit = "mm", .lower = 0.01, .upper = 100, .by_default = "the gearbox's",
        .meaning = "module of every gear of the stage that does not set its own"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.module_mm = number(v); },
       [](const S& s) { return if_given(s.module_mm); }},
      {{.name = "centre_distance_mm", .unit = "mm", .lower = 0.01, .upper = 100000,
        .by_default = "from the shifts",
        .meaning = "distance of the stage's axes; that of `[gearbox]` is of stage 1"},
       KeyPlace::kAnywhere,
       [](S& s, const KeyValue& v) { s.centre_distance_mm = number(v); },
       [](const S& s) { return if_given(s.centre_distance_mm); }},
  };
  return keys;
}

const std::vector<DesignKey<BasicRack>>& rack_keys() {
  using R = BasicRack;
  static const std::vector<DesignKey<R>> keys{
      {{.name = "profile", .type = KeyType::kText, .by_default = "\"ISO53-A\"",
        .meaning = "a rack by its name ([made](made.md)); the keys below change single values of it"},
       KeyPlace::kAnywhere,
       [](R&, const KeyValue&) {},  // the reader has taken the rack's values before the other keys
       [](const R&) { return Value(); }},
      {{.name = "pressure_angle_deg", .unit = "deg", .lower = 5, .upper = 44, .by_default = "20",
        .meaning = "pressure angle, in the normal section"},
       KeyPlace::kAnywhere,
       [](R& r, const KeyValue& v) { r.pressure_angle_rad = rad_from_deg(number(v)); },
       [](const R& r) { return Value(file_deg(r.pressure_angle_rad)); }},
      {{.name = "addendum", .unit = "module", .lower = 0.05, .upper = 3, .by_default = "1",
        .meaning = "height of the tooth above the reference circle"},
       KeyPlace::kAnywhere,
       [](R& r, const KeyValue& v) { r.addendum = number(v); },
       [](const R& r) { return Value(r.addendum); }},
      {{.name = "dedendum", .unit = "module", .lower = 0.05, .upper = 3, .by_default = "1.25",
        .meaning = "depth of the gap below the reference circle"},
       KeyPlace::kAnywhere,
       [](R& r, const KeyValue& v) { r.dedendum = number(v); },
       [](const R& r) { return Value(r.dedendum); }},
      {{.name = "root_radius", .unit = "module", .lower = 0, .upper = 3, .by_default = "0.38",
        .meaning = "rounding of the cutting rack's tips in its normal section (a ring's root fillet: "
                   "in the transverse section); 0 is the sharp rack; one that does not fit is "
                   "reduced to the full round and reported"},
       KeyPlace::kAnywhere,
       [](R& r, const KeyValue& v) { r.root_radius = number(v); },
       [](const R& r) { return Value(r.root_radius); }},
      {{.name = "protuberance", .unit = "module", .lower = 0, .upper = 1, .by_default = "0",
        .meaning = "how far the tip corners of the cutting rack stand out of its flanks, normal to "
                   "them; external gears only"},
       KeyPlace::kAnywhere,
       [](R& r, const KeyValue& v) { r.protuberance = number(v); },
       [](const R& r) { return unless(r.protuberance, 0.0); }},
      {{.name = "protuberance_angle_deg", .unit = "deg", .lower = 1, .upper = 49,
        .by_default = "10", .meaning = "pressure angle of the protuberance's sides"},
       KeyPlace::kAnywhere,
       [](R& r, const KeyValue& v) { r.protuberance_angle_rad = rad_from_deg(number(v)); },
       [](const R& r) {
         return r.protuberance > 0.0 ? Value(file_deg(r.protuberance_angle_rad)) : Value();
       }},
      {{.name = "grinding_stock", .unit = "module", .lower = 0, .upper = 1, .by_default = "0",
        .meaning = "what the tool leaves on each flank for grinding, normal to it; the teeth are "
                   "reported and made as ground; less than the protuberance"},
       KeyPlace::kAnywhere,
       [](R& r, const KeyValue& v) { r.grinding_stock = number(v); },
       [](const R& r) { return unless(r.grinding_stock, 0.0); }},
  };
  return keys;
}

}  // namespace trueflank

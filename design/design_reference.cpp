// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/design/design_reference.h"

#include "trueflank/design/design_keys.h"
#include "trueflank/design/kinds/train_kind.h"

namespace trueflank {
namespace {

constexpr const char* kIntroduction = R"(# The design file

<!-- Made from the tables in design/*_keys.cpp; tests/design keeps the two equal.
     After a change there: TRUEFLANK_UPDATE=1 ctest --preset dev -R DesignReference -->

A gearbox is described in one [TOML](https://toml.io) file of UTF-8 text. Lengths are in
millimetres, small ones in micrometres, angles in degrees; every key with a unit says it in its
name. Keys without a unit are pure numbers or multiples of the module. Every key that ends in `_mm`
may be given as `_in`, in inches, and `diametral_pitch` (teeth per inch) for `module_mm`; the table
of `trueflank check`, `report.json` (`inches`) and `report.html` then tell sizes in both.

```toml
format = 1
name = "first-gear"

[gearbox]
kind = "gear"
module_mm = 1.0

[gear]
teeth = 20
face_width_mm = 8
bore_mm = 5
```

`trueflank check FILE` reads it and reports **all** errors at once: file, line, key, the value found
and what would be right. Unknown keys are errors, so a misspelt one is never passed over; the
nearest known key is named. Nothing is repaired silently. Whole numbers are taken where numbers are
wanted; `nan` and `inf` never are. Ranges are wide: they keep out slips (a misplaced decimal point,
a forgotten unit), not odd gears. Whether such teeth exist and mesh is not for the reader but for
the checks ([checks](checks.md)).

Examples to start from, each with comments: `examples/*/design.toml`.
)";

constexpr const char* kRules = R"(
## What must agree

- `output` fits the kind; `planets` and `centre_distance_mm` stand only where there are planets or a
  mesh. `friction`, `backlash_mm` and `layer_gap_mm` say nothing about a single gear and are let be.
- Gears that mesh have one module; the layers of compound planets may differ. A ring has more teeth than the
  gear in it and than its cutter.
- A keyway needs `bore_mm` and both its width and depth; a flat needs `bore_mm` and lies between its
  half and whole; `bore_hex_mm` stands alone. The bore stays inside the root circle. planet1's bore
  goes through the whole planet: `[planet2]` has none of its own, or the same.
- The three keys of a bolt circle stand together; holes do not run into each other, into the teeth
  or through the outer diameter.
- `root = "shaper"` and `[<ring>.cutter]` need each other; with an explicit `root = "fillet"` the
  cutter rests.
- `tip_relief_um` above 0 and `tip_relief_start_diameter_mm` need each other; so do `root_relief_um`
  and its start, `end_relief_um` and its length. Starts lie on the involute. Modifications add; they
  may not remove the tip land or lean a flank by more than 0.2
  ([modifications](theory/modifications.md)).
- `relief_groove_mm` stands with herringbone teeth only and is less than every face width.
  Herringbone gears in mesh have one face width, so that their apexes meet.
- `[<ring>.cutter]` needs `teeth` or `name`.
- `thickness_allowance`, or `thickness_upper_um` with `thickness_lower_um` not above it, stands
  instead of `thinning_um`. The series of DIN 3967 are a, ab, b, bc, c, cd, d, e, f, g, h with a
  number from 21 to 30, for reference diameters up to 10 m.
- A protuberance needs an external gear and an angle below the pressure angle; a `grinding_stock`
  needs a protuberance larger than itself.
- A rack whose depth depends on the module (`AGMA-fine-pitch`) needs one module for all gears.
- `[carrier]` needs planets with a round bore that is larger than its pins;
  `bearing_diameter_mm` and `bearing_width_mm` need each other, and the seat is less deep than the
  plate.
- `[motor]`, `[output]`, `[bearings]` and `[fasteners]` stand beside `[housing]`; `[motor]` has a name
  or its shaft and screw circle. With them no ring has an `outer_diameter_mm` or bolts of its own and
  the carrier no seat: they follow from the housing. A sun without a bore gets one for the motor's
  shaft, a planet without one gets that of its bearings.
- Bore, bolt and rim keys are compared with the root circle where `shift` is given; where it is
  solved, `check` and `make` say it.

## What the text may be

At most 1 MiB of UTF-8. Letters beyond ASCII may stand in strings and comments, not in bare keys.
A key is given once. A wrong file of any sort ends the program with exit code 2, a file that is
missing or not readable with 3.
)";

std::string type_of(const KeyRule& rule) {
  std::string text = wanted(rule);
  if (rule.type == KeyType::kText) text = "text";
  return text;
}

std::string default_of(const KeyRule& rule, KeyPlace place) {
  const std::string given = rule.by_default;
  if (!rule.required) return given;
  if (place == KeyPlace::kPlanetary) return "**needed** where there are planets";
  if (place == KeyPlace::kUnlessEveryGear) return "**needed** unless every gear has its own";
  return given.empty() ? "**needed**" : "**needed**; " + given;
}

const char* place_note(KeyPlace place) {
  switch (place) {
    case KeyPlace::kExternalGear: return "External gears: ";
    case KeyPlace::kRing: return "Rings: ";
    case KeyPlace::kMaybeRing: return "`wheel`, `gear`: ";
    default: return "";
  }
}

template <class Target>
void describe(std::string& text, const std::string& title, const std::string& introduction,
              const std::vector<DesignKey<Target>>& keys) {
  text += "\n## " + title + "\n\n" + introduction;
  if (!introduction.empty()) text += "\n\n";
  text += "| key | value | default | meaning |\n| --- | --- | --- | --- |\n";
  for (const DesignKey<Target>& key : keys)
    text += "| `" + std::string(key.rule.name) + "` | " + type_of(key.rule) + " | " +
            default_of(key.rule, key.place) + " | " + place_note(key.place) + key.rule.meaning +
            " |\n";
}

std::string gears_of_kinds() {
  std::string text =
      "\n## Gears of each kind\n\n"
      "| `kind` | tables of its gears | meshes |\n| --- | --- | --- |\n";
  for (const TrainKind& kind : train_kinds()) {
    const Topology topology = train_topology(kind.name);
    text += "| `" + std::string(kind.name) + "` |";
    for (const TopologyGear& gear : topology.gears) text += " `[" + gear.name + "]`";
    text += " |";
    for (const TopologyMesh& mesh : topology.meshes) text += " `" + topology.mesh_name(mesh) + "`";
    text += " |\n";
  }
  return text +
         "\nAll gears of the kind must be there, and no others; only `[sun]` of a 3k with "
         "`input = \"carrier\"` may be\nleft out. planet1 and planet2 are one body, but in a two-stage: there sun2 is "
         "one body with the carrier of stage 1.\n";
}

}  // namespace

std::string design_reference() {
  std::string text = kIntroduction + gears_of_kinds();
  describe(text, "Top of the file", "", file_keys());
  describe(text, "`[gearbox]`", "", gearbox_keys());
  describe(text, "`[stage2]`",
           "Of kind two-stage, and needed there: what its second stage has of its own. All else is the "
           "gearbox's.",
           stage_keys());
  describe(text, "`[rack]`",
           "The basic rack that all gears share; ISO 53 profile A where nothing is said. The table "
           "may be\nleft out.",
           rack_keys());
  describe(text, "A gear: `[sun]`, `[planet1]`, `[ring1]`, ...",
           "Rings are `ring`, `ring1`, `ring2`, and a `wheel` or `gear` with `internal = true`; "
           "all others are\nexternal gears.",
           gear_keys());
  describe(text, "`[<ring>.cutter]`",
           "The pinion cutter that shapes a ring with `root = \"shaper\"`. Its tip circle is such "
           "that the ring's\nroot circle comes out as r + m (dedendum + x).",
           cutter_keys());
  describe(text, "`[<gear>.modifications]`", "Of any gear; all may be left out.",
           modification_keys());
  describe(text, "`[carrier]`",
           "Of kinds with planets; without this table no carrier is built. Two plates, `carrier` "
           "below the\nplanets and `carrier_top` above them, held by the pins `carrier_pin` on which "
           "the planets turn. A two-stage has `carrier1` and `carrier2`, both of these sizes; the upper plate of "
           "carrier1 is one body with sun2.",
           carrier_keys());
  describe(text, "`[housing]`",
           "Makes a gearbox of the gears ([gearbox](gearbox.md)); the four tables below stand only beside "
           "it.",
           housing_keys());
  describe(text, "`[motor]`", "The motor that is screwed to the housing.", motor_keys());
  describe(text, "`[output]`", "What the gearbox drives; may be left out.", output_keys());
  describe(text, "`[bearings]`", "Ball bearings by their names.", bearings_keys());
  describe(text, "`[fasteners]`", "Socket head screws with heat-set inserts; may be left out.",
           fasteners_keys());
  describe(text, "`[shafts]`",
           "What hangs on the shafts besides, for the inertia that either shaft feels "
           "([efficiency](efficiency.md)).",
           shafts_keys());
  describe(text, "`[made]`", "How the parts are made ([made](made.md)); may be left out.", made_keys());
  describe(text, "`[losses]`",
           "What a bench found beside the friction of the meshes ([the loop on the drive](drive-loop.md) "
           "writes it);\nwithout this table the efficiency is that of the meshes alone. Torques are at the "
           "input.",
           losses_keys());
  describe(text, "`[strength]`",
           "What the allowable torque assumes ([strength](strength.md)); may be left out. The factors and "
           "`reversing`\nare keys of a requirements file too.",
           strength_keys());
  return text + kRules;
}

}  // namespace trueflank

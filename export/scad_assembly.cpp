// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/scad_text.h"
#include "trueflank/export/scad_writer.h"
#include "trueflank/export/scene.h"

namespace trueflank::io {
namespace {

/// Turns of a body about its own axis, and of its axis about the sun's, per turn of the sun.
struct BodySpeeds {
  double own = 0.0, orbit = 0.0;
};

BodySpeeds speeds_of(const GearTrain& train, const std::string& body) {
  const MemberSpeeds speeds = member_speeds(train);
  if (body == "sun" || body == "pinion" || body == "gear") return {speeds.sun, 0.0};
  // the carrier's bodies turn with their places
  if (body.starts_with("carrier")) return {0.0, speeds.carrier};
  if (body.starts_with("planet")) return {speeds.planet - speeds.carrier, speeds.carrier};
  return {body == "ring2" ? speeds.ring2 : speeds.ring1, 0.0};
}

std::string assembly_text(const GearTrain& train, const PartShapes& shapes) {
  std::string text = "// " + one_line(train.design.name) +
                     " in mesh, written by Trueflank; uses the files of the parts beside it.\n"
                     "// Preview (F5) is quick; View > Animate turns it.\n\n"
                     "/* [View] */\n// turn of the sun (pinion)\nturn = 0; // [0:1:3600]\n"
                     "// distance between the layers\nexplode = 0; // [0:1:100]\nshow = \"all\"; // [all";
  for (const PartShape& part : shapes.parts) text += ", " + part.name;
  text += "]\n\n";
  for (const PartShape& part : shapes.parts) text += "use <" + part.name + ".scad>\n";
  text += "\nangle = turn + 360*$t;\n"
          "module body(part, orbit, place, rotation, shift)\n"
          "  if (show == \"all\" || show == part)\n"
          "    rotate(orbit*angle) translate(place + [0, 0, shift*explode]) rotate(rotation) children();\n\n";
  for (const Placement& body : shapes.assembly) {
    const std::string& part = shapes.parts[body.part].name;
    const BodySpeeds speeds = speeds_of(train, body.name);
    const auto& move = body.translation_mm;
    const std::string rotation = degrees(centred_rad(body.rotation_rad));
    const bool upper = move[2] > 0.0;
    const int layer = part.starts_with("planet") ? 1 : upper ? 2 : part.starts_with("sun") ? 3 : 0;
    text += "color(\"" + hex_text(part_colour(part)) + "\") body(\"" + part + "\", " +
            number(speeds.orbit) + ", " +
            list(number(move[0]), number(move[1]), number(move[2])) + ",\n  " +
            rotation + " + " + number(speeds.own) + "*angle, " +
            std::to_string(layer) + ") " + part + "();  // " + body.name + "\n";
  }
  return text;
}

}  // namespace

Status write_scad_assembly(const std::filesystem::path& path, const GearTrain& train,
                           const PartShapes& shapes) {
  return write_file(path, assembly_text(train, shapes));
}

}  // namespace trueflank::io

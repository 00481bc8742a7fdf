// SPDX-License-Identifier: GPL-3.0-or-later
#include <string>

#include "trueflank/export/atomic_file.h"
#include "trueflank/export/scad/scad_text.h"
#include "trueflank/export/scad/scad_writer.h"
#include "trueflank/export/scene.h"

namespace trueflank::io {
namespace {

/// What the slider turns.
std::string input_text(const GearTrain& train) {
  const Topology& topology = train.topology();
  return topology.is_carrier(topology.input) ? topology.name_of(topology.input) : "sun (pinion)";
}

std::string assembly_text(const GearTrain& train, const PartShapes& shapes) {
  std::string text = "// " + one_line(train.design.name) +
                     " in mesh, written by Trueflank; uses the files of the parts beside it.\n"
                     "// Preview (F5) is quick; View > Animate turns it.\n\n"
                     "/* [View] */\n// turn of the " + input_text(train) + "\nturn = 0; // [0:1:3600]\n"
                     "// distance between the layers\nexplode = 0; // [0:1:100]\nshow = \"all\"; // [all";
  for (const PartShape& part : shapes.parts) text += ", " + part.name;
  text += "]\n\n";
  for (const PartShape& part : shapes.parts) text += "use <" + part.name + ".scad>\n";
  text += "\nangle = turn + 360*$t;\n"
          "module body(part, orbit, place, rotation, shift, axis = [0, 0, 0])\n"
          "  if (show == \"all\" || show == part)\n"
          "    translate(axis) rotate(orbit*angle) translate(place - axis + [0, 0, shift*explode]) "
          "rotate(rotation) children();\n\n";
  for (const Placement& body : shapes.assembly) {
    const std::string& part = shapes.parts[body.part].name;
    const PartShape& shape = shapes.parts[body.part];
    // about its own axis a body turns by what it turns more than that goes round
    BodyMotion motion = motion_of(train, shape.member);
    // what is screwed to a body goes round with it
    std::string axis;
    if (!shape.bought.empty() && shape.member != kNoMember && motion.orbit == 0.0) {
      motion.orbit = motion.turn;
      if (const Point2 at = axis_centre_mm(train, train.phases, shape.member); at.norm() > 0.0)
        axis = ", axis = " + list(number(at.x()), number(at.y()), number(0.0));
    }
    const auto& move = body.translation_mm;
    const std::string rotation = degrees(centred_rad(body.rotation_rad));
    const bool upper = move[2] > 0.0;
    const bool sun = shape.role == PartRole::kSun && train.topology().has_planets();
    const int layer = shape.role == PartRole::kPlanet ? 1 : upper ? 2 : sun ? 3 : 0;
    text += "color(\"" + hex_text(part_colour(shape.role)) + "\") body(\"" + part + "\", " +
            number(motion.orbit) + ", " +
            list(number(move[0]), number(move[1]), number(move[2])) + ",\n  " +
            rotation + " + " + number(motion.turn - motion.orbit) + "*angle, " +
            std::to_string(layer) + axis + ") " + part + "();  // " + body.name + "\n";
  }
  return text;
}

}  // namespace

Status write_scad_assembly(const std::filesystem::path& path, const GearTrain& train,
                           const PartShapes& shapes) {
  return write_file(path, assembly_text(train, shapes));
}

}  // namespace trueflank::io

// SPDX-License-Identifier: GPL-3.0-or-later
// assembly.scad of a gearbox: what is screwed to a part goes round with it.
#include <gtest/gtest.h>
#include <regex.h>

#include <array>
#include <cstdlib>
#include <fstream>

#include "tests/check/machine_designs.h"
#include "tests/support/scratch_folder.h"
#include "trueflank/export/scad/scad_writer.h"

namespace trueflank {
namespace {

struct Line {
  double orbit = 0.0, spin = 0.0;
  std::string axis;
};

/// The line of a body, by its name in the comment.
Line line_of(const Made& made, const std::string& body) {
  const test::ScratchFolder folder;
  const auto path = folder / "assembly.scad";
  EXPECT_TRUE(io::write_scad_assembly(path, made.train, made.shapes));
  std::ifstream file(path);
  const std::string text((std::istreambuf_iterator<char>(file)), {});
  const std::string pattern = "body\\(\"[^\"]*\", ([-0-9.e]+), [^\n]*\n[^+\n]* [+] ([-0-9.e]+)[*]angle, "
                              "[0-9]+(, axis = [^)]*)?\\)[^\n]*// " + body + "\n";
  // of the C library: that of C++ compiles for seconds
  regex_t compiled;
  if (regcomp(&compiled, pattern.c_str(), REG_EXTENDED) != 0) throw std::runtime_error("no pattern: " + pattern);
  std::array<regmatch_t, 4> match{};
  const int found = regexec(&compiled, text.c_str(), match.size(), match.data(), 0);
  regfree(&compiled);
  if (found != 0) throw std::runtime_error("no line of " + body);
  const auto part = [&](const regmatch_t& m) {
    return m.rm_so < 0 ? std::string() : text.substr(m.rm_so, m.rm_eo - m.rm_so);
  };
  return {std::stod(part(match[1])), std::stod(part(match[2])), part(match[3])};
}

TEST(ScadAssembly, ScrewsGoRoundWithWhatTheyAreIn) {
  const Made made(k3k + kMachine);
  const Line output = line_of(made, "output"), screw = line_of(made, "screw_m3x20_output 1");
  EXPECT_NE(output.spin, 0.0);
  EXPECT_EQ(output.orbit, 0.0);
  EXPECT_EQ(screw.orbit, output.spin);
  EXPECT_EQ(screw.spin, 0.0);
  EXPECT_EQ(line_of(made, "screw_m3x6_motor 1").orbit, 0.0);
}

TEST(ScadAssembly, ScrewsOfAWheelGoRoundItsAxis) {
  const Made made(kPair + kBox);
  std::string screw;
  for (const Placement& body : made.shapes.assembly)
    if (body.name.starts_with("screw_") && body.name.ends_with("_output 1")) screw = body.name;
  const Line line = line_of(made, screw);
  EXPECT_EQ(line.orbit, line_of(made, "output").spin);
  EXPECT_EQ(line.spin, 0.0);
  EXPECT_EQ(line.axis, ", axis = [39, 0, 0]");
}

}  // namespace
}  // namespace trueflank

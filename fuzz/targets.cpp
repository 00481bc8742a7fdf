// SPDX-License-Identifier: GPL-3.0-or-later
#include "fuzz/targets.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>

#include "trueflank/design/design_file.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/requirements_file.h"
#include "trueflank/design/tools_file.h"
#include "trueflank/export/mesh_reader.h"
#include "trueflank/loop/gear/correction.h"
#include "trueflank/loop/gear/correction_bounds.h"
#include "trueflank/loop/gear/formula.h"
#include "trueflank/loop/measured/bench_data.h"
#include "trueflank/loop/measured/read_measurement.h"
#include "trueflank/search/search.h"
#include "trueflank/session/effects_file.h"
#include "trueflank/train/gear_train.h"

namespace trueflank::fuzz {
namespace {

/// Ends the program as a fuzzer expects it.
void demand(bool holds) {
  if (!holds) std::abort();
}

void design(std::string_view bytes) {
  const auto file = read_design_file_text(bytes, "design.toml");
  if (!file) {
    demand(!file.error().empty());
    return;
  }
  // what was read is written, and read as the same
  const auto design = read_design_text(bytes, "design.toml");
  const auto again = read_design_text(design_file_text(*design), "design.toml");
  demand(again.has_value());
}
void requirements(std::string_view bytes) { (void)read_requirements_text(bytes, "search.toml"); }
void materials(std::string_view bytes) { (void)read_materials_text(bytes, "materials.toml"); }
void tools(std::string_view bytes) { (void)read_tools_text(bytes, "tools.toml"); }

/// Every index is of a vertex, whoever reads the file.
void mesh(std::string_view bytes, std::string_view extension) {
  const auto check = [](const TriangleMesh& mesh) {
    for (const auto& t : mesh.triangles)
      demand(std::all_of(t.begin(), t.end(), [&](auto v) { return v < mesh.vertices.size(); }));
  };
  if (const auto bodies = io::parse_bodies(bytes, extension))
    for (const io::MeshBody& body : *bodies) {
      check(body.mesh);
      for (const auto& v : body.mesh.vertices)
        demand(std::isfinite(v[0]) && std::isfinite(v[1]) && std::isfinite(v[2]));
    }
  if (const auto scan = io::parse_scan(bytes, extension)) check(scan->mesh);
}
void stl(std::string_view bytes) { mesh(bytes, ".stl"); }
void obj(std::string_view bytes) { mesh(bytes, ".obj"); }
void ply(std::string_view bytes) { mesh(bytes, ".ply"); }
void glb(std::string_view bytes) { mesh(bytes, ".glb"); }
void threemf(std::string_view bytes) { mesh(bytes, ".3mf"); }

template <auto Read>
void measured(std::string_view bytes) {
  std::vector<std::string> notes;
  (void)Read("data", bytes, notes);
}
void bench(std::string_view bytes) {
  loop::BenchData data;
  (void)loop::read_bench_text("bench.csv", bytes, data);
}

/// A gear that every loop.json is taken to be of.
const loop::FlankGeometry& some_gear() {
  static const loop::FlankGeometry geometry = [] {
    const auto design = read_design_text(
        "format = 1\nname = \"g\"\n[gearbox]\nkind = \"gear\"\nmodule_mm = 1.0\n"
        "[gear]\nteeth = 12\nshift = 0.3\nface_width_mm = 4.0\n",
        "gear.toml");
    static const GearTrain train = lay_out(*design).value();
    return loop::FlankGeometry(train.gears.front());
  }();
  return geometry;
}
void loop_json(std::string_view bytes) {
  (void)loop::Correction::gear_of(bytes);
  const auto correction = loop::Correction::make(bytes, some_gear());
  if (!correction || !loop::within_bounds(*correction)) return;
  const auto u = correction->displacement_mm({6.0, 0.5, 2.0});
  demand(std::isfinite(u[0]) && std::isfinite(u[1]) && std::isfinite(u[2]));
}
void formula(std::string_view bytes) {
  const auto formula = loop::Formula::make(std::string(bytes), {"x", "y"});
  const double values[] = {0.5, -2.0};
  if (formula) (void)(*formula)(values);
}

void effects(std::string_view bytes) {
  const auto families = read_effects_text(bytes, "effects.toml");
  if (families)
    demand(!(*families)->empty());
  else
    demand(!families.error().empty());
}

void journal(std::string_view bytes) {
  static const SearchRequirements requirements;
  static const SetEnumeration sets = [] {
    SetEnumeration some;
    some.sets = std::vector<ToothSet>(5);
    return some;
  }();
  // a fuzzer does not find the digest of the header
  const std::string text = journal_header(requirements, sets) + "\n" + std::string(bytes);
  if (const auto journal = read_journal(text, requirements, sets))
    for (const SearchRecord& record : journal->records) demand(record.index < sets.sets.size());
}

}  // namespace

const std::vector<Target>& targets() {
  static const std::vector<Target> all = {
      {"design", design},
      {"requirements", requirements},
      {"materials", materials},
      {"tools", tools},
      {"stl", stl},
      {"obj", obj},
      {"ply", ply},
      {"glb", glb},
      {"3mf", threemf},
      {"scan_csv", measured<loop::read_scan_csv>},
      {"xyz", measured<loop::read_xyz>},
      {"inspection_csv", measured<loop::read_inspection_csv>},
      {"sizes_csv", measured<loop::read_sizes_csv>},
      {"mka", measured<loop::read_mka>},
      {"gde", measured<loop::read_gde>},
      {"bench_csv", bench},
      {"loop_json", loop_json},
      {"formula", formula},
      {"effects", effects},
      {"journal", journal},
  };
  return all;
}

const Target* find_target(std::string_view name) {
  const auto& all = targets();
  const auto found =
      std::find_if(all.begin(), all.end(), [&](const Target& t) { return t.name == name; });
  return found == all.end() ? nullptr : &*found;
}

}  // namespace trueflank::fuzz

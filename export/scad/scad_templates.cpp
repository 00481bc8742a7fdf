// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/scad/scad_templates.h"

#include <algorithm>
#include <charconv>
#include <map>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/export/atomic_file.h"
#include "trueflank/export/scad/scad_template_texts.h"
#include "trueflank/train/carrier.h"
#include "trueflank/train/planet_phase.h"

namespace trueflank::io {
namespace {

using Values = std::map<std::string, std::string>;

/// Sizes of sleeves and pins are not sharper than a tenth of a micrometre.
std::string size_text(double value_mm) { return trimmed_number(value_mm, 4); }

/// Replaces what parameters of the section "From the design" are set to, line by line, and the
/// lines between "// GEARS" and "// END GEARS".
std::string filled(std::string_view text, const Values& values, const std::string& gears,
                   const std::string& design_name) {
  std::string result = "// For " + design_name + ".\n";
  bool ours = false, in_gears = false;
  while (!text.empty()) {
    const auto end = std::min(text.find('\n') + 1, text.size());
    std::string line(text.substr(0, end));
    text.remove_prefix(end);
    if (line.starts_with("/* [")) ours = line.starts_with("/* [From the design]");
    if (line.starts_with("// END GEARS")) in_gears = false;
    if (in_gears) continue;
    const auto equals = line.find(" = ");
    const auto value = values.find(line.substr(0, equals));
    if (ours && equals != std::string::npos && value != values.end())
      line = value->first + " = " + value->second + line.substr(line.find(';'));
    result += line;
    if (line.starts_with("// GEARS")) {
      in_gears = true;
      result += gears;
    }
  }
  return result;
}

std::string spaced_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 32; }, ' ');
  return text;
}

/// Name of the part a gear belongs to; its section is that of the body's first gear.
std::string part_of(const GearTrain& train, const std::string& gear) {
  const Topology& topology = train.topology();
  const int member = topology.gears[static_cast<std::size_t>(topology.find_gear(gear))].member;
  const bool alike = !topology.is_planet(member) || planet_bodies_alike(train.assembly) ||
                     train.copies_of(member) == 1 || topology.gears_of(member).size() == 1;
  return topology.name_of(member) + (alike ? "" : "_1");
}
std::string section_module(const GearTrain& train, const std::string& module,
                           const std::string& gear) {
  const std::string part = part_of(train, gear);
  return "use <" + part + ".scad>\nmodule " + module + "() " + part + "_section();\n";
}

class TemplateFiller {
 public:
  explicit TemplateFiller(const GearTrain& train) : train_(train) {
    for (std::size_t i = 0; i < train.gears.size(); ++i) {
      const TrainGear& gear = train.gears[i];
      if (gear.profile.gear().kind != GearKind::kInternal) continue;
      const double speed =
          train.speeds.of[static_cast<std::size_t>(train.topology().gears[i].member)];
      (speed == 0.0 ? fixed_ : moving_) = &gear;
    }
  }

  std::vector<FilledTemplate> fill() {
    const bool planetary = train_.topology().has_planets();
    // a moving ring below the fixed one turns where the housing's floor would hold
    const bool housed = fixed_ && (!moving_ || moving_->z_lower_mm >= top_mm(*fixed_));
    if (planetary && housed) add_housing();
    if (planetary) add_carrier();
    if (planetary && housed) add_motor_adapter();
    if (planetary && moving_) add_output_flange();
    if (!train_.meshes.empty()) {
      add_test_jig();
      add_fit_coupon();
    }
    return std::move(files_);
  }

  /// What a stage needs for itself; housing, motor and output are of the whole train, and are not made for
  /// several stages.
  std::vector<FilledTemplate> fill_stage(const std::string& number) {
    stage_ = "_stage" + number;
    add_carrier();
    add_test_jig();
    add_fit_coupon();
    return std::move(files_);
  }

 private:
  [[nodiscard]] const GearDesign& design_of(const TrainGear& gear) const {
    return *find_gear(train_.design, gear.name);
  }
  void add(const char* name, std::string_view text, const std::string& gears = {}) {
    files_.push_back({std::string("template_") + name + stage_ + ".scad",
                      filled(text, values_, gears, spaced_line(train_.design.name))});
    values_.clear();
  }
  void set(const char* name, double value) { values_[name] = size_text(value); }

  /// As solid/part_shape.cpp makes a rim that the design leaves open.
  [[nodiscard]] double ring_diameter_mm(const TrainGear& ring) const {
    const GearDesign& design = design_of(ring);
    if (design.outer_diameter_mm) return *design.outer_diameter_mm;
    const double m = ring.profile.gear().normal_module_mm;
    double rim = ring.profile.root_radius_mm() + std::max(2.5 * m, 2.0);
    const BoltCircleDesign& bolts = design.bolt_circle;
    if (bolts.count > 0)
      rim = std::max(rim,
                     0.5 * (bolts.circle_diameter_mm + bolts.hole_diameter_mm) + std::max(m, 2.0));
    return 2.0 * rim;
  }
  static double top_mm(const TrainGear& gear) { return gear.z_lower_mm + gear.face_width_mm; }

  [[nodiscard]] HeightRange turning_heights() const {
    HeightRange range{1e300, -1e300};
    for (const TrainGear& gear : train_.gears) {
      range.lower_mm = std::min(range.lower_mm, gear.z_lower_mm);
      range.upper_mm = std::max(range.upper_mm, top_mm(gear));
    }
    if (const auto carrier = carrier_layout(train_)) {
      range.lower_mm = std::min(range.lower_mm, carrier->pins().lower_mm);
      range.upper_mm = std::max(range.upper_mm, carrier->pins().upper_mm);
    }
    return range;
  }
  [[nodiscard]] double housing_diameter_mm() const {
    const double moving = moving_ ? ring_diameter_mm(*moving_) + 1.0 : 0.0;
    return std::max(ring_diameter_mm(*fixed_), moving) + 8.0;
  }

  void add_housing() {
    set("fixed_ring_diameter", ring_diameter_mm(*fixed_));
    set("fixed_ring_bottom", fixed_->z_lower_mm);
    set("fixed_ring_top", top_mm(*fixed_));
    set("moving_ring_diameter", moving_ ? ring_diameter_mm(*moving_) : 0.0);
    set("moving_ring_bottom", moving_ ? moving_->z_lower_mm : 0.0);
    set("moving_ring_top", moving_ ? top_mm(*moving_) : 0.0);
    set("lowest", turning_heights().lower_mm);
    const TrainGear* sun =
        train_.sun();  // without one the carrier is driven, within the planets' axes
    set("shaft_opening",
        sun ? 2.0 * sun->profile.tip_radius_mm() + 1.0 : train_.centre_distance_mm);
    add("housing", scad_template::kHousing,
        section_module(train_, "fixed_ring_section", fixed_->name));
  }

  void add_carrier() {
    const Topology& topology = train_.topology();
    const TrainGear* planet = &train_.gear(topology.first_gear_of(topology.first_planet()));
    GearTrain carried = train_;  // with a carrier of usual sizes where the design has none
    const double bore = design_of(*planet).bore.diameter_mm;
    if (!carried.design.carrier) {
      const double usual = bore > 0.0 ? bore - 0.1 : 0.25 * planet->profile.root_radius_mm();
      carried.design.carrier = CarrierDesign{.pin_diameter_mm = usual};
    }
    const CarrierLayout layout = *carrier_layout(carried);
    std::string angles;
    for (double angle : train_.phases.positions_rad(topology.first_planet()))
      angles += (angles.empty() ? "[" : ", ") + size_text(deg_from_rad(angle));
    values_["pin_angles"] = angles + "]";
    set("centre_distance", train_.centre_distance_mm);
    set("pin_diameter", layout.pin_diameter_mm);
    set("planet_height", layout.upper_plate.lower_mm - layout.lower_plate.upper_mm -
                             2.0 * carried.design.carrier->axial_clearance_mm);
    set("opening", layout.opening_diameter_mm);
    set("plate_thickness", layout.lower_plate.upper_mm - layout.lower_plate.lower_mm);
    set("bearing_diameter", layout.seat_diameter_mm);
    set("bearing_width", layout.seat_depth_mm);
    set("plate_diameter", layout.outer_diameter_mm);
    add("carrier", scad_template::kCarrier);
  }

  void add_motor_adapter() {
    set("housing_diameter", housing_diameter_mm());
    const Topology& topology = train_.topology();
    if (!topology.is_carrier(topology.input))
      set("shaft_diameter",
          design_of(train_.gear(topology.first_gear_of(topology.input))).bore.diameter_mm);
    add("motor_adapter", scad_template::kMotorAdapter);
  }

  void add_output_flange() {
    set("ring_diameter", ring_diameter_mm(*moving_));
    set("ring_root_diameter", 2.0 * moving_->profile.root_radius_mm());
    set("ring_height", moving_->face_width_mm);
    const double above = turning_heights().upper_mm - top_mm(*moving_);
    set("inner_height", above);
    const auto carrier = carrier_layout(train_);
    set("inner_diameter", carrier ? carrier->outer_diameter_mm : 0.0);
    add("output_flange", scad_template::kOutputFlange,
        section_module(train_, "moving_ring_section", moving_->name));
  }

  void add_test_jig() {
    const TrainMesh& mesh = train_.meshes.front();
    const TrainGear& gear1 = train_.gears[mesh.gear1];
    const TrainGear& gear2 = train_.gears[mesh.gear2];
    const BoreDesign &bore1 = design_of(gear1).bore, &bore2 = design_of(gear2).bore;
    if (bore1.diameter_mm <= 0.0 || bore2.diameter_mm <= 0.0) return;
    set("centre_distance", train_.centre_distance_mm);
    set("bore1", post_mm(bore1));
    set("bore2", post_mm(bore2));
    set("tip_diameter1", 2.0 * gear1.profile.tip_radius_mm());
    set("tip_diameter2", 2.0 * gear2.profile.tip_radius_mm());
    add("test_jig", scad_template::kTestJig);
  }
  /// Largest round post that turns in a bore: a flat stands in its way, a keyway does not.
  static double post_mm(const BoreDesign& bore) {
    return bore.kind == BoreKind::kDFlat ? 2.0 * (bore.d_flat_mm - 0.5 * bore.diameter_mm)
                                         : bore.diameter_mm;
  }

  void add_fit_coupon() {
    const TrainMesh& mesh = train_.meshes.front();
    const TrainGear& gear1 = train_.gears[mesh.gear1];
    const TrainGear& gear2 = train_.gears[mesh.gear2];
    set("tip_diameter1", 2.0 * gear1.profile.tip_radius_mm());
    set("teeth1", gear1.profile.gear().teeth);
    set("tip_diameter2", 2.0 * gear2.profile.tip_radius_mm());
    set("root_diameter2", 2.0 * gear2.profile.root_radius_mm());
    set("teeth2", gear2.profile.gear().teeth);
    values_["internal2"] = gear2.profile.gear().kind == GearKind::kInternal ? "true" : "false";
    set("bore", post_mm(design_of(gear1).bore));
    add("fit_coupon", scad_template::kFitCoupon,
        section_module(train_, "gear1_section", gear1.name) +
            section_module(train_, "gear2_section", gear2.name));
  }

  const GearTrain& train_;
  const TrainGear* fixed_ = nullptr;
  const TrainGear* moving_ = nullptr;
  Values values_;
  std::string stage_;  ///< of file names; empty where there is one
  std::vector<FilledTemplate> files_;
};

}  // namespace

std::vector<FilledTemplate> scad_templates(const GearTrain& train) {
  if (train.stages.empty()) return TemplateFiller(train).fill();
  std::vector<FilledTemplate> files;
  for (std::size_t s = 0; s < train.stages.size(); ++s)
    for (FilledTemplate& file : TemplateFiller(train.stages[s]).fill_stage(std::to_string(s + 1)))
      files.push_back(std::move(file));
  return files;
}

Result<std::vector<ReportedFile>> write_scad_templates(const std::filesystem::path& folder,
                                                       const GearTrain& train) {
  std::vector<ReportedFile> written;
  for (const FilledTemplate& file : scad_templates(train)) {
    const std::filesystem::path path = folder / file.file_name;
    if (auto ok = write_file(path, file.text); !ok) return fail(ok.error());
    written.push_back({.path = file.file_name,
                       .part = path.stem().string(),
                       .format = "scad-template",
                       .bytes = file.text.size()});
  }
  return written;
}

}  // namespace trueflank::io

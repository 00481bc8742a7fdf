// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/geometry/tooth_span.h"
#include "trueflank/report/inch_sizes.h"
#include "trueflank/report/report.h"
#include "trueflank/report/report_drive.h"
#include "trueflank/train/axial_thrust.h"
#include "trueflank/train/mesh_face.h"

namespace trueflank::io {
namespace {

std::string formatted(const char* format, double value) {
  return std::isnan(value) ? "-" : printed_number(value, format);
}

/// Columns of text; a left-aligned one is given as a negative width.
std::string row(std::initializer_list<std::pair<int, std::string>> cells) {
  std::string line;
  for (const auto& [width, cell] : cells) {
    const auto room = static_cast<std::size_t>(std::abs(width));
    const std::string pad(cell.size() < room ? room - cell.size() : 0, ' ');
    line += width < 0 ? cell + pad : pad + cell;
    line += ' ';
  }
  while (!line.empty() && line.back() == ' ') line.pop_back();
  return line + "\n";
}

/// Words wrapped to 80 columns behind an indent.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string result(indent, ' '), word;
  std::size_t column = indent;
  const auto put = [&] {
    if (word.empty()) return;
    if (column > indent && column + 1 + word.size() > 79) {
      result += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (column > indent) {
      result += ' ';
      ++column;
    }
    result += word;
    column += word.size();
    word.clear();
  };
  for (char c : text) {
    if (c == ' ' || c == '\n') put();
    else word += c;
  }
  put();
  return result + "\n";
}

std::string backward_text(double backward, bool self_locking) {
  return self_locking ? "none (self-locking)" : formatted("%.2f", 100.0 * backward) + " %";
}

/// Names of the meshes of a kind, without those that idle.
template <class Kind>
std::string carrying_meshes(const GearTrain& train, const EfficiencyResult& e, const Kind& kind) {
  const std::vector<bool> idle = idle_meshes(train.topology());
  std::string names;
  for (std::size_t k = 0; k < e.meshes.size(); ++k)
    if (!idle[k] && kind(e.meshes[k])) names += (names.empty() ? "" : ", ") + e.meshes[k].name;
  return names;
}

/// The paper's formula beside the figures by the sliding itself, and what a difference means.
std::string formula_text(const GearTrain& train, const EfficiencyResult& e) {
  const std::string outside =
      carrying_meshes(train, e, [](const MeshEfficiency& mesh) { return !mesh.formula_applies; });
  return wrapped("by the contact ratio formula: forward " + formatted("%.2f", 100.0 * e.by_formula.forward) +
                     " %, backward " + backward_text(e.by_formula.backward, e.by_formula.self_locking) +
                     (outside.empty() ? ", the same to first order in friction"
                                      : "; it does not hold for " + outside + ", where contact is not as it assumes"),
                 2);
}

/// Which meshes have moments without contact, and so no efficiency.
std::string interrupted_text(const GearTrain& train, const EfficiencyResult& e) {
  const std::string meshes = carrying_meshes(
      train, e, [](const MeshEfficiency& mesh) { return std::isnan(mesh.by_path_integral); });
  return meshes.empty() ? "" : wrapped("efficiency: none, contact is interrupted in " + meshes, 0);
}

std::string plastic_text(const PlasticResult& plastic) {
  std::string text = "  in the form of VDI 2736 for the plastics: " + formatted("%.4g", plastic.output_torque_nm) +
                     " N m, limited by " + plastic.limiting_mode + " of " + plastic.limiting_gear;
  double hottest = kNaN;
  for (const PlasticTooth& t : plastic.teeth)
    if (!(t.flank_c <= hottest)) hottest = t.flank_c;
  return wrapped(text.substr(2) + ", flanks at " + formatted("%.0f", hottest) + " deg C", 2);
}

std::string heading_text(const Report& report) {
  const GearTrain& train = *report.train;
  const double output = train.speeds.output;
  std::string text = train.design.name + ": " + train.topology().kind;
  if (!std::isnan(output))
    text += ", ratio " + formatted("%.4f", std::abs(1.0 / output)) +
            (output > 0.0 ? " (same direction)" : " (opposite direction)");
  if (!std::isnan(train.centre_distance_mm))
    text += ", centre distance " + formatted("%.4f", train.centre_distance_mm) + " mm";
  text += "\n";
  for (std::size_t s = 0; s < train.stages.size(); ++s) {
    const GearTrain& stage = train.stages[s];
    text += "stage " + std::to_string(s + 1) + ": ratio " + formatted("%.4f", std::abs(1.0 / stage.speeds.output)) +
            ", " + std::to_string(stage.design.planets) + " planets, centre distance " +
            formatted("%.4f", stage.centre_distance_mm) + " mm\n";
  }
  const EfficiencyResult& e = report.efficiency;
  if (!std::isnan(e.forward)) {
    text += "efficiency at friction " + formatted("%g", e.friction) + ": forward " +
            formatted("%.2f", 100.0 * e.forward) + " %, backward " +
            backward_text(e.backward, e.self_locking) + "\n";
    if (e.losses)
      text += "  with the measured losses at " + formatted("%g", train.design.losses->load_nm) +
              " N m of output torque and " + formatted("%g", train.design.losses->input_speed_rpm) +
              " rpm; the meshes alone: forward " + formatted("%.2f", 100.0 * e.mesh_forward) +
              " %, backward " + formatted("%.2f", 100.0 * e.mesh_backward) + " %\n";
    text += formula_text(train, e);
  }
  text += interrupted_text(train, e);
  if (report.strength && !std::isnan(report.strength->output_torque_nm)) {
    const StrengthResult& s = *report.strength;
    text += wrapped("allowable output torque " + formatted("%.4g", s.output_torque_nm) + " N m, limited by " +
                        s.limiting_mode + " of " + s.limiting_gear + " (" + limiting_material(s) + ")",
                    0);
  }
  if (report.iso6336 && !std::isnan(report.iso6336->output_torque_nm))
    text += wrapped("in the form of ISO 6336: " + formatted("%.4g", report.iso6336->output_torque_nm) +
                        " N m, limited by " + report.iso6336->limiting_mode + " of " + report.iso6336->limiting_gear,
                    2);
  if (report.plastic) text += plastic_text(*report.plastic);
  return text + "\n";
}

std::string gear_table(const GearTrain& train) {
  std::string text = row({{-8, "gear"}, {5, "teeth"}, {9, "shift"}, {10, "tip mm"}, {10, "root mm"},
                          {10, "form mm"}, {9, "width mm"}});
  for (const TrainGear& gear : train.gears)
    text += row({{-8, gear.name},
                 {5, std::to_string(gear.profile.gear().teeth)},
                 {9, formatted("%.4f", gear.shift)},
                 {10, formatted("%.4f", 2.0 * gear.profile.tip_radius_mm())},
                 {10, formatted("%.4f", 2.0 * gear.profile.root_radius_mm())},
                 {10, formatted("%.4f", 2.0 * gear.profile.root_form_radius_mm())},
                 {9, formatted("%.2f", gear.face_width_mm)}});
  for (const TrainGear& gear : train.gears)
    if (gear.tip_shortened_mm > 0.0)
      text += wrapped("tip of " + gear.name + " " + formatted("%.3f", gear.tip_shortened_mm) +
                          " mm short of the standard circle, clear of its mate's root fillet (tips = \"clear\")",
                      0);
  return text + "\n";
}

/// Limits of tooth thickness, as an inspector needs them; nothing where no gear has an allowance.
std::string thickness_table(const GearTrain& train) {
  std::string text;
  for (const TrainGear& gear : train.gears) {
    if (!gear.thinning_limits) continue;
    const ThinningLimits& limits = *gear.thinning_limits;
    const Gear thick = thinned(gear.profile.gear(), limits.least_mm);
    const Gear thin = thinned(gear.profile.gear(), limits.most_mm);
    const int k = recommended_span_teeth(gear.profile.gear());
    const double pin = recommended_pin_diameter_mm(gear.profile.gear());
    const double pins1 = over_pins_mm(thin, pin), pins2 = over_pins_mm(thick, pin);
    if (text.empty())
      text = row({{-8, "gear"}, {16, "thickness um"}, {19, "span mm"}, {5, "over"},
                  {21, "over pins mm"}, {8, "pin mm"}});
    const bool external = thick.kind == GearKind::kExternal;
    text += row({{-8, gear.name},
                 {16, formatted("%.1f", um_from_mm(limits.lower_mm)) + " .. " +
                          formatted("%.1f", um_from_mm(limits.upper_mm))},
                 {19, external ? formatted("%.4f", base_tangent_length_mm(thin, k)) + ".." +
                                     formatted("%.4f", base_tangent_length_mm(thick, k))
                               : "-"},
                 {5, external ? std::to_string(k) : "-"},
                 {21, formatted("%.4f", std::min(pins1, pins2)) + ".." +
                          formatted("%.4f", std::max(pins1, pins2))},
                 {8, formatted("%.3f", pin)}});
  }
  if (text.empty()) return {};
  for (const TrainMesh& mesh : train.meshes)
    if (!std::isnan(mesh.smallest_backlash_mm))
      text += mesh.name + ": backlash " + formatted("%.1f", um_from_mm(mesh.smallest_backlash_mm)) +
              " .. " + formatted("%.1f", um_from_mm(mesh.largest_backlash_mm)) +
              " um from these allowances\n";
  return text + "\n";
}

std::string mesh_table(const Report& report) {
  const GearTrain& train = *report.train;
  if (train.meshes.empty()) return {};
  std::string text = row({{-14, "mesh"}, {8, "angle"}, {8, "contact"}, {9, "effective"},
                          {11, "backlash um"}, {10, "efficiency"}, {12, "clearance um"}});
  for (std::size_t i = 0; i < train.meshes.size(); ++i) {
    const TrainMesh& mesh = train.meshes[i];
    const GearPair pair = train.pair(mesh);
    const ContactRatios ratios = contact_ratios(pair);
    const bool swept = i < report.sweeps.size();
    text += row({{-14, mesh.name},
                 {8, formatted("%.3f", deg_from_rad(working_pressure_angle_rad(pair)))},
                 {8, formatted("%.3f", ratios.total)},
                 {9, formatted("%.3f", ratios.effective)},
                 {11, formatted("%.1f", um_from_mm(mesh.backlash_mm))},
                 {10, formatted("%.5f", report.efficiency.basic_efficiency_of(mesh.name))},
                 {12, formatted("%.1f", swept ? report.sweeps[i].minimum_clearance_um : kNaN)}});
  }
  return text + "\n";
}

/// The face that carries, where edge chamfers or a relief groove leave less than all of it.
std::string carrying_text(const GearTrain& train) {
  std::string text;
  for (const TrainMesh& mesh : train.meshes) {
    const TrainGear& gear1 = train.gears[static_cast<std::size_t>(mesh.gear1)];
    const TrainGear& gear2 = train.gears[static_cast<std::size_t>(mesh.gear2)];
    const double whole = std::min(gear1.face_width_mm, gear2.face_width_mm);
    const double carrying = common_face(train, mesh).carrying_mm;
    if (!(carrying < whole - 1e-9)) continue;
    text += (text.empty() ? "carrying face width: " : ", ") + mesh.name + " " +
            formatted("%.2f", carrying) + " of " + formatted("%.2f", whole) + " mm";
  }
  if (text.empty()) return text;
  return wrapped(text + " (less edge chamfers and relief groove)", 0) + "\n";
}

/// Hands, overlap and axial forces; nothing for spur teeth.
std::string helix_table(const Report& report) {
  const GearTrain& train = *report.train;
  if (train.design.helix_angle_rad == 0.0) return {};
  std::string text;
  for (const TrainGear& gear : train.gears) {
    const Gear& g = gear.profile.gear();
    text += (text.empty() ? "helix: " : ", ") + gear.name + " " +
            formatted("%g", std::abs(deg_from_rad(g.helix_angle_rad))) + " deg " +
            (gear.twist.herringbone ? "herringbone" : g.helix_angle_rad > 0.0 ? "right" : "left");
  }
  text = wrapped(text, 0);
  if (train.meshes.empty()) return text + "\n";
  const AxialThrust thrust = axial_thrust(train, report.efficiency.forward_drive);
  text += row({{-14, "mesh"}, {9, "overlap"}, {9, "total"}, {22, "thrust on gear 1 N/Nm"}});
  for (std::size_t i = 0; i < train.meshes.size(); ++i) {
    const double overlap = overlap_ratio(train, train.meshes[i]);
    text += row({{-14, train.meshes[i].name},
                 {9, formatted("%.3f", overlap)},
                 {9, formatted("%.3f", contact_ratios(train.pair(train.meshes[i])).effective + overlap)},
                 {22, formatted("%.3f", thrust.meshes[i].on_gear1_n_per_nm)}});
  }
  std::string net = "net axial thrust per N m at the sun (pinion) driven counter-clockwise, + along z:";
  for (const auto& body : thrust.bodies)
    net += " " + body.name + " " + formatted("%.3f", body.n_per_nm) + " N" +
           (&body == &thrust.bodies.back() ? "" : ",");
  return text + wrapped(net, 0) + "\n";
}

std::string coloured(CheckStatus status, TextColour colour) {
  const std::string word = to_text(status);
  const std::string padded = word + std::string(word.size() < 5 ? 5 - word.size() : 0, ' ');
  if (colour == TextColour::kNone) return padded;
  switch (status) {
    case CheckStatus::kPass: return "\033[32m" + padded + "\033[0m";
    case CheckStatus::kWarn: return "\033[33m" + padded + "\033[0m";
    case CheckStatus::kFail: return "\033[31m" + padded + "\033[0m";
    case CheckStatus::kNotApplicable: return padded;
  }
  return padded;
}

/// How far beyond its limit, as a share of it: what a reader should look at first is largest.
double excess(const Finding& finding) {
  if (std::isnan(finding.value) || std::isnan(finding.limit)) return 0.0;
  const double scale = std::max(std::abs(finding.limit), std::abs(finding.value));
  return scale > 0.0 ? std::abs(finding.value - finding.limit) / scale : 0.0;
}

int urgency(CheckStatus status) {
  switch (status) {
    case CheckStatus::kFail: return 0;
    case CheckStatus::kWarn: return 1;
    default: return 2;
  }
}

/// What applies, by what matters; checks of equal weight keep their order.
std::vector<const Finding*> sorted_findings(const Findings& findings) {
  std::vector<const Finding*> sorted;
  for (const Finding& finding : findings)
    if (finding.status != CheckStatus::kNotApplicable) sorted.push_back(&finding);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Finding* a, const Finding* b) {
    const int first = urgency(a->status), second = urgency(b->status);
    if (first != second) return first < second;
    return a->status != CheckStatus::kPass && excess(*a) > excess(*b);
  });
  return sorted;
}

std::string check_table(const Report& report, const ReportTextOptions& options) {
  std::string text;
  int passed = 0;
  for (const Finding* shown : sorted_findings(report.findings)) {
    const Finding& finding = *shown;
    passed += finding.status == CheckStatus::kPass;
    if (finding.status == CheckStatus::kPass && !options.every_check) continue;
    const TextColour colour = options.colour;
    const std::string unit = finding.unit.empty() ? "" : " " + finding.unit;
    text += coloured(finding.status, colour) + " " +
            row({{-23, finding.id},
                 {-15, finding.where},
                 {14, std::isnan(finding.value) ? "" : formatted("%.4g", finding.value) + unit},
                 {-18, std::isnan(finding.limit) ? "" : "limit " + formatted("%.4g", finding.limit)}});
    if (finding.status == CheckStatus::kPass) continue;
    text += wrapped(finding.message, 6);
    if (!finding.cure.empty()) text += wrapped("Cure: " + finding.cure, 6);
  }
  if (passed > 0 && !options.every_check)
    text += std::to_string(passed) + " passed (-v shows them)\n";
  return text + "\n";
}

/// The one change that mends what fails, or which checks stand against each other.
std::string joint_cure_text(const ReportedCure& cure) {
  std::string text;
  if (cure.cured)
    text = "one change after which every check passes (trueflank fix DESIGN -o FIXED.toml writes it)\n";
  else if (!cure.changes.empty())
    text = "no change was found after which every check passes; the nearest\n";
  else
    text = "no change near this design mends it\n";
  text += cure_table(cure);
  if (cure.cured)
    return text + (cure.search_ended ? "\n" : "trueflank fix searches longer, for a smaller change\n\n");
  text += "still fails\n";
  for (const Finding& f : cure.still_failing) text += wrapped(f.id + " " + f.where + ": " + f.message, 2);
  if (!cure.contradiction.empty()) text += wrapped(cure.contradiction, 0);
  text += "trueflank fix DESIGN -o FIXED.toml searches longer\n";
  return text + "\n";
}

std::string file_table(const Report& report) {
  if (report.files.empty()) return {};
  std::string text = row({{-26, "file"}, {12, "bytes"}, {11, "triangles"}, {14, "accuracy um"}});
  for (const ReportedFile& file : report.files)
    text += row({{-26, file.path},
                 {12, std::to_string(file.bytes)},
                 {11, file.triangles > 0 ? std::to_string(file.triangles) : "-"},
                 {14, formatted("%.3f", file.accuracy_um)}});
  for (const ReportedFile& file : report.files) {
    if (std::isnan(file.kerf_mm)) continue;
    text += wrapped(file.path + ": path of the middle of a cut " + formatted("%g", file.kerf_mm) +
                        " mm wide" +
                        (file.unreached_corners == 0
                             ? std::string()
                             : "; it does not reach into " + std::to_string(file.unreached_corners) +
                                   " corners, where up to " + formatted("%.1f", file.left_um) +
                                   " um of material stay (frozen layers AS_CUT)"),
                    0);
  }
  return text + "\n";
}

}  // namespace

std::string report_text(const Report& report, const ReportTextOptions& options) {
  int warnings = 0, failures = 0;
  for (const Finding& finding : report.findings) {
    warnings += finding.status == CheckStatus::kWarn;
    failures += finding.status == CheckStatus::kFail;
  }
  std::string text = heading_text(report) + gear_table(*report.train) +
                     (report.inches ? inch_table(*report.train) : std::string()) + mesh_table(report) +
                     carrying_text(*report.train) + helix_table(report) +
                     thickness_table(*report.train) +
                     check_table(report, options) +
                     (report.cure ? joint_cure_text(*report.cure) : std::string()) + file_table(report);
  text += "verdict: " + coloured(verdict(report.findings), options.colour);
  if (failures + warnings > 0)
    text += " (" + std::to_string(failures) + " failed, " + std::to_string(warnings) + " warned)";
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text + "\n";
}

}  // namespace trueflank::io

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/observations.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

#include "trueflank/base/threads.h"
#include "trueflank/geometry/tooth_span.h"
#include "trueflank/loop/gear/local/measured_lands.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {
namespace {

std::string number_text(double value) {
  std::string text = std::to_string(value);
  while (text.find('.') != std::string::npos && (text.back() == '0' || text.back() == '.')) {
    const bool dot = text.back() == '.';
    text.pop_back();
    if (dot) break;
  }
  return text;
}

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Counts the rows of a file that cannot be of this gear. Where they are many the file is another gear's, and
/// what is left of it would tell nothing about this one.
class ForeignRows {
 public:
  void judge(int line, const std::string& why) {
    if (why.empty()) return;
    if (count_++ == 0) first_ = {line, why};
  }
  [[nodiscard]] bool refuses(std::size_t rows, const std::string& file, Errors& errors) const {
    constexpr std::size_t kFewest = 10;  // one in so many may be a slip
    if (count_ * kFewest <= rows) return false;
    errors.push_back({.code = ErrorCode::kOutOfRange,
                      .message = std::to_string(count_) + " of " + std::to_string(rows) +
                                 " rows cannot belong to this gear: " + first_.second,
                      .remedy = "the file of this gear, or its design; check --gear",
                      .file = file,
                      .line = first_.first});
    return true;
  }

 private:
  std::size_t count_ = 0;
  std::pair<int, std::string> first_;
};

class TableBuilder {
 public:
  TableBuilder(const FlankGeometry& geometry, const ObservationOptions& options)
      : geometry_(geometry), options_(options) {}

  void add_scan(const ScanData& scan, int source) {
    Pose pose;
    if (!options_.aligned) {
      const auto fitted = fit_pose(geometry_, scan);
      if (!fitted) {
        errors.push_back(fitted.error());
        return;
      }
      pose = *fitted;
    }
    const PoseQuality quality = pose_quality(geometry_, scan, pose);
    if (!(quality.share > 0.2) ||
        !(quality.median_mm < 0.15 * geometry_.gear().normal_module_mm)) {
      errors.push_back(
          {.code = ErrorCode::kInconsistent,
           .message = "the scan does not fit the gear as designed: " +
                      number_text(std::round(1000.0 * quality.share) / 10.0) +
                      " % of its points in the ring of the teeth lie near a flank" +
                      (options_.aligned ? ", taken as aligned" : ""),
           .remedy = options_.aligned ? "leave out --aligned, or check the gear and the unit (mm)"
                                      : "check --gear, the design and the unit (mm)",
           .file = scan.file});
      return;
    }
    table.poses.push_back(pose);
    table.pose_is_free.push_back(!options_.aligned);
    add_points(scan, pose, source);
  }

  void add_inspection(const InspectionData& data, int source) {
    BadLines bad(data.file);
    ForeignRows foreign;
    const std::size_t before = table.rows.size();
    std::map<std::array<int, 4>, int> traces;
    for (const InspectionRow& row : data.rows) {
      const std::string wrong = add_inspection_row(data, row, source, traces);
      if (!wrong.empty()) bad.add(row.line, wrong);
      foreign.judge(row.line, foreign_row(row));
    }
    if (foreign.refuses(data.rows.size(), data.file, errors)) return;
    if (table.rows.size() == before) {
      errors.push_back(bad.error("no row of the file fits this gear"));
      return;
    }
    if (!data.from_design) take_design_off(before);
    bad.tell(table.notes);
  }

  /// A value of index or runout is an observation of its own, 30 kB in the fit; a size has places on all teeth.
  void refuse_too_many_single_values() {
    constexpr std::size_t kMostValues = 20'000, kMostSizes = 2'000;
    const auto refuse = [&](std::size_t count, std::size_t most, const std::string& of_what) {
      if (count <= most) return;
      errors.push_back({.code = ErrorCode::kUnsupported,
                        .message = std::to_string(count) + " " + of_what + "; " + std::to_string(most) +
                                   " are the most",
                        .remedy = "means of repeated measurements"});
    };
    refuse(index_values_, kMostValues, "values of index and radial runout");
    refuse(sizes_, kMostSizes, "sizes");
  }

  void add_sizes(const SizeData& data, int source) {
    BadLines bad(data.file);
    ForeignRows foreign;
    const std::size_t before = table.rows.size();
    for (const SizeRow& row : data.rows) {
      const std::string wrong = add_size(row, source);
      if (!wrong.empty()) bad.add(row.line, wrong);
      foreign.judge(row.line, wrong);
    }
    if (foreign.refuses(data.rows.size(), data.file, errors)) return;
    if (table.rows.size() == before && !data.rows.empty()) {
      errors.push_back(bad.error("no size of the file fits this gear"));
      return;
    }
    take_design_off(before);
    bad.tell(table.notes);
  }

  Observations table;
  Errors errors;

 private:
  Observation& add_row(ObservationKind kind, double deviation_um, double sigma_um, int source) {
    if (kind == ObservationKind::kIndex || kind == ObservationKind::kRadial) ++index_values_;
    if (kind == ObservationKind::kSize) ++sizes_;
    Observation row;
    row.kind = kind;
    row.deviation_um = deviation_um;
    row.sigma_um = sigma_um;
    row.source = source;
    row.first_place = static_cast<std::uint32_t>(table.places.size());
    row.places = 0;
    table.rows.push_back(row);
    return table.rows.back();
  }
  /// Machines draw traces against the plain involute and helix, sizes are compared with the plain
  /// gear's: what the design itself relieves is no deviation.
  void take_design_off(std::size_t from) {
    for (std::size_t i = from; i < table.rows.size(); ++i) {
      Observation& row = table.rows[i];
      for (std::uint32_t k = 0; k < row.places; ++k) {
        const WeightedPlace& place = table.places[row.first_place + k];
        row.deviation_um -=
            place.weight * um_from_mm(geometry_.designed_deviation_mm(place.place));
      }
    }
  }
  void add_place(Observation& row, const Place& place, double weight) {
    table.places.push_back({place, weight});
    ++row.places;
  }

  void add_points(const ScanData& scan, const Pose& pose, int source) {
    const double reach = 0.35 * geometry_.gear().normal_module_mm;
    const double chamfer = geometry_.edge_chamfer_mm();
    const double edge = std::clamp(0.01 * geometry_.face_width_mm(), 0.02, 0.1) + chamfer;
    const double b = geometry_.face_width_mm();
    const MeasuredLands lands(geometry_, scan, pose, reach);
    const std::size_t most = table.rows.size() + scan.points_mm.size();
    table.rows.reserve(most);  // growing would leave up to as much again unused
    table.places.reserve(table.places.size() + scan.points_mm.size());
    table.points_mm.reserve(most);
    // Without normals, points at the very ends of the face may lie on the end faces.
    const double inside = scan.normals.empty() || chamfer > 0.0 ? edge : -edge;
    struct Placed {
      std::array<double, 3> point_mm;
      PlacedPoint on;
      bool usable = false;
    };
    const auto placed = [&](std::size_t i) {
      Placed one{pose(scan.points_mm[i]), {}};
      const auto& p = one.point_mm;
      one.on = geometry_.nearest(p, reach);
      const Place& place = one.on.place;
      one.usable = place.surface != Surface::kNone && p[2] > inside && p[2] < b - inside &&
                   looks_outwards(scan, i, pose, place) &&
                   !(place.surface == Surface::kFlank && lands.covers(place, p));
      return one;
    };
    // Placed on all processors, some at a time; then taken in their order.
    constexpr std::size_t kOfWork = 4096, kAtOnce = 16 * kOfWork;
    std::vector<Placed> some(std::min(kAtOnce, scan.points_mm.size()));
    std::size_t unused = 0;
    for (std::size_t from = 0; from < scan.points_mm.size(); from += kAtOnce) {
      const std::size_t count = std::min(kAtOnce, scan.points_mm.size() - from);
      for_each_piece((count + kOfWork - 1) / kOfWork, [&](std::size_t piece) {
        for (std::size_t k = piece * kOfWork; k < std::min(count, (piece + 1) * kOfWork); ++k)
          some[k] = placed(from + k);
      });
      for (std::size_t k = 0; k < count; ++k) {
        const Placed& one = some[k];
        if (!one.usable) {
          ++unused;
          continue;
        }
        const double sigma = scan.sigma_um.empty() ? kNaN : scan.sigma_um[from + k];
        Observation& row = add_row(kind_of(one.on.place.surface), um_from_mm(one.on.distance_mm),
                                   sigma, source);
        add_place(row, one.on.place, 1.0);
        table.points_mm.push_back(one.point_mm);
      }
    }
    if (10 * unused > 7 * scan.points_mm.size())
      table.notes.push_back(scan.file + ": " + std::to_string(unused) + " of " +
                            std::to_string(scan.points_mm.size()) +
                            " points lie on no flank, tip, root or bore and are not used");
  }

  [[nodiscard]] bool looks_outwards(const ScanData& scan, std::size_t i, const Pose& pose,
                                    const Place& place) const {
    if (scan.normals.empty()) return true;
    const auto& n = scan.normals[i];
    const Eigen::Vector3d m = pose.rotation * Eigen::Vector3d(n[0], n[1], n[2]);
    const double nz = geometry_.normal_z(place);
    const double nt = std::sqrt(1.0 - nz * nz);
    return nt * (m.x() * place.normal_direction[0] + m.y() * place.normal_direction[1]) +
               nz * m.z() >
           0.7;
  }

  static ObservationKind kind_of(Surface surface) {
    switch (surface) {
      case Surface::kTip: return ObservationKind::kScanTip;
      case Surface::kRoot: return ObservationKind::kScanRoot;
      case Surface::kBore: return ObservationKind::kScanBore;
      default: return ObservationKind::kScanFlank;
    }
  }

  /// Why a row cannot be of this gear; empty where it can. What lies on the gear but off its flanks can.
  [[nodiscard]] std::string foreign_row(const InspectionRow& row) const {
    if (row.tooth > geometry_.teeth())
      return "tooth " + std::to_string(row.tooth) + " of a gear with " +
             std::to_string(geometry_.teeth()) + " teeth";
    const double module = geometry_.gear().normal_module_mm;
    if (std::abs(row.deviation_um) > 500.0 * module)
      return "a deviation of " + number_text(row.deviation_um) + " um is no deviation of this gear";
    const auto [least, most] = std::minmax({geometry_.tip_radius_mm(), geometry_.root_radius_mm()});
    // A ball in the gap stands further out than the teeth.
    const double reach = row.record == RecordKind::kRadial ? 3.0 * module : 0.3 * module;
    if (0.5 * row.diameter_mm < least - reach || 0.5 * row.diameter_mm > most + reach)
      return "diameter " + number_text(row.diameter_mm) + " mm lies outside this gear's teeth";
    if (std::abs(geometry_.face_coordinate(row.z_mm)) > 1.3)
      return "z " + number_text(row.z_mm) + " mm lies outside this gear's face";
    return {};
  }

  std::string add_inspection_row(const InspectionData& data, const InspectionRow& row, int source,
                                 std::map<std::array<int, 4>, int>& traces) {
    if (std::string wrong = foreign_row(row); !wrong.empty()) return wrong;
    const double middle_roll = geometry_.roll_at_radius_mm(geometry_.reference_radius_mm());
    double roll = std::isnan(row.diameter_mm) ? middle_roll
                                              : geometry_.roll_at_radius_mm(0.5 * row.diameter_mm);
    if (!std::isnan(row.diameter_to_mm))
      roll += row.fraction * (geometry_.roll_at_radius_mm(0.5 * row.diameter_to_mm) - roll);
    const double z = std::isnan(row.z_mm) ? 0.5 * geometry_.face_width_mm() : row.z_mm;
    const double u = geometry_.profile_coordinate(roll);
    if (row.record != RecordKind::kRadial && std::abs(u) > 1.05)
      return "diameter " + number_text(row.diameter_mm) + " mm is not on the involute";
    if (std::abs(geometry_.face_coordinate(z)) > 1.02)
      return "z " + number_text(z) + " mm is not on the face";
    if (row.record == RecordKind::kRadial) return add_radial(data, row, source, traces, z);
    constexpr std::array kKinds{ObservationKind::kProfile, ObservationKind::kHelix,
                                ObservationKind::kIndex};
    const int side = flank_side(row.flank, geometry_.gear().kind);
    // A trace has its own zero; all index values of a flank share theirs.
    const bool index = row.record == RecordKind::kIndex;
    const std::array<int, 4> key{static_cast<int>(row.record), index ? 0 : row.tooth, side, source};
    const int trace = zero_of(data, key, traces);
    // Along the circle the flank goes further than along its normal, by 1 / (cos(alpha_y) cos(beta_b)).
    const double share = row.along_circle
                             ? side * geometry_.base_radius_mm() /
                                   std::hypot(geometry_.base_radius_mm(), roll) *
                                   std::cos(geometry_.base_helix_rad())
                             : 1.0;
    Observation& added = add_row(kKinds[static_cast<int>(row.record)], share * row.deviation_um,
                                 row.sigma_um, source);
    added.trace = trace;
    add_place(added, geometry_.on_flank(row.tooth, side, roll, z), 1.0);
    return {};
  }

  int zero_of(const InspectionData& data, const std::array<int, 4>& key,
              std::map<std::array<int, 4>, int>& traces) {
    if (data.common_zero) return -1;
    const auto [found, is_new] = traces.emplace(key, table.traces);
    if (is_new) ++table.traces;
    return found->second;
  }

  /// Ball in the gap after a tooth: it is pushed out by the mean of both flanks over sin(a_M).
  std::string add_radial(const InspectionData& data, const InspectionRow& row, int source,
                         std::map<std::array<int, 4>, int>& traces, double z) {
    double ball = data.ball_diameter_mm;
    if (!(ball > 0.0)) ball = recommended_pin_diameter_mm(geometry_.gear());
    const auto contact = geometry_.ball_contact(ball);
    if (std::isnan(contact.roll_mm))
      return "a ball of " + number_text(ball) + " mm touches no flank of this gear";
    const int trace = zero_of(data, {static_cast<int>(row.record), 0, 0, source}, traces);
    Observation& added =
        add_row(ObservationKind::kRadial, row.deviation_um, row.sigma_um, source);
    added.trace = trace;
    const double weight = 0.5 / (std::sin(contact.centre_angle_rad) *
                                 std::cos(geometry_.base_helix_rad()));
    const int next = row.tooth % geometry_.teeth() + 1;
    add_place(added, geometry_.on_flank(row.tooth, 1, contact.roll_mm, z), weight);
    add_place(added, geometry_.on_flank(next, -1, contact.roll_mm, z), weight);
    return {};
  }

  void add_both_flanks(Observation& row, double roll, double total_weight) {
    const double weight = 0.5 * total_weight / geometry_.teeth();
    for (int tooth = 1; tooth <= geometry_.teeth(); ++tooth)
      for (const int side : {1, -1})
        add_place(row, geometry_.on_flank(tooth, side, roll, 0.5 * geometry_.face_width_mm()),
                  weight);
  }

  std::string add_size(const SizeRow& size, int source) {
    double nominal = kNaN, roll = kNaN, weight = 0.0;
    Surface surface = Surface::kFlank;
    double radius = 0.0;
    const double cos_helix = std::cos(geometry_.base_helix_rad());
    switch (size.quantity) {
      case SizeQuantity::kSpan:
        if (size.detail > geometry_.teeth() || size.detail != std::floor(size.detail))
          return "a span over " + number_text(size.detail) + " teeth of a gear with " +
                 std::to_string(geometry_.teeth());
        nominal = base_tangent_length_mm(geometry_.gear(), static_cast<int>(size.detail));
        roll = 0.5 * nominal * cos_helix;
        weight = 2.0;
        if (std::isnan(nominal)) return "a ring has no span";
        break;
      case SizeQuantity::kOverPins: {
        nominal = over_pins_mm(geometry_.gear(), size.detail);
        if (std::isnan(nominal))
          return "a pin of " + number_text(size.detail) + " mm touches no flank";
        const auto contact = geometry_.ball_contact(size.detail);
        roll = contact.roll_mm;
        const double odd =
            geometry_.teeth() % 2 == 0 ? 1.0 : std::cos(0.5 * kPi / geometry_.teeth());
        weight = geometry_.sense() * 2.0 * odd / (std::sin(contact.centre_angle_rad) * cos_helix);
        break;
      }
      case SizeQuantity::kTipDiameter: surface = Surface::kTip; radius = geometry_.tip_radius_mm(); break;
      case SizeQuantity::kRootDiameter: surface = Surface::kRoot; radius = geometry_.root_radius_mm(); break;
      case SizeQuantity::kBore: surface = Surface::kBore; radius = geometry_.bore_radius_mm(); break;
    }
    if (surface == Surface::kBore && radius <= 0.0) return "the design has no round bore here";
    if (surface != Surface::kFlank) {
      nominal = 2.0 * radius;
      weight = surface == Surface::kBore ? -2.0 : 2.0 * geometry_.sense();
    }
    const double deviation = um_from_mm(size.value_mm - nominal);
    if (std::abs(deviation) > 1000.0 * geometry_.gear().normal_module_mm)
      return "a size of " + number_text(size.value_mm) + " mm, designed " + number_text(nominal) +
             " mm, is no size of this gear";
    Observation& row = add_row(ObservationKind::kSize, deviation, size.sigma_um, source);
    if (surface == Surface::kFlank) add_both_flanks(row, roll, weight);
    else add_place(row, geometry_.on_circle(surface, 1, 0.0, radius,
                                            0.5 * geometry_.face_width_mm()), weight);
    return {};
  }

  const FlankGeometry& geometry_;
  ObservationOptions options_;
  std::size_t index_values_ = 0, sizes_ = 0;
};

constexpr std::size_t kFewInPatch = 5;
using PatchRows = std::map<std::array<int, 5>, std::vector<std::size_t>>;

/// Patches of a flank with too few values to judge by are judged together.
void gather_small_patches(PatchRows& patches) {
  PatchRows gathered;
  for (auto patch = patches.begin(); patch != patches.end();) {
    if (patch->second.size() >= kFewInPatch) {
      ++patch;
      continue;
    }
    std::array<int, 5> key = patch->first;
    key[3] = key[4] = -1;
    auto& rows = gathered[key];
    rows.insert(rows.end(), patch->second.begin(), patch->second.end());
    patch = patches.erase(patch);
  }
  patches.merge(gathered);
}

/// The values of a thin patch of a scan and of those around it: a scratch runs through several.
std::vector<std::size_t> with_patches_beside(const PatchRows& patches,
                                             const PatchRows::value_type& patch) {
  constexpr std::size_t kThin = 40;
  const std::array<int, 5>& key = patch.first;
  std::vector<std::size_t> rows = patch.second;
  if (rows.size() > kThin || key[3] < 0) return rows;
  for (int du = -1; du <= 1; ++du)
    for (int dv = -1; dv <= 1; ++dv) {
      const auto beside = patches.find({key[0], key[1], key[2], key[3] + du, key[4] + dv});
      if ((du != 0 || dv != 0) && beside != patches.end() && key[3] + du >= 0 && key[4] + dv >= 0)
        rows.insert(rows.end(), beside->second.begin(), beside->second.end());
    }
  return rows;
}

/// True where the nearest values of a patch lie off as one of them does: a burr or a spot, no accident.
template <class Predicate>
bool neighbours_agree(const Observations& table, const std::vector<std::size_t>& patch, std::size_t i,
                      Predicate agrees) {
  const bool trace = table.rows[i].kind != ObservationKind::kScanFlank;
  const std::size_t asked = trace ? 3 : 4, needed = 2;
  if (patch.size() <= asked) return false;
  const Place& place = table.place(table.rows[i]);
  std::vector<std::pair<double, std::size_t>> near;
  near.reserve(patch.size());
  for (const std::size_t other : patch) {
    if (other == i) continue;
    const Place& at = table.place(table.rows[other]);
    near.emplace_back(std::hypot(at.roll_mm - place.roll_mm, at.z_mm - place.z_mm), other);
  }
  std::nth_element(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(asked), near.end());
  return static_cast<std::size_t>(
             std::count_if(near.begin(), near.begin() + static_cast<std::ptrdiff_t>(asked),
                           [&](const auto& n) { return agrees(n.second); })) >= needed;
}

/// Leaves out what lies far from its neighbours on the same flank: an effect moves them together.
void leave_out_outliers(const FlankGeometry& geometry, Observations& table) {
  std::vector<std::pair<std::array<int, 5>, std::vector<std::size_t>>> gathered;
  constexpr int kMostSources = 1 << 24;  // more files than anybody gives, so that kinds stay apart
  std::unordered_map<std::uint64_t, std::size_t> numbers;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    if (row.kind == ObservationKind::kIndex || row.kind == ObservationKind::kRadial ||
        row.kind == ObservationKind::kSize)
      continue;
    const Place& place = table.place(row);
    const auto part = [](double c, int parts) {
      return std::clamp(static_cast<int>(0.5 * (c + 1.0) * parts), 0, parts - 1);
    };
    const bool flank = place.surface == Surface::kFlank;
    const bool trace = row.kind == ObservationKind::kProfile || row.kind == ObservationKind::kHelix;
    const int u = flank ? part(geometry.profile_coordinate(place.roll_mm), trace ? 6 : 4) : 0;
    const int v = part(geometry.face_coordinate(place.z_mm), trace ? 6 : 4);
    const int tooth = place.surface == Surface::kBore
                          ? static_cast<int>(wrapped_rad(place.polar_rad) / kTwoPi * 16)
                          : place.tooth;
    const std::array<int, 5> key{static_cast<int>(row.kind) * kMostSources + row.source, tooth,
                                 place.side, u, v};
    // side, u and v have less than eight values each
    const std::uint64_t packed = (static_cast<std::uint64_t>(key[0]) << 32U) +
                                 static_cast<std::uint64_t>(tooth) * 512U +
                                 static_cast<std::uint64_t>((place.side + 1) * 64 + u * 8 + v);
    const auto [number, is_new] = numbers.emplace(packed, gathered.size());
    if (is_new) gathered.push_back({key, {}});
    gathered[number->second].second.push_back(i);
  }
  PatchRows patches(std::make_move_iterator(gathered.begin()),
                    std::make_move_iterator(gathered.end()));
  gather_small_patches(patches);
  // One spread for each kind: the median of the patches' own.
  std::map<int, std::vector<double>> spreads;
  std::map<int, double> spread_of;
  std::vector<double> values;
  const auto centre_and_spread = [&](const std::vector<std::size_t>& patch) {
    values.clear();
    for (const std::size_t i : patch) values.push_back(table.rows[i].deviation_um);
    const double centre = median(values);
    for (double& value : values) value = std::abs(value - centre);
    return std::pair(centre, 1.4826 * median(values));
  };
  for (const auto& [key, patch] : patches)
    if (patch.size() >= kFewInPatch) spreads[key[0]].push_back(centre_and_spread(patch).second);
  for (auto& [kind, list] : spreads) spread_of[kind] = median(list);
  std::vector<bool> out(table.rows.size(), false);
  for (const auto& [key, patch] : patches) {
    if (patch.size() < kFewInPatch) continue;
    const auto [centre, own] = centre_and_spread(patch);
    // A patch full of outliers must not set its own limit.
    const double kind = std::max(spread_of[key[0]], 0.02);
    const double limit = 6.0 * std::clamp(own, kind, 3.0 * kind);
    std::vector<std::size_t> far;
    for (const std::size_t i : patch)
      if (std::abs(table.rows[i].deviation_um - centre) > limit) far.push_back(i);
    // Many that agree with each other are no accident: a step runs through the patch.
    const bool step = far.size() >= 3 && 4 * far.size() > patch.size() &&
                      centre_and_spread(far).second < 0.5 * limit;
    const std::vector<std::size_t> beside =
        far.empty() ? patch : with_patches_beside(patches, {key, patch});
    const auto above = [&, middle = centre](std::size_t i) { return table.rows[i].deviation_um - middle; };
    for (const std::size_t i : far)
      out[i] = !step && !neighbours_agree(table, beside, i, [&](std::size_t other) {
        return std::abs(above(other)) > 0.5 * limit && (above(other) > 0.0) == (above(i) > 0.0);
      });
  }
  std::size_t kept = 0;
  std::size_t points = 0;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (out[i]) continue;
    if (i < table.points_mm.size()) table.points_mm[points++] = table.points_mm[i];
    table.rows[kept++] = table.rows[i];
  }
  table.points_mm.resize(points);
  table.outliers = static_cast<int>(table.rows.size() - kept);
  table.rows.resize(kept);
}

}  // namespace

ResultAll<Observations> make_observations(const FlankGeometry& geometry, const MeasuredData& data,
                                          const ObservationOptions& options) {
  TableBuilder builder(geometry, options);
  builder.table.notes = data.notes;
  int source = 0;
  for (const ScanData& scan : data.scans) builder.add_scan(scan, source++);
  for (const InspectionData& inspection : data.inspections)
    builder.add_inspection(inspection, source++);
  for (const SizeData& sizes : data.sizes) builder.add_sizes(sizes, source++);
  builder.refuse_too_many_single_values();
  if (!builder.errors.empty()) return fail_all(std::move(builder.errors));
  leave_out_outliers(geometry, builder.table);
  return std::move(builder.table);
}

}  // namespace trueflank::loop

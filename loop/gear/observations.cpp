// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/observations.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>

#include "trueflank/base/large_pages.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/threads.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/tooth_span.h"
#include "trueflank/loop/gear/local/measured_lands.h"
#include "trueflank/loop/gear/table/canonical_order.h"
#include "trueflank/loop/gear/table/lines_across.h"
#include "trueflank/loop/gear/table/odd_rows.h"
#include "trueflank/loop/gear/table/outliers.h"
#include "trueflank/loop/gear/table/size_scatter.h"
#include "trueflank/loop/gear/table/trace_zeros.h"
#include "trueflank/loop/gear/table/zeros_at_places.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {
namespace {

/// Counts the rows of a file that cannot be of this gear. Where they are many the file is another
/// gear's, and what is left of it would tell nothing about this one.
class ForeignRows {
 public:
  void judge(int line, const std::string& why) {
    if (why.empty()) return;
    if (count_++ == 0) first_ = {line, why};
  }
  [[nodiscard]] bool refuses(std::size_t rows, const std::string& file, Errors& errors) const {
    constexpr std::size_t kOneSlipIn = 10;  // one in so many may be a slip
    if (count_ * kOneSlipIn <= rows) return false;
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

  /// Its points are taken out of the scan.
  void add_scan(ScanData& scan, int source) {
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
    if (!fits(quality)) {
      errors.push_back(
          {.code = ErrorCode::kInconsistent,
           .message = std::string("the scan does not fit the gear as designed") +
                      (options_.aligned ? ": " : " in any pose that was tried: in the best one ") +
                      trimmed_number(std::round(1000.0 * quality.share) / 10.0) +
                      " % of its points in the ring of the teeth lie near a flank" +
                      (options_.aligned ? ", taken as aligned" : ""),
           .remedy = options_.aligned ? remedy_of_aligned(scan) : kRemedyOfPose,
           .file = scan.file});
      return;
    }
    constexpr double kSomeBeside = 0.05;
    if (quality.beside_face > kSomeBeside)
      table.notes.push_back(
          scan.file + printed(": about %.2g %% of its points stand above or below the teeth of "
                              "this gear, on the rest of the part, and are left out",
                              100.0 * quality.beside_face));
    table.poses.push_back(pose);
    table.pose_is_free.push_back(!options_.aligned);
    add_points(scan, pose, source);
  }

  static constexpr const char* kRemedyOfPose =
      "check --gear, the design and the unit (mm); a scan of a few teeth may not show its pose: "
      "scan "
      "more teeth, best all around, or give it in the gear's frame with --aligned";

  [[nodiscard]] bool fits(const PoseQuality& quality) const {
    return quality.share > 0.2 && quality.median_mm < 0.15 * geometry_.gear().normal_module_mm;
  }

  /// For a scan that does not fit as it stands: how it would have to be moved to fit, if that helps.
  [[nodiscard]] std::string remedy_of_aligned(const ScanData& scan) const {
    const auto pose = fit_pose(geometry_, scan);
    if (!pose || !fits(pose_quality(geometry_, scan, *pose)))
      return "check --gear, the design and the unit (mm)";
    const double lean_rad = std::acos(std::clamp(pose->rotation(2, 2), -1.0, 1.0));
    const Eigen::Vector3d middle(0.0, 0.0, 0.5 * geometry_.face_width_mm());
    const Eigen::Vector3d stands = pose->rotation.transpose() * (middle - pose->translation_mm) - middle;
    return printed("leave out --aligned: moved freely it fits, its axis leaning by %.3g degrees and its middle "
                   "off by %.3g mm across and %.3g mm along the axis; one that leans as far in truth is "
                   "compared without its lean then",
                   deg_from_rad(lean_rad), std::hypot(stands.x(), stands.y()), stands.z());
  }

  void add_inspection(const InspectionData& data, int source) {
    BadLines bad(data.file);
    ForeignRows foreign;
    const std::size_t before = table.rows.size(), first_place = table.places.size();
    table.files.push_back(data.file);
    InspectionData of_gear;
    of_gear.common_zero = data.common_zero;
    std::copy_if(data.rows.begin(), data.rows.end(), std::back_inserter(of_gear.rows),
                 [&](const InspectionRow& row) { return foreign_row(row).empty(); });
    for (const RecordKind kind : {RecordKind::kProfile, RecordKind::kHelix}) {
      const std::optional<double> scatter_um = zeros_at_places_um(of_gear, kind);
      own_zeros_[static_cast<std::size_t>(kind)] = scatter_um.has_value();
      if (scatter_um)
        table.notes.push_back(
            data.file + ": every " +
            std::string(kind == RecordKind::kProfile ? "profile" : "helix") +
            " trace is taken with a zero of its own: the zeros of one flank at several " +
            (kind == RecordKind::kProfile ? "heights" : "diameters") +
            printed(" scatter by %.2g um", *scatter_um));
    }
    for (const InspectionRow& row : data.rows) {
      const std::string wrong = add_inspection_row(data, row, source);
      if (!wrong.empty()) bad.add(row.line, wrong);
      foreign.judge(row.line, foreign_row(row));
    }
    table.traces = zeros_.count();
    if (foreign.refuses(data.rows.size(), data.file, errors)) return;
    if (table.rows.size() == before) {
      errors.push_back(bad.error("no row of the file fits this gear"));
      return;
    }
    if (!data.from_design) take_design_off(before);
    if (table.files.size() <= std::numeric_limits<std::uint8_t>::max())
      for (std::size_t p = first_place; p < table.places.size(); ++p)
        table.places[p].file = static_cast<std::uint8_t>(table.files.size());
    bad.tell(table.notes);
  }

  /// A value of index or runout is an observation of its own, 30 kB in the fit; a size has places
  /// on all teeth.
  void refuse_too_many_single_values() {
    constexpr std::size_t kMostValues = 20'000, kMostSizes = 2'000;
    const auto refuse = [&](std::size_t count, std::size_t most, const std::string& of_what) {
      if (count <= most) return;
      errors.push_back({.code = ErrorCode::kUnsupported,
                        .message = std::to_string(count) + " " + of_what + "; " +
                                   std::to_string(most) + " are the most",
                        .remedy = "means of repeated measurements"});
    };
    refuse(index_values_, kMostValues, "values of index and radial runout");
    refuse(sizes_.size(), kMostSizes, "sizes");
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

  void put_rows_in_order() {
    const std::vector<std::size_t> new_place = loop::put_rows_in_order(table);
    for (SizeInTable& size : sizes_) size.row = new_place[size.row - table.points_mm.size()];
    std::sort(sizes_.begin(), sizes_.end(),
              [](const SizeInTable& a, const SizeInTable& b) { return a.row < b.row; });
  }

  void widen_size_errors() {
    std::string note = loop::widen_size_errors(geometry_, sizes_, table);
    if (!note.empty()) table.notes.push_back(std::move(note));
  }

  Observations table;
  Errors errors;

 private:
  Observation& add_row(ObservationKind kind, double deviation_um, double sigma_um, int source) {
    if (kind == ObservationKind::kIndex || kind == ObservationKind::kRadial) ++index_values_;
    Observation row;
    row.kind = kind;
    row.deviation_um = deviation_um;
    row.source = source;
    row.first_place = static_cast<std::uint32_t>(table.places.size());
    row.places = 0;
    if (!std::isnan(sigma_um)) {
      table.sigmas_um.resize(row.first_place + std::size_t{1}, kNaN);
      table.sigmas_um.back() = sigma_um;
    }
    table.rows.push_back(row);
    return table.rows.back();
  }
  /// Machines draw traces against the plain involute and helix, sizes are compared with the plain
  /// gear's: what the design itself relieves is no deviation.
  void take_design_off(std::size_t from) {
    for (std::size_t i = from; i < table.rows.size(); ++i) {
      Observation& row = table.rows[i];
      for (std::uint32_t k = 0; k < row.places; ++k) {
        const Place& place = table.places[row.first_place + k];
        row.deviation_um -= row.weight * um_from_mm(geometry_.designed_deviation_mm(place));
      }
    }
  }
  /// All places of a row have the same weight.
  void add_place(Observation& row, const Place& place, double weight) {
    table.places.push_back(place);
    row.weight = weight;
    ++row.places;
  }

  void add_points(ScanData& scan, const Pose& pose, int source) {
    const double reach = kReachOfNearest * geometry_.gear().normal_module_mm;
    const double chamfer = geometry_.edge_chamfer_mm();
    const double edge = std::clamp(0.01 * geometry_.face_width_mm(), 0.02, 0.1) + chamfer;
    const double b = geometry_.face_width_mm();
    const MeasuredLands lands(geometry_, scan, pose, reach);
    std::vector<std::array<double, 3>> points = std::move(scan.points_mm);
    // growing would leave up to as much again unused
    table.rows.reserve(table.rows.size() + points.size());
    table.places.reserve(table.places.size() + points.size());
    ask_for_large_pages(table.rows.data() + table.rows.size(), points.size() * sizeof(Observation));
    ask_for_large_pages(table.places.data() + table.places.size(), points.size() * sizeof(Place));
    // Without normals, points at the very ends of the face may lie on the end faces.
    const double inside = scan.normals.empty() || chamfer > 0.0 ? edge : -edge;
    struct Placed {
      PlacedPoint on;
      bool usable = false;
    };
    const auto is_usable = [&](std::size_t i, const Place& place) {
      const std::array<double, 3>& p = points[i];
      return place.surface != Surface::kNone && p[2] > inside && p[2] < b - inside &&
             !geometry_.near_relief_groove(p[2], inside) && looks_outwards(scan, i, pose, place) &&
             !(place.surface == Surface::kFlank && lands.covers(place, p));
    };
    const auto put_places = [&](std::size_t from, std::span<Placed> to) {
      constexpr std::size_t kTogether = 64;
      std::array<PlacedPoint, kTogether> found;
      for (std::size_t first = 0; first < to.size(); first += kTogether) {
        const std::size_t count = std::min(kTogether, to.size() - first);
        const std::span<std::array<double, 3>> own = std::span(points).subspan(from + first, count);
        for (std::array<double, 3>& point : own) point = pose(point);
        geometry_.nearest(own, reach, found.data());
        for (std::size_t k = 0; k < count; ++k)
          to[first + k] = {found[k], is_usable(from + first + k, found[k].place)};
      }
    };
    // Placed on all processors, some at a time; meanwhile those before are taken in their order.
    constexpr std::size_t kOfWork = 2048, kAtOnce = 16 * kOfWork;
    std::array<std::vector<Placed>, 2> some;
    for (std::vector<Placed>& one : some) one.resize(std::min(kAtOnce, points.size()));
    std::size_t kept = 0;
    const auto take = [&](const std::vector<Placed>& placed_ones, std::size_t from) {
      for (std::size_t k = 0; k < std::min(kAtOnce, points.size() - from); ++k) {
        const Placed& one = placed_ones[k];
        if (!one.usable) continue;
        const double sigma = scan.sigma_um.empty() ? kNaN : scan.sigma_um[from + k];
        Observation& row =
            add_row(kind_of(one.on.place.surface), um_from_mm(one.on.distance_mm), sigma, source);
        add_place(row, one.on.place, 1.0);
        points[kept++] = points[from + k];
      }
    };
    const std::size_t times = (points.size() + kAtOnce - 1) / kAtOnce;
    for (std::size_t time = 0; time <= times && times > 0; ++time) {
      const std::size_t from = time * kAtOnce, taken = time > 0 ? 1 : 0;  // the first piece takes
      const std::size_t count = time < times ? std::min(kAtOnce, points.size() - from) : 0;
      // where they will stand at most
      Observation* const rows = table.rows.data() + table.rows.size() + taken * kAtOnce;
      Place* const places = table.places.data() + table.places.size() + taken * kAtOnce;
      for_each_piece(taken + 1 + (count + kOfWork - 1) / kOfWork, [&](std::size_t piece) {
        if (piece < taken) return take(some[(time - 1) % 2], from - kAtOnce);
        if (piece == taken) {
          make_pages_ready(rows, count * sizeof *rows);
          return make_pages_ready(places, count * sizeof *places);
        }
        const std::size_t first = (piece - taken - 1) * kOfWork;
        put_places(from + first,
                   std::span(some[time % 2]).subspan(first, std::min(count - first, kOfWork)));
      });
    }
    const std::size_t all = points.size(), unused = all - kept;
    if (10 * unused > 7 * all)
      table.notes.push_back(scan.file + ": " + std::to_string(unused) + " of " +
                            std::to_string(all) +
                            " points lie on no flank, tip, root or bore and are not used");
    points.resize(kept);
    if (table.points_mm.empty())
      table.points_mm = std::move(points);
    else
      table.points_mm.insert(table.points_mm.end(), points.begin(), points.end());
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
      case Surface::kTip:
        return ObservationKind::kScanTip;
      case Surface::kRoot:
        return ObservationKind::kScanRoot;
      case Surface::kBore:
        return ObservationKind::kScanBore;
      default:
        return ObservationKind::kScanFlank;
    }
  }

  /// Why a row cannot be of this gear; empty where it can. What lies on the gear but off its flanks
  /// can.
  [[nodiscard]] std::string foreign_row(const InspectionRow& row) const {
    if (row.tooth > geometry_.teeth())
      return "tooth " + std::to_string(row.tooth) + " of a gear with " +
             std::to_string(geometry_.teeth()) + " teeth";
    const double module = geometry_.gear().normal_module_mm;
    if (std::abs(row.deviation_um) > 500.0 * module)
      return "a deviation of " + trimmed_number(row.deviation_um) +
             " um is no deviation of this gear";
    const auto [least, most] = std::minmax({geometry_.tip_radius_mm(), geometry_.root_radius_mm()});
    // A ball in the gap stands further out than the teeth.
    const double reach = row.record == RecordKind::kRadial ? 3.0 * module : 0.3 * module;
    if (0.5 * row.diameter_mm < least - reach || 0.5 * row.diameter_mm > most + reach)
      return "diameter " + trimmed_number(row.diameter_mm) + " mm lies outside this gear's teeth";
    if (std::abs(geometry_.face_coordinate(row.z_mm)) > 1.3)
      return "z " + trimmed_number(row.z_mm) + " mm lies outside this gear's face";
    return {};
  }

  std::string add_inspection_row(const InspectionData& data, const InspectionRow& row,
                                 int source) {
    if (std::string wrong = foreign_row(row); !wrong.empty()) return wrong;
    const double middle_roll = geometry_.roll_at_radius_mm(geometry_.reference_radius_mm());
    double roll = std::isnan(row.diameter_mm) ? middle_roll
                                              : geometry_.roll_at_radius_mm(0.5 * row.diameter_mm);
    if (!std::isnan(row.diameter_to_mm))
      roll += row.fraction * (geometry_.roll_at_radius_mm(0.5 * row.diameter_to_mm) - roll);
    const double z = std::isnan(row.z_mm) ? 0.5 * geometry_.face_width_mm() : row.z_mm;
    const double u = geometry_.profile_coordinate(roll);
    if (row.record != RecordKind::kRadial && std::abs(u) > 1.05)
      return "diameter " + trimmed_number(row.diameter_mm) + " mm is not on the involute";
    if (std::abs(geometry_.face_coordinate(z)) > 1.02)
      return "z " + trimmed_number(z) + " mm is not on the face";
    if (row.record == RecordKind::kRadial) return add_radial(data, row, source, z);
    constexpr std::array kKinds{ObservationKind::kProfile, ObservationKind::kHelix,
                                ObservationKind::kIndex};
    const int side = flank_side(row.flank, geometry_.gear().kind);
    const bool index = row.record == RecordKind::kIndex;
    const TraceZeros::Record record{static_cast<int>(row.record), index ? 0 : row.tooth, side,
                                    source};
    const bool profile = row.record == RecordKind::kProfile;
    const double diameter = 2.0 * std::hypot(geometry_.base_radius_mm(), roll);
    const int trace = data.common_zero ? -1
                      : index          ? zeros_.of(record)
                              : zeros_.of_trace(record, profile ? roll : z, profile ? z : diameter,
                                                own_zeros_[static_cast<std::size_t>(row.record)]);
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

  /// On the flank, or beyond an end by a tenth of it: ends as made differ from the design's.
  [[nodiscard]] bool is_near_flank(double roll_mm) const {
    const auto [low, high] = std::minmax({geometry_.root_form_roll_mm(), geometry_.tip_form_roll_mm()});
    const double slack = 0.1 * (high - low);
    return roll_mm >= low - slack && roll_mm <= high + slack;
  }

  /// Ball in the gap after a tooth: it is pushed out by the mean of both flanks over sin(a_M).
  std::string add_radial(const InspectionData& data, const InspectionRow& row, int source,
                         double z) {
    const bool is_told = data.ball_diameter_mm > 0.0;
    const double ball = is_told ? data.ball_diameter_mm : recommended_pin_diameter_mm(geometry_.gear());
    const auto contact = geometry_.ball_contact(ball);
    if (std::isnan(contact.roll_mm) || (is_told && !is_near_flank(contact.roll_mm)))
      return "a ball of " + trimmed_number(ball) + " mm touches no flank of this gear";
    const int trace =
        data.common_zero ? -1 : zeros_.of({static_cast<int>(row.record), 0, 0, source});
    Observation& added =
        add_row(ObservationKind::kRadial, row.deviation_um, row.sigma_um, source);
    added.trace = trace;
    const double weight =
        0.5 / (std::sin(contact.centre_angle_rad) * std::cos(geometry_.base_helix_rad()));
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
          return "a span over " + trimmed_number(size.detail) + " teeth of a gear with " +
                 std::to_string(geometry_.teeth());
        nominal = base_tangent_length_mm(geometry_.gear(), static_cast<int>(size.detail));
        roll = 0.5 * nominal * cos_helix;
        weight = 2.0;
        if (std::isnan(nominal)) return "a ring has no span";
        break;
      case SizeQuantity::kOverPins: {
        nominal = over_pins_mm(geometry_.gear(), size.detail);
        if (std::isnan(nominal))
          return "a pin of " + trimmed_number(size.detail) + " mm touches no flank";
        const auto contact = geometry_.ball_contact(size.detail);
        roll = contact.roll_mm;
        const double odd =
            geometry_.teeth() % 2 == 0 ? 1.0 : std::cos(0.5 * kPi / geometry_.teeth());
        weight = geometry_.sense() * 2.0 * odd / (std::sin(contact.centre_angle_rad) * cos_helix);
        break;
      }
      case SizeQuantity::kTipDiameter:
        surface = Surface::kTip;
        radius = geometry_.tip_radius_mm();
        break;
      case SizeQuantity::kRootDiameter:
        surface = Surface::kRoot;
        radius = geometry_.root_radius_mm();
        break;
      case SizeQuantity::kBore:
        surface = Surface::kBore;
        radius = geometry_.bore_radius_mm();
        break;
    }
    if (surface == Surface::kBore && radius <= 0.0) return "the design has no round bore here";
    if (surface != Surface::kFlank) {
      nominal = 2.0 * radius;
      weight = surface == Surface::kBore ? -2.0 : 2.0 * geometry_.sense();
    }
    const double deviation = um_from_mm(size.value_mm - nominal);
    if (std::abs(deviation) > 1000.0 * geometry_.gear().normal_module_mm)
      return "a size of " + trimmed_number(size.value_mm) + " mm, designed " +
             trimmed_number(nominal) + " mm, is no size of this gear";
    sizes_.push_back({table.rows.size(), size.quantity, size.detail});
    Observation& row = add_row(ObservationKind::kSize, deviation, size.sigma_um, source);
    if (surface == Surface::kFlank)
      add_both_flanks(row, roll, weight);
    else
      add_place(row, geometry_.on_circle(surface, 1, 0.0, radius, 0.5 * geometry_.face_width_mm()),
                weight);
    return {};
  }

  const FlankGeometry& geometry_;
  ObservationOptions options_;
  std::size_t index_values_ = 0;
  std::vector<SizeInTable> sizes_;
  TraceZeros zeros_;
  std::array<bool, 2> own_zeros_{};  ///< of profiles and helices at several places of a flank
};

}  // namespace

bool is_traced(const Observations& table) {
  return std::any_of(table.rows.begin(), table.rows.end(), [](const Observation& row) {
    return row.kind == ObservationKind::kProfile || row.kind == ObservationKind::kHelix;
  });
}

void as_designed(const FlankGeometry& geometry, const Observations& table,
                 std::span<const std::size_t> rows, PlacedPoint* found) {
  constexpr std::size_t kAtOnce = 64;
  std::array<std::array<double, 3>, kAtOnce> points;
  for (std::size_t first = 0; first < rows.size(); first += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, rows.size() - first);
    for (std::size_t k = 0; k < count; ++k) points[k] = table.points_mm[rows[first + k]];
    PlacedPoint* const placed = found + first;
    geometry.nearest_flanks({points.data(), count}, kFlankMargin, placed);
    for (std::size_t k = 0; k < count; ++k)
      if (placed[k].place.roll_mm > 0.0) placed[k].place.surface = Surface::kFlank;
  }
}

ResultAll<Observations> make_observations(const FlankGeometry& geometry, MeasuredData data,
                                          const ObservationOptions& options) {
  TableBuilder builder(geometry, options);
  builder.table.notes = data.notes;
  int source = 0;
  for (ScanData& scan : data.scans) builder.add_scan(scan, source++);
  for (std::string& note : leave_out_copies(data.inspections))
    builder.table.notes.push_back(std::move(note));
  for (InspectionData& inspection : data.inspections) {
    for (std::string& note : leave_out_odd_rows(inspection))
      builder.table.notes.push_back(std::move(note));
    builder.add_inspection(inspection, source++);
  }
  for (const SizeData& sizes : data.sizes) builder.add_sizes(sizes, source++);
  builder.refuse_too_many_single_values();
  if (!builder.errors.empty()) return fail_all(std::move(builder.errors));
  builder.put_rows_in_order();
  number_lines(geometry, builder.table);
  builder.widen_size_errors();
  leave_out_outliers(geometry, builder.table);
  return std::move(builder.table);
}

}  // namespace trueflank::loop

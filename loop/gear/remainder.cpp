// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/remainder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>

#include "trueflank/base/number_text.h"
#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/course_scan.h"
#include "trueflank/loop/discovery/ring_scan.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/dents.h"
#include "trueflank/loop/gear/local/flank_spots.h"
#include "trueflank/loop/gear/local/flank_waves.h"
#include "trueflank/loop/gear/local/reading_steps.h"
#include "trueflank/loop/gear/local/remainder_courses.h"
#include "trueflank/loop/gear/local/rotation_waves.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

/// False alarms of all that is looked for along flanks, of that around the gear.
constexpr double kLevel = 0.004;
constexpr int kFewestPlaces = 12, kFewestTeeth = 8;

bool is_of_trace(ObservationKind kind) {
  return kind == ObservationKind::kProfile || kind == ObservationKind::kHelix;
}

class RemainderSearch {
 public:
  RemainderSearch(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
                  const std::vector<float>& row_um, RemainderOf which)
      : geometry_(geometry), table_(table), patches_(patches), row_um_(row_um), which_(which) {}

  std::vector<RemainderFinding> run() {
    // None of the three asks the others.
    auto spots = begun_beside([this] {
      return which_ == RemainderOf::kAll ? spots_of_scans(geometry_, table_, patches_, row_um_)
                                         : std::vector<FlankSpot>();
    });
    auto spectrum = begun_beside([this] { return spectrum_across(); });
    gather();
    for (auto& [key, courses] : courses_) look_along(key, courses);
    if (which_ == RemainderOf::kAll) look_for_spots(spots.get());
    look_across(spectrum.get());
    const auto looks = static_cast<double>(looks_);
    for (RemainderFinding& finding : found_)
      finding.p_value = std::min(1.0, looks * finding.p_value);
    look_over_rotation();
    look_around();
    look_at_flanks_of_teeth();
    std::erase_if(found_, [](const RemainderFinding& f) { return f.p_value > kLevel; });
    std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
      return is_better(a.p_value, a.square, b.p_value, b.square);
    });
    return std::move(found_);
  }

 private:
  /// Values of a tooth that a ring of teeth is asked about: weighted sums of products with low
  /// forms.
  struct Moments {
    std::array<double, 5> sum{}, square{};
    int count = 0;
  };

  [[nodiscard]] static std::size_t moment_at(int side, int tooth) {
    return 2 * static_cast<std::size_t>(tooth) + static_cast<std::size_t>(side);
  }

  Courses& scan_courses_of(int source, bool face) {
    Courses& courses = courses_[{source, ObservationKind::kScanFlank, face}];
    courses.low = face ? 0.0 : geometry_.root_form_roll_mm();
    courses.high = face ? geometry_.face_width_mm() : geometry_.tip_form_roll_mm();
    return courses;
  }
  std::vector<Moments>& moments_of(int what, int source) {
    std::vector<Moments>& moments = moments_[{what, source}];
    moments.resize(2 * static_cast<std::size_t>(geometry_.teeth() + 1));
    return moments;
  }

  /// Where the values of a scan are gathered.
  struct OfScan {
    Courses *profile = nullptr, *face = nullptr;
    std::vector<Moments>* moments = nullptr;
  };

  struct OfCourse {
    std::vector<RemainderSample> profile, face;
    std::vector<Moments> moments;  ///< of the teeth of one side
  };

  /// One course of one scan: a class of rows.
  struct Course {
    const OfScan* scan = nullptr;
    int side = 0, course = 0;
  };

  /// Teeth of scans are gathered to few courses, each dense enough. Courses do not ask each other:
  /// the same sums on any number of processors.
  void gather() {
    std::map<int, OfScan> of_source;
    std::map<std::array<int, 3>, int> numbers;  // of source, side and course
    std::vector<Course> courses;
    constexpr int kOther = -2, kNone = -1;
    std::vector<int> class_of(patches_.patches.size(), kNone);
    for (std::size_t p = 0; p < class_of.size(); ++p) {
      const Patches::Patch& patch = patches_.patches[p];
      if (!is_asked(patch)) continue;
      class_of[p] = kOther;
      if (patch.kind != ObservationKind::kScanFlank) continue;
      const Place& place = patch.places.front().place;
      const int side = place.side > 0 ? 1 : 0,
                course = place.tooth % std::min(kScanCourses, geometry_.teeth());
      const auto [number, is_new] =
          numbers.emplace(std::array{patch.source, side, course}, static_cast<int>(courses.size()));
      class_of[p] = number->second;
      if (is_new) courses.push_back({&opened(of_source, patch.source, side, course), side, course});
    }
    const RowsByClass rows(table_.rows.size(), courses.size() + 1, [&](std::size_t i) {
      const int patch = patches_.patch_of_row[i];
      const int number = patch < 0 ? kNone : class_of[static_cast<std::size_t>(patch)];
      return number == kOther ? static_cast<int>(courses.size()) : number;
    });
    for_each_piece(courses.size(), [&](std::size_t k) { gather_course(rows, k, courses[k]); });
    for (auto& [source, scan] : of_source)
      for (Courses* all : {scan.profile, scan.face}) all->count_cells();
    const ReadingSteps steps(table_, row_um_);
    rows.for_each(courses.size(), [&](std::size_t i) {
      if (!is_used(i)) return;
      gather_other(i, row_um_[i] + steps.spread_um(table_, i));
      if (const double wide = steps.wide_spread_um(table_, i); wide != 0.0)
        add_to_courses(i, row_um_[i] + wide, coarse_courses_);
    });
  }

  const OfScan& opened(std::map<int, OfScan>& of_source, int source, int side, int course) {
    OfScan& scan = of_source[source];
    if (scan.profile == nullptr)
      scan = {&scan_courses_of(source, false), &scan_courses_of(source, true),
              &moments_of(kScans, source)};
    scan.profile->open(side, course);
    scan.face->open(side, course);
    return scan;
  }

  /// Teeth have their sums side by side: they are added up apart, lest processors wait for each
  /// other's memory.
  void gather_course(const RowsByClass& rows, std::size_t of_class, const Course& of) const {
    const auto flank = static_cast<std::size_t>(of.side);
    std::vector<RemainderSample>&profile = of.scan->profile->of_flank[flank].at(of.course),
    &face = of.scan->face->of_flank[flank].at(of.course);
    OfCourse sums{profile, face,
                  std::vector<Moments>(static_cast<std::size_t>(geometry_.teeth()) + 1)};
    rows.for_each(of_class, table_, [&](std::size_t i) {
      add_scanned(table_.place(table_.rows[i]), row_um_[i], sums);
    });
    profile = std::move(sums.profile);
    face = std::move(sums.face);
    for (int tooth = 1; tooth <= geometry_.teeth(); ++tooth)
      if (const Moments& own = sums.moments[static_cast<std::size_t>(tooth)]; own.count > 0)
        (*of.scan->moments)[moment_at(of.side, tooth)] = own;
  }

  void add_scanned(const Place& place, double um, OfCourse& to) const {
    const double u = geometry_.profile_coordinate(place.roll_mm),
                 v = geometry_.face_coordinate(place.z_mm);
    const std::array<double, 5> form = forms_at(u, v);
    Moments& of_tooth = to.moments[static_cast<std::size_t>(place.tooth)];
    ++of_tooth.count;
    for (std::size_t k = 0; k < form.size(); ++k) {
      of_tooth.sum[k] += form[k] * um;
      of_tooth.square[k] += form[k] * form[k];
    }
    Courses::add_to_cell(to.profile, 0.5 * (u + 1.0), um);
    Courses::add_to_cell(to.face, 0.5 * (v + 1.0), um);
  }

  void gather_other(std::size_t i, double um) {
    const Observation& row = table_.rows[i];
    add_moments(row, table_.place(row), um);
    if (is_of_trace(row.kind)) add_to_courses(i, um, courses_);
  }

  void add_to_courses(std::size_t i, double um, std::map<CourseKey, Courses>& courses) {
    const Observation& row = table_.rows[i];
    const Place& place = table_.place(row);
    const bool helix = row.kind == ObservationKind::kHelix;
    courses[{row.source, row.kind, helix}].add(place.side > 0 ? 1 : 0,
                                               row.trace >= 0 ? row.trace : place.tooth,
                                               place.tooth, helix ? place.z_mm : place.roll_mm, um);
  }

  static std::array<double, 5> forms_at(double u, double v) {
    return {1.0, u, v, u * u - 1.0 / 3.0, v * v - 1.0 / 3.0};
  }

  /// Of values that are no scan's.
  void add_moments(const Observation& row, const Place& place, double um) {
    if (row.kind == ObservationKind::kRadial) return;
    const std::array<double, 5> form = forms_at(geometry_.profile_coordinate(place.roll_mm),
                                                geometry_.face_coordinate(place.z_mm));
    const bool profile = row.kind == ObservationKind::kProfile,
               helix = row.kind == ObservationKind::kHelix;
    Moments& of_tooth = moments_of(profile ? kProfiles
                                   : helix ? kHelices
                                           : 3,
                                   row.source)[moment_at(place.side > 0 ? 1 : 0, place.tooth)];
    ++of_tooth.count;
    for (std::size_t k = 0; k < form.size(); ++k) {
      // A trace shows its own direction; with a zero of its own no height.
      if (k == 0 && row.trace >= 0 && row.kind != ObservationKind::kIndex) continue;
      if ((k == 1 || k == 3) && (helix || row.kind == ObservationKind::kIndex)) continue;
      if ((k == 2 || k == 4) && (profile || row.kind == ObservationKind::kIndex)) continue;
      of_tooth.sum[k] += form[k] * um;
      of_tooth.square[k] += form[k] * form[k];
    }
  }

  /// One flank's courses as columns, of the flanks that have any.
  struct CourseSets {
    std::array<std::vector<int>, 2> members;
    std::vector<Eigen::MatrixXd> sets;
    std::vector<int> side_of;
  };
  static CourseSets sets_of(const Courses& courses, int places) {
    CourseSets result;
    for (const int side : {1, 0}) {
      Eigen::MatrixXd set =
          courses.matrix(side, places, result.members[static_cast<std::size_t>(side)]);
      if (set.cols() == 0) continue;
      result.sets.push_back(std::move(set));
      result.side_of.push_back(side);
    }
    return result;
  }

  /// What runs along the courses. Of values read coarsely single traces are judged spread more
  /// widely.
  [[nodiscard]] std::vector<CourseFinding> findings_along(const CourseKey& key,
                                                          const CourseSets& of, int places) const {
    std::vector<CourseFinding> found = scan_courses(of.sets);
    const auto coarse = coarse_courses_.find(key);
    if (coarse == coarse_courses_.end()) return found;
    const auto is_spot = [](const CourseFinding& f) {
      return f.kind == CourseFinding::Kind::kSpot;
    };
    std::erase_if(found, is_spot);
    for (const CourseFinding& spread : scan_courses(sets_of(coarse->second, places).sets))
      if (is_spot(spread)) found.push_back(spread);
    return found;
  }

  void look_along(const CourseKey& key, const Courses& courses) {
    const bool scan = key.kind == ObservationKind::kScanFlank;
    const int places = courses.places(scan);
    if (places < kFewestPlaces || !(courses.high > courses.low)) return;
    const CourseSets all = sets_of(courses, places);
    if (all.sets.empty()) return;
    looks_ += 3;  // in common, waves of their own, spots
    for (const CourseFinding& found : findings_along(key, all, places)) {
      if (found.kind == CourseFinding::Kind::kSpot) {
        if (scan || which_ != RemainderOf::kAll) continue;
        const int side = all.side_of[static_cast<std::size_t>(found.set)];
        const int course =
            all.members[static_cast<std::size_t>(side)][static_cast<std::size_t>(found.course)];
        add_spot_of_trace(key, courses, places, found, side,
                          courses.tooth_of[static_cast<std::size_t>(side)].at(course));
      } else {
        add_course(key, courses, places, found,
                   found.set < 0 ? -1 : all.side_of[static_cast<std::size_t>(found.set)]);
      }
    }
  }

  /// A place along the flank as people say it: a height, or a diameter.
  [[nodiscard]] double place_mm(bool face, double at) const {
    return face ? at : 2.0 * geometry_.on_flank(1, 1, at, 0.0).radius_mm;
  }

  static FlankChoice flank_choice(const FlankGeometry& g, int side) {
    return side < 0                          ? FlankChoice::kBoth
           : (side > 0) == (g.sense() > 0.0) ? FlankChoice::kLeft
                                             : FlankChoice::kRight;
  }

  void add(const char* family, FlankChoice flank, EffectShape shape, double p_value, double amount,
           bool local, double square = 0.0) {
    RemainderFinding finding{
        p_value, {}, square, amount, Effect{find_family(family), flank, std::move(shape)}, local};
    finding.text = words_of(*finding.effect, amount);
    found_.push_back(std::move(finding));
  }

  /// What is no form that could be a column.
  void add_text(double p_value, std::string text, double amount) {
    found_.push_back({.p_value = p_value, .text = std::move(text), .amount_um = amount});
  }

  static std::string words_of(const Effect& effect, double amount) {
    const char* on = effect.family->flank_only || effect.flank == FlankChoice::kBoth ? ""
                     : effect.flank == FlankChoice::kLeft ? ", left flanks"
                                                          : ", right flanks";
    return effect.family->words(effect.shape, effect.flank) + on + printed(", %.3g um", amount);
  }

  void add_course(const CourseKey& key, const Courses& courses, int places,
                  const CourseFinding& found, int side) {
    const double face = key.face ? 1.0 : 0.0;
    const FlankChoice flank = flank_choice(geometry_, side);
    const double at =
        place_mm(key.face, std::clamp(courses.place(found.at, places), courses.low, courses.high));
    const double width = courses.length(found.width, places);
    using Kind = CourseFinding::Kind;
    switch (found.kind) {
      case Kind::kStep:
        add("unnamed_step", flank, {face, at}, found.p_value, found.amount, false, found.square);
        break;
      case Kind::kBand:
        add("unnamed_band", flank, {face, at, width}, found.p_value, found.amount, false,
            found.square);
        break;
      case Kind::kWave:
        add("unnamed_waviness", flank, {face, width}, found.p_value, found.amount, false,
            found.square);
        break;
      default:
        add_text(
            found.p_value,
            printed(
                "waves over the %s, %.3g mm long, %.3g um, in a phase of its own on every tooth",
                key.face ? "face" : "profile", width, found.amount) +
                (side < 0                      ? ""
                 : flank == FlankChoice::kLeft ? ", left flanks"
                                               : ", right flanks"),
            found.amount);
    }
  }

  void add_spot_of_trace(const CourseKey& key, const Courses& courses, int places,
                         const CourseFinding& found, int side, int tooth) {
    const double at = courses.place(found.at, places),
                 half = 0.5 * courses.length(found.width, places);
    const double middle = 0.5 * geometry_.face_width_mm();
    EffectShape shape =
        key.face
            ? EffectShape{double(tooth), 2.0 * geometry_.reference_radius_mm(), at, 0.0, 2.0 * half}
            : EffectShape{double(tooth), place_mm(false, at), middle,
                          2.0 * half * gear_effects::along_profile(geometry_, at), 0.0};
    add("unnamed_spot", flank_choice(geometry_, side), std::move(shape), found.p_value,
        found.amount, true);
  }

  void look_for_spots(const std::vector<FlankSpot>& spots) {
    ++looks_;
    for (const FlankSpot& spot : spots)
      add("unnamed_spot", flank_choice(geometry_, spot.side > 0 ? 1 : 0),
          {double(spot.tooth), place_mm(false, spot.roll_mm), spot.height_mm,
           2.0 * spot.half_profile_mm * gear_effects::along_profile(geometry_, spot.roll_mm),
           2.0 * spot.half_face_mm},
          spot.p_value, spot.amount_um, true);
  }

  [[nodiscard]] FlankSpectrum spectrum_across() const {
    if (table_.points_mm.empty()) return {};
    std::vector<bool> used(table_.rows.size());
    for (std::size_t i = 0; i < used.size(); ++i) used[i] = is_used(i);
    return flank_spectrum(geometry_, table_, row_um_, used);
  }

  /// Waves across the flanks of scans, and flanks that stand each by itself.
  void look_across(const FlankSpectrum& spectrum) {
    if (table_.points_mm.empty()) return;
    looks_ += 2;
    if (const auto& wave = spectrum.waves)
      add("unnamed_marks", flank_choice(geometry_, wave->side > 0 ? 1 : 0),
          {wave->waves_profile, wave->waves_face, double(wave->order)}, wave->p_value,
          wave->amplitude_um, false);
    if (const auto& apart = spectrum.apart)
      add_text(apart->p_value,
               printed("the flanks stand each by itself, with a standard deviation of %.3g um from "
                       "tooth to tooth",
                       apart->spread_um),
               apart->spread_um);
  }

  /// Waves over the generating rotation that are no candidates: of one flank, or of higher orders.
  void look_over_rotation() {
    if (std::none_of(patches_.patches.begin(), patches_.patches.end(), [](const auto& patch) {
          return patch.kind == ObservationKind::kProfile;
        }))
      return;  // it is traces that are asked
    std::vector<bool> used(table_.rows.size());
    for (std::size_t i = 0; i < used.size(); ++i) used[i] = is_used(i);
    const RotationWave wave = likeliest_rotation_wave(geometry_, table_, row_um_, used);
    if (wave.order == 0 || wave.p_value > kLevel ||
        (wave.side == 0 && wave.order <= gear_effects::most_ghost_order(geometry_)))
      return;
    const FlankChoice flank =
        wave.side == 0 ? FlankChoice::kBoth : flank_choice(geometry_, wave.side > 0 ? 1 : 0);
    for (const EffectFamily& family : effect_library())
      if (family.id == "ghost_order" && family.of_traces_only == wave.backwards)
        found_.push_back({.p_value = wave.p_value,
                          .text = family.description + " (order " + std::to_string(wave.order) +
                                  printed("), %.3g um", wave.amplitude_um),
                          .amount_um = wave.amplitude_um,
                          .effect = Effect{&family, flank, {double(wave.order)}}});
  }

  /// Height, slope and bow of every tooth, in a ring: both flanks together, or the one measured.
  void look_around() {
    for (const auto& [key, of_teeth] : moments_) {
      std::array<std::vector<int>, 3> teeth;  // with right flanks, left flanks, both
      for (int tooth = 1; tooth <= geometry_.teeth(); ++tooth) {
        const bool right = of_teeth[moment_at(0, tooth)].count > 0,
                   left = of_teeth[moment_at(1, tooth)].count > 0;
        if (right) teeth[0].push_back(tooth);
        if (left) teeth[1].push_back(tooth);
        if (right && left) teeth[2].push_back(tooth);
      }
      if (static_cast<int>(teeth[2].size()) >= kFewestTeeth)
        look_around(key, of_teeth, teeth[2], -1);
      else
        for (const int side : {0, 1})
          if (static_cast<int>(teeth[static_cast<std::size_t>(side)].size()) >= kFewestTeeth)
            look_around(key, of_teeth, teeth[static_cast<std::size_t>(side)], side);
    }
  }

  /// Slopes and bows of traces that differ from tooth to tooth, alike or opposite on both flanks of
  /// each: noise knows of one trace only, however it hangs together within it.
  void look_at_flanks_of_teeth() {
    constexpr int kForms = 2;  // of a trace's own direction
    const auto looks = static_cast<double>(kForms * moments_.size());
    for (const auto& [key, of_teeth] : moments_) {
      if (key.first != kProfiles && key.first != kHelices) continue;
      for (const int form : key.first == kProfiles ? std::array{1, 3} : std::array{2, 4}) {
        const auto [right, left] = values_of_both_flanks(of_teeth, form);
        const double p_value = std::min(1.0, looks * chance_of_agreement(right, left));
        if (p_value > kLevel) continue;
        const bool opposite =
            (right.array() - right.mean()).matrix().dot((left.array() - left.mean()).matrix()) < 0.0;
        const Eigen::VectorXd common = 0.5 * (left + (opposite ? -1.0 : 1.0) * right);
        const double spread = std::sqrt((common.array() - common.mean()).square().mean());
        add_text(p_value,
                 printed("a %s over the %s of its own on every tooth, %s both its flanks, with a "
                         "standard deviation of %.3g um",
                         form < 3 ? "slope" : "bow", key.first == kProfiles ? "profile" : "face",
                         opposite ? "opposite on" : "alike on", (form < 3 ? 2.0 : 1.0) * spread),
                 (form < 3 ? 2.0 : 1.0) * spread);
      }
    }
  }

  /// A form of the teeth of which both flanks were measured.
  static std::array<Eigen::VectorXd, 2> values_of_both_flanks(const std::vector<Moments>& of_teeth,
                                                              int form) {
    const auto k = static_cast<std::size_t>(form);
    std::array<std::vector<double>, 2> values;
    for (std::size_t at = 0; at + 1 < of_teeth.size(); at += 2) {
      if (!(of_teeth[at].square[k] > 0.0) || !(of_teeth[at + 1].square[k] > 0.0)) continue;
      for (const std::size_t side : {0, 1})
        values[side].push_back(of_teeth[at + side].sum[k] / of_teeth[at + side].square[k]);
    }
    const auto vector = [](const std::vector<double>& of) {
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXd>(of.data(), static_cast<Eigen::Index>(of.size())));
    };
    return {vector(values[0]), vector(values[1])};
  }

  /// One form of all teeth: a column of the ring.
  struct Series {
    int form = 0;
    bool opposite = false;
    FlankChoice flank = FlankChoice::kBoth;
  };

  /// The form of a tooth on one side (0 right, 1 left), or of both together.
  static std::optional<double> value_of(const std::vector<Moments>& of_teeth, int tooth, int side,
                                        const Series& series) {
    const auto k = static_cast<std::size_t>(series.form);
    const Moments& right = of_teeth[moment_at(0, tooth)];
    const Moments& left = of_teeth[moment_at(1, tooth)];
    if ((side != 1 && !(right.square[k] > 0.0)) || (side != 0 && !(left.square[k] > 0.0)))
      return {};
    if (side == 0) return right.sum[k] / right.square[k];
    if (side == 1) return left.sum[k] / left.square[k];
    return 0.5 * (left.sum[k] / left.square[k] +
                  (series.opposite ? -1.0 : 1.0) * right.sum[k] / right.square[k]);
  }

  void look_around(const std::pair<int, int>& key, const std::vector<Moments>& of_teeth,
                   const std::vector<int>& teeth, int side) {
    const auto n = static_cast<Eigen::Index>(teeth.size());
    std::vector<Series> what;
    Eigen::MatrixXd series(n, 0);
    for (int form = 0; form < 5; ++form)
      for (const bool opposite : {false, true}) {
        if (opposite && side >= 0) continue;
        const Series one{form, opposite, flank_choice(geometry_, side)};
        Eigen::VectorXd values(n);
        bool known = true;
        for (Eigen::Index i = 0; i < n && known; ++i) {
          const auto value = value_of(of_teeth, teeth[static_cast<std::size_t>(i)], side, one);
          known = value.has_value();
          if (known) values[i] = *value;
        }
        if (!known) continue;
        series.conservativeResize(Eigen::NoChange, series.cols() + 1);
        series.col(series.cols() - 1) = values;
        what.push_back(one);
      }
    if (what.empty()) return;
    std::vector<int> place = teeth;
    for (int& at : place) --at;
    RingFinding found = scan_ring(series, place, geometry_.teeth());
    if (found.series < 0) return;
    found.p_value = std::min(1.0, found.p_value * static_cast<double>(moments_.size()));
    if (found.p_value > kLevel) return;
    add_ring(found, teeth, what[static_cast<std::size_t>(found.series)], key.first == kScans);
  }

  void add_ring(const RingFinding& found, const std::vector<int>& teeth, const Series& series,
                bool scan) {
    const double u = series.form == 1 ? 1.0 : series.form == 3 ? 2.0 : 0.0;
    const double v = series.form == 2 ? 1.0 : series.form == 4 ? 2.0 : 0.0;
    const double turned = series.opposite ? 1.0 : 0.0;
    const auto n = static_cast<int>(teeth.size());
    const auto add_here = [&](const char* family, EffectShape shape) {
      add(family, series.flank, std::move(shape), found.p_value, found.amount, false);
    };
    using Kind = RingFinding::Kind;
    if (found.kind == Kind::kRamp) {
      add_here("unnamed_ramp", {found.first + 1.0, u, v, turned});
    } else if (found.kind == Kind::kComb && found.count > 2) {
      add_here("unnamed_comb", {double(found.count), found.first + 1.0, u, v, turned});
    } else if (found.kind == Kind::kArc) {
      const int first = teeth[static_cast<std::size_t>(found.first)];
      const int last = teeth[static_cast<std::size_t>((found.first + found.count - 1) % n)];
      const int z = geometry_.teeth();
      const int count = ((last - first) % z + z) % z + 1;
      if (scan && add_dent(found, Sector{first, count, v, series.opposite})) return;
      add_here("unnamed_sector", {double(first), double(count), u, v, turned});
    } else if (found.kind == Kind::kComb ||
               (3 * n >= 2 * geometry_.teeth() && 2 * found.order >= geometry_.teeth() - 1)) {
      add_here("unnamed_alternation", {u, v, turned});
    } else if (u < 2.0 && v < 2.0 && series.flank == FlankChoice::kBoth) {
      add_here("unnamed", {u, v, double(found.order), turned});
    } else {
      add_text(found.p_value,
               printed("a wave %d times around the %d teeth measured, %.3g um", found.order, n,
                       found.amount),
               found.amount);
    }
  }

  struct Sector {
    int first = 0, count = 0;
    double face_degree = 0.0;
    bool opposite = false;
  };

  /// A dent in place of a sector, where it takes out more.
  bool add_dent(const RingFinding& found, const Sector& sector) {
    const int z = geometry_.teeth();
    if (3 * sector.count > z) return false;
    std::vector<bool> used(table_.rows.size());
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < used.size(); ++i) {
      used[i] = is_used(i);
      const Place& place = table_.place(table_.rows[i]);
      if (!used[i] || ((place.tooth - sector.first) % z + z) % z >= sector.count) continue;
      const double form = std::pow(geometry_.face_coordinate(place.z_mm), sector.face_degree) *
                          (sector.opposite ? place.side : 1);
      product += form * row_um_[i];
      square += form * form;
    }
    const auto dent = largest_dent(geometry_, table_, row_um_, used);
    if (!dent || !(square > 0.0) || dent->square <= product * product / square) return false;
    add("unnamed_dent",
        dent->side == 0 ? FlankChoice::kBoth : flank_choice(geometry_, dent->side > 0 ? 1 : 0),
        {dent->tooth, dent->half_teeth, dent->height_mm, dent->half_mm}, found.p_value,
        dent->amount_um, false);
    return true;
  }

  [[nodiscard]] bool is_asked(const Patches::Patch& patch) const {
    return which_ != RemainderOf::kTraining || patch.fold != 0;
  }
  /// True for rows that are looked at.
  [[nodiscard]] bool is_used(std::size_t i) const {
    const int patch = patches_.patch_of_row[i];
    if (patch < 0 || !is_asked(patches_.patches[static_cast<std::size_t>(patch)])) return false;
    if (patches_.patches[static_cast<std::size_t>(patch)].kind == ObservationKind::kScanFlank)
      return true;
    return table_.rows[i].places == 1 && table_.place(table_.rows[i]).surface == Surface::kFlank;
  }

  static constexpr int kScans = 0, kProfiles = 1, kHelices = 2;
  const FlankGeometry& geometry_;
  const Observations& table_;
  const Patches& patches_;
  const std::vector<float>& row_um_;
  RemainderOf which_;
  std::map<CourseKey, Courses> courses_;
  std::map<CourseKey, Courses> coarse_courses_;  ///< of values read coarsely, spread widely
  std::map<std::pair<int, int>, std::vector<Moments>> moments_;  ///< of kind and source
  int looks_ = 0;
  std::vector<RemainderFinding> found_;
};

}  // namespace

std::vector<RemainderFinding> look_at_remainder(const FlankGeometry& geometry,
                                                const Observations& table, const Patches& patches,
                                                const std::vector<float>& row_um,
                                                RemainderOf which) {
  return RemainderSearch(geometry, table, patches, row_um, which).run();
}

}  // namespace trueflank::loop

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/remainder_values.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/loudness.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/local/reading_steps.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

bool is_asked(const Patches::Patch& patch, RemainderOf which) {
  return which != RemainderOf::kTraining || patch.fold != 0;
}

class Gathering {
 public:
  Gathering(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
            const std::vector<float>& row_um, RemainderOf which, const std::vector<bool>& used)
      : geometry_(geometry),
        table_(table),
        patches_(patches),
        row_um_(row_um),
        which_(which),
        used_(used) {}

  RemainderValues run() {
    gather();
    return std::move(values_);
  }

 private:
  Courses& scan_courses_of(int source, bool face) {
    Courses& courses = values_.courses[{source, ObservationKind::kScanFlank, face}];
    courses.low = face ? 0.0 : geometry_.root_form_roll_mm();
    courses.high = face ? geometry_.face_width_mm() : geometry_.tip_form_roll_mm();
    return courses;
  }
  std::vector<ToothMoments>& moments_of(MomentsOf what, int source) {
    std::vector<ToothMoments>& moments = values_.moments[{what, source}];
    moments.resize(2 * static_cast<std::size_t>(geometry_.teeth() + 1));
    return moments;
  }

  /// Where the values of a scan are gathered.
  struct OfScan {
    Courses *profile = nullptr, *face = nullptr;
    std::vector<ToothMoments>* moments = nullptr;
  };

  struct OfCourse {
    std::vector<RemainderSample> profile, face;
    std::vector<ToothMoments> moments;  ///< of the teeth of one side
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
      if (!is_asked(patch, which_)) continue;
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
      if (!used_[i]) return;
      gather_other(i, row_um_[i] + steps.spread_um(table_, i));
      if (const double wide = steps.wide_spread_um(table_, i); wide != 0.0)
        add_to_courses(i, row_um_[i] + wide, values_.coarse_courses);
    });
  }

  const OfScan& opened(std::map<int, OfScan>& of_source, int source, int side, int course) {
    OfScan& scan = of_source[source];
    if (scan.profile == nullptr)
      scan = {&scan_courses_of(source, false), &scan_courses_of(source, true),
              &moments_of(MomentsOf::kScan, source)};
    scan.profile->open(side, course);
    scan.face->open(side, course);
    return scan;
  }

  /// Teeth have their sums side by side: they are added up apart, so that processors do not
  /// wait for each other's memory.
  void gather_course(const RowsByClass& rows, std::size_t of_class, const Course& of) const {
    const auto flank = static_cast<std::size_t>(of.side);
    std::vector<RemainderSample>&profile = of.scan->profile->of_flank[flank].at(of.course),
    &face = of.scan->face->of_flank[flank].at(of.course);
    OfCourse sums{profile, face,
                  std::vector<ToothMoments>(static_cast<std::size_t>(geometry_.teeth()) + 1)};
    rows.for_each(of_class, table_, [&](std::size_t i) {
      add_scanned(table_.place(table_.rows[i]), row_um_[i], sums);
    });
    profile = std::move(sums.profile);
    face = std::move(sums.face);
    for (int tooth = 1; tooth <= geometry_.teeth(); ++tooth)
      if (const ToothMoments& own = sums.moments[static_cast<std::size_t>(tooth)]; own.count > 0)
        (*of.scan->moments)[ToothMoments::at(of.side, tooth)] = own;
  }

  void add_scanned(const Place& place, double um, OfCourse& to) const {
    const double u = geometry_.profile_coordinate(place.roll_mm),
                 v = geometry_.face_coordinate(place.z_mm);
    const std::array<double, ToothMoments::kForms> form = ToothMoments::forms_at(u, v);
    ToothMoments& of_tooth = to.moments[static_cast<std::size_t>(place.tooth)];
    of_tooth.add(form, um);
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
    if (is_of_trace(row.kind)) add_to_courses(i, um, values_.courses);
  }

  void add_to_courses(std::size_t i, double um, std::map<CourseKey, Courses>& courses) {
    const Observation& row = table_.rows[i];
    const Place& place = table_.place(row);
    constexpr int kMostLines = 256;
    const bool helix = row.kind == ObservationKind::kHelix;
    const int course = (row.trace >= 0 ? row.trace : place.tooth) * kMostLines + row.line;
    courses[{row.source, row.kind, helix}].add(place.side > 0 ? 1 : 0, course, place.tooth,
                                               helix ? place.z_mm : place.roll_mm, um);
  }

  /// Of values that are no scan's.
  void add_moments(const Observation& row, const Place& place, double um) {
    if (row.kind == ObservationKind::kRadial) return;
    const std::array<double, ToothMoments::kForms> form = ToothMoments::forms_at(
        geometry_.profile_coordinate(place.roll_mm), geometry_.face_coordinate(place.z_mm));
    const bool profile = row.kind == ObservationKind::kProfile,
               helix = row.kind == ObservationKind::kHelix;
    ToothMoments& of_tooth =
        moments_of(profile ? MomentsOf::kProfiles
                   : helix ? MomentsOf::kHelices
                           : MomentsOf::kOthers,
                   row.source)[ToothMoments::at(place.side > 0 ? 1 : 0, place.tooth)];
    of_tooth.add(form, um);
    for (std::size_t k = 0; k < form.size(); ++k) {
      // A trace shows its own direction; with a zero of its own no height.
      if (k == 0 && row.trace >= 0 && row.kind != ObservationKind::kIndex) continue;
      if ((k == 1 || k == 3) && (helix || row.kind == ObservationKind::kIndex)) continue;
      if ((k == 2 || k == 4) && (profile || row.kind == ObservationKind::kIndex)) continue;
      of_tooth.sum[k] += form[k] * um;
      of_tooth.square[k] += form[k] * form[k];
    }
  }

  const FlankGeometry& geometry_;
  const Observations& table_;
  const Patches& patches_;
  const std::vector<float>& row_um_;
  RemainderOf which_;
  const std::vector<bool>& used_;
  RemainderValues values_;
};

}  // namespace

std::vector<bool> rows_looked_at(const Observations& table, const Patches& patches,
                                 RemainderOf which) {
  enum class Rows : std::uint8_t { kNone, kAll, kOnFlanks };
  std::vector<Rows> of_patch(patches.patches.size(), Rows::kNone);
  for (std::size_t p = 0; p < of_patch.size(); ++p)
    if (const Patches::Patch& patch = patches.patches[p]; is_asked(patch, which))
      of_patch[p] = patch.kind == ObservationKind::kScanFlank ? Rows::kAll : Rows::kOnFlanks;
  std::vector<bool> used(table.rows.size(), false);
  // (whole words: bits of one are not written by two threads)
  constexpr std::size_t kRowsOfPiece = 16384;
  for_each_run(used.size(), kRowsOfPiece, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const int patch = patches.patch_of_row[i];
      const Rows asked = patch < 0 ? Rows::kNone : of_patch[static_cast<std::size_t>(patch)];
      const Observation& row = table.rows[i];
      used[i] = asked == Rows::kAll || (asked == Rows::kOnFlanks && row.places == 1 &&
                                        table.place(row).surface == Surface::kFlank);
    }
  });
  return used;
}

RemainderValues gather_values(const FlankGeometry& geometry, const Observations& table,
                              const Patches& patches, const std::vector<float>& row_um,
                              RemainderOf which, const std::vector<bool>& used) {
  return Gathering(geometry, table, patches, row_um, which, used).run();
}

void tell_loudness(const std::vector<MemberScatter>& scatters, std::vector<ToothMoments>& moments) {
  for (const int side : {0, 1}) {
    std::vector<double> own, values;
    std::vector<std::size_t> of_tooth;
    for (const MemberScatter& one : scatters) {
      if (one.set != side) continue;
      own.push_back(one.scatter);
      values.push_back(one.values);
      of_tooth.push_back(ToothMoments::at(side, one.number));
    }
    const std::vector<double> loud = loudness_of(own, values).factors;
    std::vector<double> known = own;
    std::erase(known, 0.0);
    const double usual = known.empty() ? 0.0 : median(std::move(known));
    for (std::size_t k = 0; k < loud.size(); ++k) {
      ToothMoments& of = moments[of_tooth[k]];
      of.loud = std::max(of.loud, loud[k]);
      if (!(usual > 0.0) || own[k] / usual <= of.scatter) continue;
      of.scatter = own[k] / usual;
      of.scatter_values = values[k];
    }
  }
}

}  // namespace trueflank::loop

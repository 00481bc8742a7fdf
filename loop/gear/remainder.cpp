// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/remainder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "trueflank/base/number_text.h"
#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/course_scan.h"
#include "trueflank/loop/discovery/own_relief.h"
#include "trueflank/loop/discovery/trend_scan.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/local/dents.h"
#include "trueflank/loop/gear/local/flank_spots.h"
#include "trueflank/loop/gear/local/flank_waves.h"
#include "trueflank/loop/gear/local/loud_places.h"
#include "trueflank/loop/gear/local/odd_teeth.h"
#include "trueflank/loop/gear/local/own_waves.h"
#include "trueflank/loop/gear/local/remainder_courses.h"
#include "trueflank/loop/gear/local/rotation_waves.h"
#include "trueflank/loop/gear/local/rough_flanks.h"
#include "trueflank/loop/gear/local/slanted_ridges.h"
#include "trueflank/loop/gear/paired_sums.h"
#include "trueflank/loop/gear/plane/plane_waves.h"
#include "trueflank/loop/gear/remainder_around.h"
#include "trueflank/loop/gear/remainder_values.h"
#include "trueflank/loop/gear/table/scanned_flank_rows.h"

namespace trueflank::loop {
namespace {

constexpr int kFewestPlaces = 12, kFewestLines = 8;

class RemainderSearch {
 public:
  RemainderSearch(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
                  const std::vector<float>& row_um, RemainderOf which)
      : geometry_(geometry), table_(table), patches_(patches), row_um_(row_um), which_(which) {}

  std::vector<RemainderFinding> run() {
    used_ = rows_looked_at(table_, patches_, which_);
    scanned_ = scanned_flank_rows(table_, used_);
    // None of these asks the others.
    auto spots = begun_beside([this] {
      return which_ == RemainderOf::kAll ? spots_of_scans(geometry_, table_, patches_, row_um_)
                                         : std::vector<FlankSpot>();
    });
    auto spectrum = begun_beside([this] { return spectrum_across(); });
    auto rotation = begun_beside([this] { return wave_over_rotation(); });
    auto plane =
        begun_beside([this] { return likeliest_plane_wave(geometry_, table_, row_um_, scanned_); });
    auto stripes = begun_beside(
        [this] { return likeliest_plane_stripes(geometry_, table_, row_um_, scanned_); });
    auto ridge = begun_beside(
        [this] { return likeliest_slanted_ridge(geometry_, table_, row_um_, scanned_); });
    values_ = gather_values(geometry_, table_, patches_, row_um_, which_, used_);
    tell_loud_traces();
    tell_rougher_teeth();
    for (auto& [key, courses] : values_.courses) look_along(key, courses);
    if (which_ == RemainderOf::kAll) look_for_spots(spots.get());
    look_across(spectrum.get());
    look_for_marching_waves();
    tell_rough_places();
    const auto looks = static_cast<double>(looks_);
    for (RemainderFinding& finding : found_)
      finding.p_value = std::min(1.0, looks * finding.p_value);
    look_over_rotation(rotation.get());
    look_in_space(plane.get(), stripes.get(), ridge.get());
    look_around();
    if (which_ == RemainderOf::kAll) look_at_single_teeth();
    std::erase_if(found_, [](const RemainderFinding& f) { return f.p_value > level_of(f); });
    std::stable_sort(found_.begin(), found_.end(), [](const auto& a, const auto& b) {
      return is_better(a.p_value, a.square, b.p_value, b.square);
    });
    return std::move(found_);
  }

  std::vector<std::string> notes_on_rough_traces() {
    used_ = rows_looked_at(table_, patches_, which_);
    values_ = gather_values(geometry_, table_, patches_, row_um_, which_, used_);
    std::vector<std::string> notes;
    for (const auto& [key, courses] : values_.courses) {
      if (!is_of_trace(key.kind) || courses.places(false) < kFewestPlaces ||
          courses.high == courses.low)
        continue;
      const RoughFlanks rough = rough_flanks(courses);
      if (is_sure(rough.zone) && !is_rough_surface(rough.zone))
        notes.push_back(words_of_zone(key, courses, rough) +
                        "; a probe's error may be as much larger there, and what stands out there "
                        "is judged by it");
    }
    return notes;
  }

 private:
  /// Which traces of a flank scatter more than the usual one.
  void tell_loud_traces() {
    for (const auto& [key, courses] : values_.courses) {
      if (!is_of_trace(key.kind)) continue;
      std::vector<MemberScatter>& scatters = trace_scatters_[key];
      scatters = scatters_of(courses);
      const auto moments =
          values_.moments.find({key.face ? MomentsOf::kHelices : MomentsOf::kProfiles, key.source});
      if (moments == values_.moments.end()) continue;
      tell_loudness(scatters, moments->second);
    }
  }

  /// Single teeth with a form of their own; of scans it is known how loud their flanks are.
  void look_at_single_teeth() {
    for (const auto& [source, scatters] : patches_.flank_scatters) {
      const auto moments = values_.moments.find({MomentsOf::kScan, source});
      if (moments == values_.moments.end()) continue;
      tell_loudness(scatters, moments->second);
    }
    const std::vector<RemainderFinding> odd =
        without_spots_alike(odd_teeth(geometry_, values_.moments), found_);
    found_.insert(found_.end(), odd.begin(), odd.end());
  }

  /// Flanks that are rougher from tooth to tooth, or on some neighbouring teeth.
  void tell_rougher_teeth() {
    const auto tell = [this](const std::vector<MemberScatter>& scatters, const std::string& what) {
      if (!are_asked(scatters)) return;
      ++looks_;
      if (const std::optional<RougherMembers> rougher = rougher_members(scatters))
        add_text(rougher->p_value, words_of(*rougher, what, flank_choice(geometry_, rougher->set)),
                 rougher->inside);
    };
    for (const auto& [key, scatters] : trace_scatters_)
      tell(scatters, key.face ? "traces over the face of " : "traces over the profile of ");
    if (which_ != RemainderOf::kAll) return;
    for (const auto& [source, scatters] : patches_.flank_scatters) tell(scatters, "");
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
    const auto coarse = values_.coarse_courses.find(key);
    if (coarse == values_.coarse_courses.end()) return found;
    const auto is_spot = [](const CourseFinding& f) {
      return f.kind == CourseFinding::Kind::kSpot;
    };
    std::erase_if(found, is_spot);
    for (const CourseFinding& spread : scan_courses(sets_of(coarse->second, places).sets))
      if (is_spot(spread)) found.push_back(spread);
    return found;
  }

  /// A trend of every trace's own that the teeth share out in a way that is told is not told twice.
  void look_around() {
    const std::vector<RemainderFinding> around = look_around_gear(
        geometry_, values_.moments, [this](const ToothSector& sector, double p_value) {
          return dent_in_place_of(sector, p_value);
        });
    std::erase_if(found_, [&](const RemainderFinding& own) {
      return own.own != OwnCourse::kNone && table_.points_mm.empty() &&
             std::any_of(around.begin(), around.end(), [&](const RemainderFinding& told) {
               return told.own == own.own && told.p_value <= kRemainderLevel;
             });
    });
    found_.insert(found_.end(), around.begin(), around.end());
  }

  /// Traces of which each has a smooth form of its own: how large these are, 0 where there are
  /// none.
  double look_for_own_relief(const CourseKey& key, const Courses& courses, const CourseSets& all) {
    // (so much surer than others are asked to be that it is no look of theirs)
    constexpr double kLevel = 1e-4;
    const std::optional<OwnRelief> relief = own_relief(all.sets);
    if (!relief || relief->p_value > kLevel) return 0.0;
    add_text(
        relief->p_value,
        printed("every trace over the %s has a smooth form of its own, in waves of %.3g mm and "
                "more%s, with a standard deviation of %.3g um, as of a rough or a hammered "
                "surface, or a probe that drifts",
                key.face ? "face" : "profile", std::abs(courses.high - courses.low) / relief->waves,
                key.face ? "" : " (of roll length)", relief->spread),
        relief->spread);
    found_.back().own = key.face ? OwnCourse::kLead : OwnCourse::kProfile;
    found_.back().own_relief = true;
    return relief->spread;
  }

  /// Traces that lean or bend each by itself: flanks that differ, or a probe that drifts.
  void look_for_own_trend(const CourseKey& key, const CourseSets& all) {
    ++looks_;
    const std::optional<OwnTrend> trend = own_trend(all.sets);
    if (!trend) return;
    add_text(
        trend->p_value,
        printed("the traces over the %s %s each by itself, with a standard deviation of %.3g "
                "um, as where flanks differ, or drift while they are measured",
                key.face ? "face" : "profile", trend->degree == 1 ? "lean" : "bend", trend->spread),
        trend->spread);
    found_.back().own = key.face ? OwnCourse::kLead : OwnCourse::kProfile;
  }

  void look_along(const CourseKey& key, const Courses& courses) {
    const bool scan = key.kind == ObservationKind::kScanFlank;
    const int places = courses.places(scan);
    if (places < (courses.lines > 0 ? kFewestLines : kFewestPlaces) || courses.high == courses.low)
      return;
    const CourseSets all = sets_of(courses, places);
    if (all.sets.empty()) return;
    looks_ += 3;  // in common, waves of their own, spots
    const double relief_um = scan ? 0.0 : look_for_own_relief(key, courses, all);
    if (!scan && relief_um == 0.0) look_for_own_trend(key, all);
    // What so many forms happen to have in common, or one has at a place.
    constexpr double kOfRelief = 4.0;
    const auto fewest =
        std::min_element(all.sets.begin(), all.sets.end(), [](const auto& a, const auto& b) {
          return a.cols() < b.cols();
        })->cols();
    const auto is_of_relief = [&](const CourseFinding& f) {
      const bool spot = f.kind == CourseFinding::Kind::kSpot;
      return std::abs(f.amount) <
             kOfRelief * relief_um / (spot ? 1.0 : std::sqrt(static_cast<double>(fewest)));
    };
    const RoughFlanks rough = scan ? RoughFlanks{} : rough_flanks_of(key, courses);
    for (const CourseFinding& found : findings_along(key, all, places)) {
      if (is_of_relief(found)) continue;
      if (found.kind == CourseFinding::Kind::kSpot) {
        if (scan || which_ != RemainderOf::kAll) continue;
        const int side = all.side_of[static_cast<std::size_t>(found.set)];
        if ((rough.side < 0 || rough.side == side) && found.at > rough.zone.from &&
            found.at < rough.zone.to)
          continue;
        const int course =
            all.members[static_cast<std::size_t>(side)][static_cast<std::size_t>(found.course)];
        add_spot_of_trace(key, courses, places, found, side,
                          courses.tooth_of[static_cast<std::size_t>(side)].at(course));
      } else {
        add_course(key, courses, places, found,
                   found.set < 0 ? -1 : all.side_of[static_cast<std::size_t>(found.set)],
                   scan ? std::set<int>{} : teeth_of(found, courses, all));
      }
    }
  }

  /// The teeth, where few traces have the waves.
  static std::set<int> teeth_of(const CourseFinding& found, const Courses& courses,
                                const CourseSets& all) {
    if (found.holders.empty()) return {};
    const auto side = static_cast<std::size_t>(all.side_of[static_cast<std::size_t>(found.set)]);
    std::set<int> teeth;
    for (const int course : found.holders)
      teeth.insert(courses.tooth_of[side].at(all.members[side][static_cast<std::size_t>(course)]));
    return teeth;
  }

  /// Standard deviation of what a tooth's trace has.
  static double spread_of_trace(const Courses& courses, int side, int tooth) {
    PairedSums sums;
    for (const auto& [number, samples] : courses.of_flank[static_cast<std::size_t>(side)])
      if (courses.tooth_of[static_cast<std::size_t>(side)].at(number) == tooth)
        for (const RemainderSample& sample : samples) sums.add(sample.at, sample.um);
    return std::sqrt(sums.square_of_y() / std::max(1.0, sums.n));
  }

  [[nodiscard]] std::string words_of_zone(const CourseKey& key, const Courses& courses,
                                          const RoughFlanks& rough) const {
    const double length = courses.high - courses.low;
    const double low = place_mm(key.face, courses.low + rough.zone.from * length),
                 high = place_mm(key.face, courses.low + rough.zone.to * length);
    return words_of(rough.zone, flank_choice(geometry_, rough.side), key.face, std::min(low, high),
                    std::max(low, high));
  }

  /// As it will be judged with all others: spots in a zone that is not told are told themselves.
  [[nodiscard]] bool is_sure(const RoughZone& zone) const {
    const auto most_looks = static_cast<double>(4 * values_.courses.size() + 4);
    return zone.p_value <= kRemainderLevel / most_looks;
  }

  /// Told as a finding.
  RoughFlanks rough_flanks_of(const CourseKey& key, const Courses& courses) {
    ++looks_;
    RoughFlanks surest = rough_flanks(courses);
    const RoughZone& zone = surest.zone;
    if (!is_sure(zone) || !is_rough_surface(zone)) return {};
    add_text(zone.p_value, words_of_zone(key, courses, surest), zone.inside_um);
    return surest;
  }

  /// A place along the flank as people say it: a height, or a diameter.
  [[nodiscard]] double place_mm(bool face, double at) const {
    return face ? at : 2.0 * geometry_.on_flank(1, 1, at, 0.0).radius_mm;
  }

  void add_form(const char* family, FlankChoice flank, EffectShape shape, double p_value,
                double amount, bool local, double square = 0.0) {
    found_.push_back(
        finding_of(geometry_, family, flank, std::move(shape), p_value, amount, local, square));
  }

  /// What is no form that could be a column.
  void add_text(double p_value, std::string text, double amount) {
    found_.push_back({.p_value = p_value, .text = std::move(text), .amount_um = amount});
  }

  void add_course(const CourseKey& key, const Courses& courses, int places,
                  const CourseFinding& found, int side, const std::set<int>& on_teeth) {
    const double face = key.face ? 1.0 : 0.0;
    const FlankChoice flank = flank_choice(geometry_, side);
    // Of a ring's scan the course runs from root to tip, and its roll falls.
    const auto [low, high] = std::minmax(courses.low, courses.high);
    const double at = place_mm(key.face, std::clamp(courses.place(found.at, places), low, high));
    const double width = std::abs(courses.length(found.width, places));
    using Kind = CourseFinding::Kind;
    constexpr double kMostOfATrace = 1.0;  // amplitude: half of the squares
    switch (found.kind) {
      case Kind::kStep:
        add_form("unnamed_step", flank, {face, at, found.set < -1 ? 1.0 : 0.0, 0.0}, found.p_value,
                 found.amount, false, found.square);
        found_.back().beside_line = found.beside_line;
        break;
      case Kind::kKink:
        add_form("unnamed_kink", flank, {face, at, found.side_of_kink()}, found.p_value,
                 found.amount, false, found.square);
        break;
      case Kind::kBand:
        add_form("unnamed_band", flank, {face, at, width}, found.p_value, found.amount, false,
                 found.square);
        found_.back().beside_line = found.beside_line;
        break;
      case Kind::kWave:
        add_form("unnamed_waviness", flank, {face, width}, found.p_value, found.amount, false,
                 found.square);
        break;
      default:
        if (on_teeth.size() == 1 && side >= 0 &&
            found.amount > kMostOfATrace * spread_of_trace(courses, side, *on_teeth.begin())) {
          add_form("unnamed_waviness_of_teeth", flank,
                   {double(*on_teeth.begin()), 1.0, 0.0, face, width}, found.p_value, found.amount,
                   true, found.square);
          break;
        }
        add_text(found.p_value,
                 printed("waves over the %s, %.3g mm long, %.3g um, %s",
                         key.face ? "face" : "profile", width, found.amount,
                         on_teeth.empty() ? "in a phase of its own on every tooth"
                                          : words_of_teeth(on_teeth).c_str()) +
                     (side < 0                      ? ""
                      : flank == FlankChoice::kLeft ? ", left flanks"
                                                    : ", right flanks"),
                 found.amount);
        found_.back().own_phases = true;
    }
  }

  void add_spot_of_trace(const CourseKey& key, const Courses& courses, int places,
                         const CourseFinding& found, int side, int tooth) {
    const double at = courses.place(found.at, places),
                 half = 0.5 * courses.length(found.width, places);
    const double middle = 0.5 * geometry_.face_width_mm();
    EffectShape shape =
        key.face
            ? EffectShape{double(tooth),
                          2.0 * geometry_.reference_radius_mm(),
                          at,
                          0.0,
                          2.0 * half,
                          0.0}
            : EffectShape{double(tooth), place_mm(false, at),
                          middle,        2.0 * half * gear_effects::along_profile(geometry_, at),
                          0.0,           0.0};
    add_form("unnamed_spot", flank_choice(geometry_, side), std::move(shape), found.p_value,
             found.amount, true, found.square * courses.values_of_place(places));
  }

  void look_for_spots(const std::vector<FlankSpot>& spots) {
    ++looks_;
    for (const FlankSpot& spot : spots)
      add_form("unnamed_spot", flank_choice(geometry_, spot.side > 0 ? 1 : 0),
               {double(spot.tooth), place_mm(false, spot.roll_mm), spot.height_mm,
                2.0 * spot.half_profile_mm * gear_effects::along_profile(geometry_, spot.roll_mm),
                2.0 * spot.half_face_mm, 0.0},
               spot.p_value, spot.amount_um, true, spot.square);
  }

  void tell_rough_places() {
    ++looks_;
    for (const LouderPlace& place : still_louder(geometry_, table_, patches_, row_um_))
      if (place.is_rough())
        add_text(place.p_value,
                 printed("the surface is rougher %s: its points scatter %.2g times as much as "
                         "elsewhere (or the scanner sees it worse there)",
                         place.words().c_str(), place.times),
                 0.0);
  }

  [[nodiscard]] FlankSpectrum spectrum_across() const {
    if (table_.points_mm.empty()) return {};
    return flank_spectrum(geometry_, table_, row_um_, used_);
  }

  /// Waves over the face, on traces, that run on from tooth to tooth. (Those over the profile are
  /// ghost orders.)
  void look_for_marching_waves() {
    // (so much surer than others are asked to be that it is no look of theirs)
    if (!table_.points_mm.empty()) return;
    for (const FlankWaves& wave : waves_of_leads(geometry_, table_, row_um_, used_)) {
      EffectShape shape{0.0, wave.waves_face, wave.order};
      const bool whole = std::rint(wave.order) == wave.order;
      if (!whole) shape.push_back(1.0);  // begins at the first tooth
      add_form(whole ? "unnamed_marks" : "unnamed_walking_waves",
               flank_choice(geometry_, wave.side > 0 ? 1 : 0), std::move(shape), wave.p_value,
               wave.amplitude_um, false);
    }
  }

  /// Waves across the flanks of scans, and flanks that stand each by itself.
  void look_across(const FlankSpectrum& spectrum) {
    if (table_.points_mm.empty()) return;
    looks_ += 3;
    // (so much surer than others are asked to be that it is no look of theirs)
    tell_own_waves(spectrum.own_waves);
    if (const auto& wave = spectrum.waves)
      add_form("unnamed_marks", flank_choice(geometry_, wave->side > 0 ? 1 : 0),
               {wave->waves_profile, wave->waves_face, wave->order}, wave->p_value,
               wave->amplitude_um, false);
    if (const auto& apart = spectrum.apart)
      add_text(apart->p_value,
               printed("the flanks stand each by itself, with a standard deviation of %.3g um from "
                       "tooth to tooth",
                       apart->spread_um),
               apart->spread_um);
    if (const auto& forms = spectrum.forms) {
      const double long_mm = forms->face ? geometry_.face_width_mm() : involute_mm();
      add_text(
          forms->p_value,
          printed("every flank has a form of its own over the %s, alike all over the %s: waves of "
                  "about %.3g mm%s, with a standard deviation of %.3g um",
                  forms->face ? "face" : "profile", forms->face ? "profile" : "face",
                  long_mm / forms->waves, forms->face ? "" : " (of roll length)", forms->spread_um),
          forms->spread_um);
      found_.back().own = forms->face ? OwnCourse::kLead : OwnCourse::kProfile;
    }
  }

  /// Waves that every flank has in a phase of its own: no columns, but no noise either.
  void tell_own_waves(const std::vector<OwnWaves>& waves) {
    constexpr double kAlike = 0.08;
    const auto alike = [](double a, double b) { return std::abs(a - b) < kAlike * std::max(a, b); };
    const bool both = waves.size() == 2 && alike(waves[0].waves_profile, waves[1].waves_profile) &&
                      alike(std::abs(waves[0].waves_face), std::abs(waves[1].waves_face)) &&
                      alike(waves[0].amplitude_um, waves[1].amplitude_um);
    for (const OwnWaves& wave : waves) {
      add_text(wave.p_value, flank_waves::words_of(geometry_, waves, wave, both),
               wave.amplitude_um);
      found_.back().own_waves = both ? waves : std::vector{wave};
      if (both) break;
    }
  }
  [[nodiscard]] double involute_mm() const {
    return std::abs(geometry_.tip_form_roll_mm() - geometry_.root_form_roll_mm());
  }

  [[nodiscard]] RotationWave wave_over_rotation() const {
    if (std::none_of(patches_.patches.begin(), patches_.patches.end(), [](const auto& patch) {
          return patch.kind == ObservationKind::kProfile ||
                 patch.kind == ObservationKind::kScanFlank;
        }))
      return {};
    return likeliest_rotation_wave(geometry_, table_, row_um_, used_);
  }

  /// Waves over the generating rotation that are no candidates: of one flank, or of higher orders.
  void look_over_rotation(const RotationWave& wave) {
    if (wave.order == 0 || wave.p_value > kRemainderLevel ||
        (wave.side == 0 && wave.order <= gear_effects::most_ghost_order(geometry_)))
      return;
    const FlankChoice flank =
        wave.side == 0 ? FlankChoice::kBoth : flank_choice(geometry_, wave.side > 0 ? 1 : 0);
    // Waves or forms of every trace's own, surer as they are by themselves, are no news beside it.
    constexpr double kOfIt = 1.5;  // times its amplitude
    std::erase_if(found_, [&](const RemainderFinding& f) {
      return (f.own_phases || f.own_relief) && f.amount_um < kOfIt * wave.amplitude_um;
    });
    for (const EffectFamily& family : effect_library())
      if (family.id == "ghost_order" && family.of_traces_only == wave.backwards)
        found_.push_back({.p_value = wave.p_value,
                          .text = family.description + ", " +
                                  gear_effects::times_per_turn(wave.order) +
                                  printed(", %.3g um", wave.amplitude_um),
                          .amount_um = wave.amplitude_um,
                          .effect = Effect{&family, flank, {double(wave.order)}}});
  }

  void look_in_space(const std::optional<PlaneWave>& wave,
                     const std::optional<PlaneStripes>& stripes,
                     const std::optional<SlantedRidge>& ridge) {
    constexpr double kLevel = 1e-6;  // (so much surer that it is no look of the others)
    // Of forms of the plane the one that says most.
    const auto said = [](const auto& form) {
      return form && form->p_value <= kLevel ? form->square : 0.0;
    };
    const double of_wave = said(wave), of_stripes = said(stripes);
    if (of_stripes > of_wave)
      add_form("unnamed_plane_stripes", FlankChoice::kBoth,
               {stripes->direction_deg, stripes->wavelength_mm}, stripes->p_value,
               stripes->amplitude_um, false, stripes->square);
    if (of_wave > of_stripes)
      add_form(std::isnan(wave->jump_mm) ? "unnamed_plane_wave" : "unnamed_plane_saw",
               FlankChoice::kBoth, wave->shape(), wave->p_value, wave->amplitude_um, false,
               wave->square);
    if (ridge && ridge->p_value <= kLevel)
      add_form("unnamed_slanted_ridge", ridge->form.flank, ridge->form.shape, ridge->p_value,
               ridge->amount_um, false, ridge->square);
  }

  /// A dent in place of a sector, where it takes out more.
  [[nodiscard]] std::optional<RemainderFinding> dent_in_place_of(const ToothSector& sector,
                                                                 double p_value) const {
    const int z = geometry_.teeth();
    if (3 * sector.count > z) return {};
    double product = 0.0, square = 0.0;
    for (std::size_t i = 0; i < used_.size(); ++i) {
      const Place& place = table_.place(table_.rows[i]);
      if (!used_[i] || ((place.tooth - sector.first) % z + z) % z >= sector.count) continue;
      const double form = std::pow(geometry_.face_coordinate(place.z_mm), sector.face_degree) *
                          (sector.opposite ? place.side : 1);
      product += form * row_um_[i];
      square += form * form;
    }
    const auto dent = largest_dent(geometry_, table_, row_um_, used_);
    if (!dent || !(square > 0.0) || dent->square <= product * product / square) return {};
    return finding_of(
        geometry_, "unnamed_dent",
        dent->side == 0 ? FlankChoice::kBoth : flank_choice(geometry_, dent->side > 0 ? 1 : 0),
        {dent->tooth, dent->half_teeth, dent->height_mm, dent->half_mm}, p_value, dent->amount_um,
        false);
  }

  const FlankGeometry& geometry_;
  const Observations& table_;
  const Patches& patches_;
  const std::vector<float>& row_um_;
  RemainderOf which_;
  std::vector<bool> used_;
  std::vector<std::uint32_t> scanned_;  ///< used rows of scanned flanks
  RemainderValues values_;
  std::map<CourseKey, std::vector<MemberScatter>> trace_scatters_;
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

std::vector<std::string> notes_on_rough_traces(const FlankGeometry& geometry,
                                               const Observations& table, const Patches& patches,
                                               const std::vector<float>& row_um) {
  if (!is_traced(table)) return {};
  return RemainderSearch(geometry, table, patches, row_um, RemainderOf::kAll)
      .notes_on_rough_traces();
}

}  // namespace trueflank::loop

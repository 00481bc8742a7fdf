// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/remainder_around.h"
#include "trueflank/loop/gear/effects/columns.h"

#include <algorithm>
#include <cmath>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/discovery/ring_scan.h"
#include "trueflank/loop/gear/effects/registry.h"
#include "trueflank/loop/gear/moved_sector.h"

namespace trueflank::loop {
namespace {

constexpr int kTeethOfARing = 8;

class AroundSearch {
 public:
  AroundSearch(const FlankGeometry& geometry, const MomentsOfTeeth& moments,
               const InPlaceOfSector& dent)
      : geometry_(geometry), moments_(moments), dent_(dent) {}

  std::vector<RemainderFinding> run() {
    look_at_rings();
    look_at_flanks_of_teeth();
    return std::move(found_);
  }

 private:
  /// Height, slope and bow of every tooth, in a ring: both flanks together, or the one measured.
  void look_at_rings() {
    for (const auto& [key, of_teeth] : moments_) {
      std::array<std::vector<int>, 3> teeth;  // with right flanks, left flanks, both
      for (int tooth = 1; tooth <= geometry_.teeth(); ++tooth) {
        const bool right = of_teeth[ToothMoments::at(0, tooth)].count > 0,
                   left = of_teeth[ToothMoments::at(1, tooth)].count > 0;
        if (right) teeth[0].push_back(tooth);
        if (left) teeth[1].push_back(tooth);
        if (right && left) teeth[2].push_back(tooth);
      }
      if (static_cast<int>(teeth[2].size()) >= kTeethOfARing)
        look_around(key, of_teeth, teeth[2], -1);
      else
        for (const int side : {0, 1})
          if (static_cast<int>(teeth[static_cast<std::size_t>(side)].size()) >= kTeethOfARing)
            look_around(key, of_teeth, teeth[static_cast<std::size_t>(side)], side);
    }
  }

  /// Traces have zeros of their own.
  static bool has_heights(MomentsOf what) {
    return what == MomentsOf::kScan || what == MomentsOf::kOthers;
  }

  /// What differs from tooth to tooth: a course over the profile or over the face.
  static OwnCourse own_course(int form) {
    return form == 0 ? OwnCourse::kNone : form % 2 == 1 ? OwnCourse::kProfile : OwnCourse::kLead;
  }

  /// What one kind of record shows of a tooth by itself.
  static std::vector<int> own_forms(MomentsOf what) {
    switch (what) {
      case MomentsOf::kProfiles:
        return {1, 3};
      case MomentsOf::kHelices:
        return {2, 4};
      case MomentsOf::kOthers:
        return {0};
      default:
        return {};
    }
  }

  /// What both flanks of each tooth share, or both of each gap: the last flank of a tooth and the
  /// first of the next, counter-clockwise.
  struct Members {
    bool gaps = false;
    std::vector<int> teeth;  ///< of gaps the tooth before each
    Eigen::VectorXd first,
        second;  ///< values of the flank that is met first, counter-clockwise, and of the other
    double p_value = 1.0;

    [[nodiscard]] bool opposite() const {
      return (first.array() - first.mean())
                 .matrix()
                 .dot((second.array() - second.mean()).matrix()) < 0.0;
    }
    /// Above 0: they stand out, or, where opposite, counter-clockwise.
    [[nodiscard]] Eigen::VectorXd common() const {
      const double of_first = opposite() && !gaps ? -1.0 : 1.0,
                   of_second = opposite() && gaps ? -1.0 : 1.0;
      return 0.5 * (of_first * first + of_second * second);
    }
  };

  /// Heights in an index, slopes and bows of traces that differ from tooth to tooth, or from gap to
  /// gap, alike or opposite on both flanks of each: noise knows of one value or trace only, however
  /// it hangs together within it.
  void look_at_flanks_of_teeth() {
    constexpr int kForms = 2;  // of a trace's own direction
    constexpr double kClearly = 0.01;  // of the chance: what goes slowly around is alike in both
    const auto looks = static_cast<double>(2 * kForms * moments_.size());
    for (const auto& [key, of_teeth] : moments_)
      for (const int form : own_forms(key.first)) {
        Members members = members_of(of_teeth, form, false);
        if (Members gaps = members_of(of_teeth, form, true);
            gaps.p_value < kClearly * members.p_value)
          members = std::move(gaps);
        const double p_value = std::min(1.0, looks * members.p_value);
        if (p_value > kRemainderLevel) continue;
        const Eigen::VectorXd common = members.common();
        if (members.gaps ||
            !add_slow_wave(common, members.teeth, form, members.opposite(), looks)) {
          const double spread = std::sqrt((common.array() - common.mean()).square().mean());
          add_text(p_value,
                   words_of_own(form, key.first, members, spread) +
                       (form == 0 ? words_of_two_kinds(members, common) : ""),
                   (form == 1 || form == 2 ? 2.0 : 1.0) * spread);
        }
        found_.back().own = own_course(form);
        if (form == 0) found_.back().places = {true, members.gaps, members.opposite()};
      }
  }

  /// A tooth that is measured worse is far out on both flanks, and would agree with itself: its
  /// values count for as much less.
  static double chance_of_both(const std::vector<ToothMoments>& of_teeth, const Members& members) {
    if (members.teeth.empty()) return 1.0;
    std::array<Eigen::VectorXd, 2> even{members.first, members.second};
    bool any = false;
    for (const std::size_t side : {0U, 1U}) {
      const double mean = even[side].mean();
      for (std::size_t i = 0; i < members.teeth.size(); ++i) {
        const double loud = flank_of(of_teeth, members.teeth[i], side, members.gaps).loud;
        any = any || loud > 1.0;
        double& value = even[side][static_cast<Eigen::Index>(i)];
        value = mean + (value - mean) / loud;
      }
    }
    return any ? chance_of_agreement(even[0], even[1])
               : chance_of_agreement(members.first, members.second);
  }

  /// Slopes and bows that both flanks of every tooth agree on, and that one slow wave around the
  /// gear follows: of few teeth no order of theirs is so unlikely as how little the wave leaves.
  bool add_slow_wave(const Eigen::VectorXd& common, const std::vector<int>& teeth, int form,
                     bool opposite, double looks) {
    constexpr int kHighest = 2;
    constexpr double kMostLeft = 0.1;  // of the squares
    constexpr double kToldApart = 1e-6;
    if (form == 0) return false;
    const Eigen::Index n = common.size();
    const double all = (common.array() - common.mean()).square().sum();
    double least = kMostLeft * all;
    int best = 0;
    double amplitude = 0.0;
    for (int order = 1; order <= kHighest; ++order) {
      if (n < 2 * order + 4) break;
      Eigen::VectorXd cosine(n), sine(n);
      for (Eigen::Index i = 0; i < n; ++i) {
        const double angle =
            order * kTwoPi * (teeth[static_cast<std::size_t>(i)] - 1) / geometry_.teeth();
        cosine[i] = std::cos(angle);
        sine[i] = std::sin(angle);
      }
      cosine.array() -= cosine.mean();
      sine.array() -= sine.mean();
      const double cc = cosine.squaredNorm(), ss = sine.squaredNorm(), cs = cosine.dot(sine);
      const double determinant = cc * ss - cs * cs;
      if (!(determinant > kToldApart * static_cast<double>(n * n))) continue;
      const double of_cosine = cosine.dot(common), of_sine = sine.dot(common);
      const double a = (ss * of_cosine - cs * of_sine) / determinant,
                   b = (cc * of_sine - cs * of_cosine) / determinant;
      const double left = all - a * of_cosine - b * of_sine;
      if (left >= least) continue;
      least = left;
      best = order;
      amplitude = std::hypot(a, b);
    }
    if (best == 0) return false;
    const auto degrees = static_cast<double>(n - 3);
    const double p_value = std::min(
        1.0,
        looks * kHighest *
            f_tail(0.5 * (all - least) * degrees / std::max(least, 1e-12 * all), 2.0, degrees));
    if (p_value > kRemainderLevel) return false;
    const double u = form == 1 ? 1.0 : form == 3 ? 2.0 : 0.0;
    const double v = form == 2 ? 1.0 : form == 4 ? 2.0 : 0.0;
    found_.push_back(finding_of(geometry_, "unnamed", FlankChoice::kBoth,
                                {u, v, static_cast<double>(best), opposite ? 1.0 : 0.0}, p_value,
                                amplitude, false));
    return true;
  }

  static std::string words_of_own(int form, MomentsOf what, const Members& members,
                                  double spread_um) {
    const char* on = members.opposite() ? "opposite on" : "alike on";
    const std::string of = members.gaps ? "gap between two teeth" : "tooth";
    if (form == 0)
      return printed(
          "a place of its own of every %s, %s both its flanks, with a standard "
          "deviation of %.3g um",
          of.c_str(), on, spread_um);
    return printed(
        "a %s over the %s of its own on every %s, %s both its flanks, with a "
        "standard deviation of %.3g um",
        form < 3 ? "slope" : "bow", what == MomentsOf::kProfiles ? "profile" : "face", of.c_str(),
        on, (form < 3 ? 2.0 : 1.0) * spread_um);
  }

  /// Where they stand in two places that are far apart beside how each scatters: which, and how
  /// far.
  static std::string words_of_two_kinds(const Members& members, const Eigen::VectorXd& common) {
    constexpr double kApart = 6.0;  // scatters; 3.5 of values that are spread evenly
    constexpr std::size_t kFewest = 3;
    std::vector<std::pair<double, int>> sorted;
    for (std::size_t i = 0; i < members.teeth.size(); ++i)
      sorted.emplace_back(common[static_cast<Eigen::Index>(i)], members.teeth[i]);
    std::sort(sorted.begin(), sorted.end());
    const std::size_t n = sorted.size();
    std::size_t split = 0;
    double least = 0.0, apart_um = 0.0;
    for (std::size_t k = kFewest; k + kFewest <= n; ++k) {
      std::array<double, 2> mean{}, square{};
      for (std::size_t i = 0; i < n; ++i)
        mean[i < k ? 0 : 1] += sorted[i].first / static_cast<double>(i < k ? k : n - k);
      for (std::size_t i = 0; i < n; ++i)
        square[i < k ? 0 : 1] += std::pow(sorted[i].first - mean[i < k ? 0 : 1], 2);
      const double within = square[0] + square[1];
      if (split > 0 && within >= least) continue;
      split = k;
      least = within;
      apart_um = mean[1] - mean[0];
    }
    if (split == 0 || apart_um < kApart * std::sqrt(least / static_cast<double>(n - 2))) return {};
    // those that are fewer are named
    const bool upper = n - split <= split;
    std::vector<int> teeth;
    for (std::size_t i = upper ? split : 0; i < (upper ? n : split); ++i)
      teeth.push_back(sorted[i].second);
    std::sort(teeth.begin(), teeth.end());
    std::string text = members.gaps ? "; there are two kinds: the gaps that follow on teeth"
                                    : "; there are two kinds: teeth";
    for (std::size_t i = 0; i < teeth.size(); ++i)
      text += (i == 0 ? " " : i + 1 == teeth.size() ? " and " : ", ") + std::to_string(teeth[i]);
    const char* how = !members.opposite() && members.gaps
                          ? (upper ? "are narrower than the others, by %.3g um on each flank"
                                   : "are wider than the others, by %.3g um on each flank")
                      : !members.opposite()
                          ? (upper ? "are thicker than the others, by %.3g um on each flank"
                                   : "are thinner than the others, by %.3g um on each flank")
                          : (upper ? "stand %.3g um counter-clockwise of the others"
                                   : "stand %.3g um clockwise of the others");
    return text + " " + printed(how, apart_um);
  }

  /// Of a tooth or gap the flank that is met first (0) or last, counter-clockwise.
  static const ToothMoments& flank_of(const std::vector<ToothMoments>& of_teeth, int tooth,
                                      std::size_t which, bool gap) {
    const auto teeth = static_cast<int>(of_teeth.size()) / 2 - 1;
    if (!gap) return of_teeth[ToothMoments::at(static_cast<int>(which), tooth)];
    return which == 0 ? of_teeth[ToothMoments::at(1, tooth)]
                      : of_teeth[ToothMoments::at(0, tooth % teeth + 1)];
  }
  /// A form of the teeth or gaps of which both flanks were measured.
  static Members members_of(const std::vector<ToothMoments>& of_teeth, int form, bool gaps) {
    const auto k = static_cast<std::size_t>(form);
    std::array<std::vector<double>, 2> values;
    Members members{.gaps = gaps, .teeth = {}, .first = {}, .second = {}};
    for (int tooth = 1; tooth < static_cast<int>(of_teeth.size()) / 2; ++tooth) {
      const ToothMoments &first = flank_of(of_teeth, tooth, 0, gaps),
                         &second = flank_of(of_teeth, tooth, 1, gaps);
      if (!(first.square[k] > 0.0) || !(second.square[k] > 0.0)) continue;
      members.teeth.push_back(tooth);
      values[0].push_back(first.sum[k] / first.square[k]);
      values[1].push_back(second.sum[k] / second.square[k]);
    }
    const auto vector = [](const std::vector<double>& of) {
      return Eigen::VectorXd(
          Eigen::Map<const Eigen::VectorXd>(of.data(), static_cast<Eigen::Index>(of.size())));
    };
    members.first = vector(values[0]);
    members.second = vector(values[1]);
    members.p_value = chance_of_both(of_teeth, members);
    return members;
  }

  /// One form of all teeth: a column of the ring.
  struct Series {
    int form = 0;
    bool opposite = false;
    FlankChoice flank = FlankChoice::kBoth;
  };

  /// The form of a tooth on one side (0 right, 1 left), or of both together.
  static std::optional<double> value_of(const std::vector<ToothMoments>& of_teeth, int tooth,
                                        int side, const Series& series) {
    const auto k = static_cast<std::size_t>(series.form);
    const ToothMoments& right = of_teeth[ToothMoments::at(0, tooth)];
    const ToothMoments& left = of_teeth[ToothMoments::at(1, tooth)];
    if ((side != 1 && !(right.square[k] > 0.0)) || (side != 0 && !(left.square[k] > 0.0)))
      return {};
    if (side == 0) return right.sum[k] / right.square[k];
    if (side == 1) return left.sum[k] / left.square[k];
    return 0.5 * (left.sum[k] / left.square[k] +
                  (series.opposite ? -1.0 : 1.0) * right.sum[k] / right.square[k]);
  }

  /// The squares that a series' value of a tooth rests on: its variance is one over them.
  static double square_of(const std::vector<ToothMoments>& of_teeth, int tooth, int side,
                          const Series& series) {
    const auto k = static_cast<std::size_t>(series.form);
    const double right = of_teeth[ToothMoments::at(0, tooth)].square[k],
                 left = of_teeth[ToothMoments::at(1, tooth)].square[k];
    return side == 0 ? right : side == 1 ? left : 4.0 / (1.0 / left + 1.0 / right);
  }

  /// A flank of which clearly fewer points were measured scatters more, and two of them beside each
  /// other would make a sector: their values count for as much less.
  static void even_out(Eigen::Ref<Eigen::VectorXd> values, const std::vector<double>& squares) {
    constexpr double kAsManyAs = 0.64;  // of the usual number
    const double usual = median(std::vector<double>(squares));
    double sum = 0.0, weights = 0.0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      sum += squares[static_cast<std::size_t>(i)] * values[i];
      weights += squares[static_cast<std::size_t>(i)];
    }
    const double mean = sum / weights;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
      const double share = squares[static_cast<std::size_t>(i)] / usual;
      if (share < kAsManyAs) values[i] = mean + (values[i] - mean) * std::sqrt(share);
    }
  }

  void look_around(const std::pair<MomentsOf, int>& key, const std::vector<ToothMoments>& of_teeth,
                   const std::vector<int>& teeth, int side) {
    const auto n = static_cast<Eigen::Index>(teeth.size());
    std::vector<Series> what;
    Eigen::MatrixXd series(n, 0);
    const auto add_series = [&](const Series& one, int of_side) {
      Eigen::VectorXd values(n);
      std::vector<double> squares;
      for (Eigen::Index i = 0; i < n; ++i) {
        const int tooth = teeth[static_cast<std::size_t>(i)];
        const auto value = value_of(of_teeth, tooth, of_side, one);
        if (!value) return;
        values[i] = *value;
        squares.push_back(square_of(of_teeth, tooth, of_side, one));
      }
      if (key.first == MomentsOf::kScan) even_out(values, squares);
      series.conservativeResize(Eigen::NoChange, series.cols() + 1);
      series.col(series.cols() - 1) = values;
      what.push_back(one);
    };
    for (int form = 0; form < static_cast<int>(ToothMoments::kForms); ++form)
      for (const bool opposite : {false, true})
        if (!opposite || side < 0)
          add_series({form, opposite, flank_choice(geometry_, side)}, side);
    if (what.empty()) return;
    // Then those of one of both flanks: what differs there alone stands in either of the others.
    const Eigen::Index of_both = series.cols();
    for (int form = 0; side < 0 && form < static_cast<int>(ToothMoments::kForms); ++form)
      for (const int own : {0, 1}) add_series({form, false, flank_choice(geometry_, own)}, own);
    if (const auto moved =
            side < 0 && has_heights(key.first) ? moved_sector(geometry_, of_teeth) : std::nullopt) {
      found_.push_back(finding_of(geometry_, "unnamed_moved_sector", FlankChoice::kBoth,
                                  {double(moved->first), double(moved->count)}, moved->p_value,
                                  moved->amount_um, false));
      return;
    }
    std::vector<int> place = teeth;
    for (int& at : place) --at;
    const auto records = static_cast<double>(moments_.size());
    const double level = kRemainderLevel / records;
    RingFinding found = scan_ring(series, place, geometry_.teeth(), level);
    // Waves of one flank are told as those of both.
    if (found.series >= of_both && found.kind == RingFinding::Kind::kWave)
      found = scan_ring(series.leftCols(of_both), place, geometry_.teeth(), level);
    if (found.series < 0) return;
    found.p_value = std::min(1.0, found.p_value * records);
    if (found.p_value > kRemainderLevel) return;
    const Series& series_found = what[static_cast<std::size_t>(found.series)];
    add_ring(found, teeth, series_found, key.first == MomentsOf::kScan);
    if (key.first != MomentsOf::kScan) found_.back().own = own_course(series_found.form);
  }

  void add_ring(const RingFinding& found, const std::vector<int>& teeth, const Series& series,
                bool scan) {
    const double u = series.form == 1 ? 1.0 : series.form == 3 ? 2.0 : 0.0;
    const double v = series.form == 2 ? 1.0 : series.form == 4 ? 2.0 : 0.0;
    const double turned = series.opposite ? 1.0 : 0.0;
    const auto n = static_cast<int>(teeth.size());
    const auto add_here = [&](const char* family, EffectShape shape, SignOf sign = SignOf::kForm) {
      found_.push_back(finding_of(geometry_, family, series.flank, std::move(shape), found.p_value,
                                  found.amount, false, 0.0, sign));
    };
    using Kind = RingFinding::Kind;
    if (found.kind == Kind::kRamp) {
      add_here("unnamed_ramp", {found.first + 1.0, u, v, turned, gear_effects::kMeanOfDrift});
    } else if (found.kind == Kind::kSaw) {
      add_here("unnamed_saw",
               {double(found.count), found.first + 1.0, u, v, turned, gear_effects::kMeanOfDrift});
    } else if (found.kind == Kind::kComb && found.count > 2) {
      add_here("unnamed_comb", {double(found.count), found.first + 1.0, u, v, turned});
    } else if (found.kind == Kind::kArc) {
      const int first = teeth[static_cast<std::size_t>(found.first)];
      const int last = teeth[static_cast<std::size_t>((found.first + found.count - 1) % n)];
      const int z = geometry_.teeth();
      const int count = ((last - first) % z + z) % z + 1;
      if (scan)
        if (auto dent = dent_({first, count, v, series.opposite}, found.p_value)) {
          found_.push_back(std::move(*dent));
          return;
        }
      add_here("unnamed_sector", {double(first), double(count), u, v, turned});
    } else if (found.kind == Kind::kComb ||
               (3 * n >= 2 * geometry_.teeth() && 2 * found.order >= geometry_.teeth() - 1)) {
      add_here("unnamed_alternation", {u, v, turned}, SignOf::kUnknown);
    } else if (u < 2.0 && v < 2.0 && series.flank == FlankChoice::kBoth) {
      add_here("unnamed", {u, v, double(found.order), turned});
    } else {
      add_text(found.p_value,
               printed("a wave %d times around the %d teeth measured, %.3g um", found.order, n,
                       found.amount),
               found.amount);
    }
  }

  /// What is no form that could be a column.
  void add_text(double p_value, std::string text, double amount) {
    found_.push_back({.p_value = p_value, .text = std::move(text), .amount_um = amount});
  }

  const FlankGeometry& geometry_;
  const MomentsOfTeeth& moments_;
  const InPlaceOfSector& dent_;
  std::vector<RemainderFinding> found_;
};

}  // namespace

RemainderFinding finding_of(const FlankGeometry& geometry, const char* family, FlankChoice flank,
                            EffectShape shape, double p_value, double amount, bool local,
                            double square, SignOf sign) {
  RemainderFinding finding{
      p_value, {}, square, amount, Effect{find_family(family), flank, std::move(shape)}, local};
  const Effect& effect = *finding.effect;
  const char* on = effect.family->flank_only || effect.flank == FlankChoice::kBoth ? ""
                   : effect.flank == FlankChoice::kLeft                            ? ", left flanks"
                                                        : ", right flanks";
  std::vector<double> amounts;
  if (sign == SignOf::kForm && effect.columns() == 1) amounts.push_back(amount);
  finding.text = effect.family->words({geometry, effect.shape, effect.flank, amounts}) + on +
                 printed(", %.3g um", std::abs(amount));
  return finding;
}

FlankChoice flank_choice(const FlankGeometry& geometry, int side) {
  return side < 0                                 ? FlankChoice::kBoth
         : (side > 0) == (geometry.sense() > 0.0) ? FlankChoice::kLeft
                                                  : FlankChoice::kRight;
}

std::vector<RemainderFinding> look_around_gear(const FlankGeometry& geometry,
                                               const MomentsOfTeeth& moments,
                                               const InPlaceOfSector& dent) {
  return AroundSearch(geometry, moments, dent).run();
}

}  // namespace trueflank::loop

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/exchanged_effects.h"

#include <algorithm>
#include <cmath>

#include "trueflank/loop/discovery/distributions.h"

namespace trueflank::loop {
namespace {

class Exchange {
 public:
  Exchange(DriveSelection& selection, const std::vector<DriveEffect>& effects,
           std::vector<FoundEffect>& found)
      : selection_(selection), effects_(effects), found_(found) {}

  void run() {
    const DriveState state = selection_.state();
    const double own = square_of(effects_);
    double rows = 0.0;
    for (const BenchPoint& p : selection_.table().points) rows += p.sigma_nm > 0.0 ? 1.0 : 0.0;
    const double noise = own / std::max(1.0, rows - static_cast<double>(effects_.size()));
    for (std::size_t e = 0; e < effects_.size(); ++e)
      for (const DriveEffect& other : in_place_of(e)) {
        std::vector<DriveEffect> with = effects_;
        with[e] = other;
        settle(with);
        constexpr double kTie = 4.0;  // chi-square
        if (square_of(with) - own < kTie * noise) hold(with, e);
        selection_.move_state_to(state);
      }
  }

 private:
  [[nodiscard]] FoundEffect* told(const DriveEffect& effect) {
    const auto at = std::find_if(found_.begin(), found_.end(), [&](const FoundEffect& f) {
      return f.named && f.id == effect.family->id && f.side == effect.family->side;
    });
    return at == found_.end() ? nullptr : &*at;
  }

  /// Named effects of one column and no shape that were said to look like it: the same of the other
  /// side, or what is confounded with it.
  [[nodiscard]] std::vector<DriveEffect> in_place_of(std::size_t e) {
    const DriveFamily* own = effects_[e].family;
    const FoundEffect* as_told = told(effects_[e]);
    std::vector<DriveEffect> others;
    if (as_told == nullptr || !own->shape_names.empty()) return others;
    for (const DriveEffect& candidate : selection_.candidates()) {
      const DriveFamily* family = candidate.family;
      const auto& alike = as_told->confounded_with;
      bool taken = false;  // two zeros that make up for each other are no plain cause
      for (std::size_t k = 0; k < effects_.size(); ++k)
        taken = taken || (k != e && effects_[k].family->id == family->id);
      if (family->named && family != own && !taken && family->shape_names.empty() &&
          candidate.columns() == 1 &&
          (family->id == own->id ||
           std::find(alike.begin(), alike.end(), family->id) != alike.end()))
        others.push_back(candidate);
    }
    return others;
  }

  void settle(std::vector<DriveEffect>& effects) {
    for (int round = 0; round < 4; ++round) {
      refine_drive_shapes(selection_.context(), selection_.value_nm(), FitRows::kAll, effects);
      const DriveContext here = selection_.context();
      selection_.move_state_to(
          DriveSelection::state_of(DriveFit(here, selection_.value_nm(), effects, FitRows::kAll)));
    }
  }
  [[nodiscard]] double square_of(const std::vector<DriveEffect>& effects) const {
    const DriveContext here = selection_.context();
    return DriveFit(here, selection_.value_nm(), effects, FitRows::kAll).residual_square();
  }

  /// The intervals of all but the exchanged one hold what they are in the other set.
  void hold(const std::vector<DriveEffect>& with, std::size_t exchanged) {
    const DriveContext here = selection_.context();
    const DriveFit fit(here, selection_.value_nm(), with, FitRows::kAll);
    for (std::size_t e = 0; e < with.size(); ++e) {
      const DriveFamily& family = *with[e].family;
      const double b = fit.coefficients()[fit.first_column(static_cast<int>(e))];
      if ((family.only_positive && !(b > 0.0)) ||
          (family.plausible && !family.plausible(selection_.model(), b)))
        return;
    }
    const Eigen::MatrixXd covariance = fit.covariance();
    const double t = student_95(fit.degrees());
    for (std::size_t e = 0; e < with.size(); ++e) {
      const DriveFamily& family = *with[e].family;
      FoundEffect* as_told = e == exchanged ? nullptr : told(with[e]);
      if (as_told == nullptr || with[e].columns() != 1) continue;
      const int column = fit.first_column(static_cast<int>(e));
      const double half = t * std::sqrt(std::max(0.0, covariance(column, column)));
      const double base = family.base ? family.base(here) : 0.0;
      for (Parameter& p : as_told->parameters) {
        if (p.name != family.parameters.front()) continue;
        p.low = std::min(p.low, base + fit.coefficients()[column] - half);
        p.high = std::max(p.high, base + fit.coefficients()[column] + half);
      }
    }
  }

  DriveSelection& selection_;
  const std::vector<DriveEffect>& effects_;
  std::vector<FoundEffect>& found_;
};

}  // namespace

void hold_exchanged_effects(DriveSelection& selection, const std::vector<DriveEffect>& effects,
                            std::vector<FoundEffect>& found) {
  if (effects.size() > 1) Exchange(selection, effects, found).run();
}

}  // namespace trueflank::loop

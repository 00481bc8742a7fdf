// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/several_parts.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "trueflank/base/contract.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/found_effects.h"
#include "trueflank/loop/gear/measure_next.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/part_loop.h"
#include "trueflank/loop/gear/part/structure_left.h"
#include "trueflank/loop/gear/shape_refinement.h"

namespace trueflank::loop {
namespace {

constexpr double kRepeats = 0.05;   ///< level of the test of repeatability
constexpr double kSeen = 2e-3;      ///< a part that keeps less of a column than this cannot show it
constexpr double kStandsOut = 3.0;  ///< standard errors at which an effect counts as being on a part

/// An effect of the whole set: where it came from, and what each part says of it.
struct Member {
  Effect effect;
  ChosenGroup record;
  int found_on = -1;  ///< part whose own procedure found it; -1: all parts together
  std::vector<Eigen::VectorXd> values;  ///< coefficients, a part; empty: cannot be seen there
  std::vector<bool> stands_out;
  bool repeats = false;
  double p_value = kNaN;
  [[nodiscard]] Eigen::VectorXd mean(int without = -1) const {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(effect.columns());
    int count = 0;
    for (int p = 0; p < static_cast<int>(values.size()); ++p) {
      if (p == without || values[p].size() == 0) continue;
      sum += values[p];
      ++count;
    }
    return count > 0 ? Eigen::VectorXd(sum / count) : sum;
  }
};

bool same_effect(const Effect& a, const Effect& b) {
  return a.family == b.family && a.flank == b.flank &&
         (a.shape == b.shape || a.family->shape_is_continuous);
}

class PartsLoop {
 public:
  PartsLoop(const FlankGeometry& geometry, std::vector<PartTable> parts, const LoopOptions& options)
      : geometry_(geometry), parts_(std::move(parts)), options_(options) {
    TRUEFLANK_EXPECTS(parts_.size() >= 2);
  }

  GearLoop run() {
    discover_all();
    fit_each();
    for (Member& member : members_) judge(member);
    GearLoop done{LoopResult{}, geometry_, {}, {}, {}};
    describe(done.result);
    figures(done);
    verdict(done.result);
    find_largest_errors(done);
    return done;
  }

 private:
  [[nodiscard]] int count() const { return static_cast<int>(parts_.size()); }

  void discover_all() {
    std::vector<const Observations*> tables;
    for (const PartTable& part : parts_) tables.push_back(part.table.operator->());
    const int tests = count() + 1;
    together_ = std::make_unique<PartModel>(geometry_, joined_table(tables),
                                            PartOptions{.declared = options_.declared,
                                                        .makings = options_.makings,
                                                        .joined = true,
                                                        .tables = tests});
    explain_part(*together_);
    add_members(*together_, 0, -1);
    const std::vector<Effect> given = together_->effects;
    for (int p = 0; p < count(); ++p) {
      each_.push_back(std::make_unique<PartModel>(geometry_, std::move(parts_[p].table),
                                                  PartOptions{.declared = options_.declared,
                                                              .makings = options_.makings,
                                                              .given = given,
                                                              .tables = tests}));
      explain_part(*each_.back());
      add_members(*each_.back(), given.size(), p);
    }
  }

  void add_members(const PartModel& model, std::size_t from, int part) {
    for (std::size_t i = from; i < model.effects.size(); ++i) {
      const Effect& effect = model.effects[i];
      const bool known = std::any_of(members_.begin(), members_.end(), [&](const Member& m) {
        return same_effect(m.effect, effect);
      });
      if (known) continue;
      Member member;
      member.effect = effect;
      member.record = model.discovery.chosen[i];
      member.found_on = part;
      members_.push_back(std::move(member));
    }
  }

  /// All effects of the set on each part alone, with free coefficients.
  void fit_each() {
    std::vector<Effect> all;
    for (const Member& member : members_) all.push_back(member.effect);
    sizes_.assign(members_.size(), {});
    spreads_.assign(members_.size(), std::vector<Eigen::MatrixXd>(parts_.size()));
    for (int p = 0; p < count(); ++p) {
      const PointFit fit(geometry_, each_[p]->table, each_[p]->patches, all);
      for (std::size_t m = 0; m < members_.size(); ++m) {
        const int first = fit.first_column(static_cast<int>(m)), columns = all[m].columns();
        bool seen = true, stands_out = false;
        Eigen::VectorXd size(columns);
        for (int k = 0; k < columns; ++k) {
          seen = seen && fit.retained(first + k) > kSeen;
          size[k] = fit.column_size(first + k);
          stands_out = stands_out || std::abs(fit.coefficients()[first + k]) >
                                         kStandsOut * std::sqrt(fit.covariance()(first + k, first + k));
        }
        members_[m].values.push_back(
            seen ? Eigen::VectorXd(fit.coefficients().segment(first, columns)) : Eigen::VectorXd());
        members_[m].stands_out.push_back(seen && stands_out);
        if (!seen) continue;
        sizes_[m] = size;
        spreads_[m][p] = fit.covariance().block(first, first, columns, columns);
      }
    }
  }

  /// Is the mean over the parts larger than their scatter about it allows by chance? Columns are
  /// compared by what they do to a flank; the scatter is never taken for less than the measurement's.
  void judge(Member& member) {
    const std::size_t m = static_cast<std::size_t>(&member - members_.data());
    const Eigen::VectorXd mean = member.mean();
    const auto columns = mean.size();
    double parts = 0.0, scatter = 0.0, measured = 0.0, level = 0.0;
    for (int p = 0; p < count(); ++p) {
      if (member.values[p].size() == 0) continue;
      parts += 1.0;
      scatter += (member.values[p] - mean).cwiseProduct(sizes_[m]).squaredNorm();
      for (Eigen::Index k = 0; k < columns; ++k)
        measured += spreads_[m][p](k, k) * sizes_[m][k] * sizes_[m][k];
    }
    if (parts < 2.0) return;
    level = parts * mean.cwiseProduct(sizes_[m]).squaredNorm() / static_cast<double>(columns);
    scatter /= static_cast<double>(columns) * (parts - 1.0);
    measured /= static_cast<double>(columns) * parts;
    const double f = level / std::max({scatter, measured, 1e-300});
    member.p_value = f_tail(f, static_cast<double>(columns),
                            static_cast<double>(columns) * (parts - 1.0));
    member.repeats = member.p_value < kRepeats;
  }

  /// Effects that are on a part: the repeatable ones, and one-off ones that stand out there.
  [[nodiscard]] std::vector<int> members_on(int part) const {
    std::vector<int> result;
    for (int m = 0; m < static_cast<int>(members_.size()); ++m)
      if (members_[m].repeats ? members_[m].values[part].size() > 0 : members_[m].stands_out[part])
        result.push_back(m);
    return result;
  }

  void describe(LoopResult& result) const {
    result.not_observable = not_observable(*together_);
    std::vector<Effect> repeatable;
    DiscoveryResult records;
    std::vector<int> numbers;
    for (int m = 0; m < static_cast<int>(members_.size()); ++m) {
      if (!members_[m].repeats) continue;
      repeatable.push_back(members_[m].effect);
      records.chosen.push_back(members_[m].record);
      numbers.push_back(m);
    }
    const PointFit fit(geometry_, together_->table, together_->patches, repeatable);
    const auto spread =
        shape_uncertainty(geometry_, together_->table, together_->patches, fit, FreeShapes::kAll);
    auto found = describe_effects({geometry_, fit, records, together_->candidates, spread,
                                   result.not_observable, options_.makings, together_->unseen});
    for (FoundEffect& effect : found) add_parts(effect, numbers);
    result.effects = std::move(found);
    for (int p = 0; p < count(); ++p) describe_one_offs(p, result);
    result.measure_next = measurements_that_separate(result.effects, result.not_observable,
                                                     *together_->table.operator->());
  }

  /// What each part says of a repeatable effect; of unnamed ones the strongest term stands for all.
  void add_parts(FoundEffect& found, const std::vector<int>& numbers) const {
    found.repeatable = true;
    for (const int m : numbers) {
      const Member& member = members_[m];
      const bool unnamed = !found.terms.empty();
      if (unnamed ? !is_first_term(found, member.effect) : !is_of(found, member.effect)) continue;
      found.repeat_p_value = member.p_value;
      for (int p = 0; p < count(); ++p)
        if (member.values[p].size() > 0)
          found.in_parts.push_back(
              {parts_[p].name, parameter_values(member.effect, member.values[p])});
    }
  }
  static bool is_of(const FoundEffect& found, const Effect& effect) {
    const char* flank = effect.flank == FlankChoice::kBoth   ? "both"
                        : effect.flank == FlankChoice::kLeft ? "left"
                                                             : "right";
    if (effect.family->named ? found.id != effect.family->id : found.named) return false;
    if (found.flank != flank) return false;
    for (std::size_t k = 0; k < effect.shape.size() && k < found.parameters.size(); ++k)
      if (found.parameters[k].value != effect.shape[k]) return false;
    return true;
  }
  static bool is_first_term(const FoundEffect& found, const Effect& effect) {
    return effect.is_term() && effect.shape == found.terms.front().shape;
  }

  void describe_one_offs(int part, LoopResult& result) const {
    const PartModel& model = *each_[part];
    std::vector<Effect> effects;
    DiscoveryResult records;
    std::vector<bool> only;
    for (const int m : members_on(part)) {
      effects.push_back(members_[m].effect);
      records.chosen.push_back(members_[m].record);
      only.push_back(!members_[m].repeats);
    }
    if (std::none_of(only.begin(), only.end(), [](bool one) { return one; })) return;
    const PointFit fit(geometry_, model.table, model.patches, effects);
    const auto spread =
        shape_uncertainty(geometry_, model.table, model.patches, fit, FreeShapes::kAll);
    for (FoundEffect& found :
         describe_effects({geometry_, fit, records, model.candidates, spread, result.not_observable,
                           options_.makings, model.unseen, kNaN, only})) {
      found.repeatable = false;
      found.correctable = false;
      found.part = parts_[part].name;
      for (const Member& member : members_)
        if (found.terms.empty() ? is_of(found, member.effect) : is_first_term(found, member.effect))
          found.repeat_p_value = member.p_value;
      result.effects.push_back(std::move(found));
    }
  }

  void figures(GearLoop& done) const {
    LoopResult& result = done.result;
    std::vector<const Observations*> tables;
    std::vector<std::vector<float>> before(parts_.size()), after(parts_.size());
    Sum as_designed, explained, new_before, new_after, noise;
    Sum held_before, held_after;
    for (int p = 0; p < count(); ++p) {
      const PartModel& model = *each_[p];
      std::vector<Effect> effects;
      for (const int m : members_on(p)) effects.push_back(members_[m].effect);
      const auto without = plain_fit(model);
      const PointFit& none = *without;
      const PointFit fit(geometry_, model.table, model.patches, effects);
      const auto plain = none.errors({}), full = fit.errors(std::vector<bool>(effects.size(), true));
      const double n = fit.observations(), held = fit.held_out();
      as_designed.add(plain.rms_um, n);
      explained.add(full.rms_um, n);
      held_before.add(plain.held_out_rms_um, held);
      held_after.add(full.held_out_rms_um, held);
      noise.add(fit.noise_um(), n);
      new_before.add(plain.rms_um, n);
      new_after.add(error_under_the_others(p), n);
      result.observations += fit.observations();
      result.held_out += fit.held_out();
      result.outliers += model.table->outliers;
      result.parts.push_back({parts_[p].name, fit.observations(),
                              {plain.rms_um, plain.held_out_rms_um, 0.0},
                              {full.rms_um, full.held_out_rms_um, 0.0}});
      for (const std::string& note : model.table->notes)
        result.notes.push_back(parts_[p].name + ": " + note);
      before[p] = none.residuals_without_effects_um();
      after[p] = *fit.residuals_um();
      for (std::size_t i = 0; i < after[p].size(); ++i) {
        if (!counts_as_error(model.table->rows[i].kind)) continue;
        auto& own = result.parts.back();
        own.before.max = std::max(own.before.max, static_cast<double>(std::abs(before[p][i])));
        own.after.max = std::max(own.after.max, static_cast<double>(std::abs(after[p][i])));
      }
      tables.push_back(model.table.operator->());
    }
    result.before = {as_designed.root(), held_before.root(), 0.0};
    result.after = {explained.root(), held_after.root(), 0.0};
    result.noise = noise.root();
    result.new_part_before = new_before.root();
    result.new_part_after = new_after.root();
    done.table = joined_table(tables);
    join(tables, before, done.before_um);
    join(tables, after, done.after_um);
  }

  struct Sum {
    double squares = 0.0, count = 0.0;
    void add(double rms, double n) {
      if (!(n > 0.0) || std::isnan(rms)) return;
      squares += n * rms * rms;
      count += n;
    }
    [[nodiscard]] double root() const { return count > 0.0 ? std::sqrt(squares / count) : kNaN; }
  };

  /// Error of a part under the mean of the other parts' repeatable effects.
  [[nodiscard]] double error_under_the_others(int part) const {
    std::vector<Effect> effects;
    std::vector<double> given;
    for (const Member& member : members_) {
      if (!member.repeats) continue;
      const Eigen::VectorXd mean = member.mean(part);
      effects.push_back(member.effect);
      given.insert(given.end(), mean.data(), mean.data() + mean.size());
    }
    const PartModel& model = *each_[part];
    const PointFit fit(geometry_, model.table, model.patches, effects);
    return fit.rms_with_um(Eigen::Map<const Eigen::VectorXd>(
        given.data(), static_cast<Eigen::Index>(given.size())));
  }

  /// Values of the rows of several tables in the order of the joined one.
  static void join(const std::vector<const Observations*>& tables,
                   const std::vector<std::vector<float>>& values, std::vector<float>& all) {
    for (const bool scans : {true, false})
      for (std::size_t t = 0; t < tables.size(); ++t) {
        const auto middle =
            values[t].begin() + static_cast<std::ptrdiff_t>(tables[t]->points_mm.size());
        all.insert(all.end(), scans ? values[t].begin() : middle, scans ? middle : values[t].end());
      }
  }

  void verdict(LoopResult& result) const {
    result.structure_p_value = together_->discovery.first_p_value;
    result.structure_left_p_value = together_->discovery.p_left;
    result.structure_left = structure_left(*together_);
    bool left = structure_is_left(*together_);
    for (int p = 0; p < count(); ++p) {
      result.structure_p_value =
          std::min(result.structure_p_value, each_[p]->discovery.first_p_value * (count() + 1));
      result.structure_left_p_value =
          std::min(result.structure_left_p_value, each_[p]->discovery.p_left * (count() + 1));
      if (structure_is_left(*each_[p]) && !left) {
        left = true;
        result.structure_left = "on part " + parts_[p].name + " " + structure_left(*each_[p]);
      }
    }
    const bool free = std::any_of(each_.begin(), each_.end(), [](const auto& loop) {
      const auto& poses = loop->table->pose_is_free;
      return std::find(poses.begin(), poses.end(), true) != poses.end();
    });
    if (free)
      result.notes.push_back(
          "scans in any pose number their teeth each for itself: what varies around the gear can only "
          "repeat between parts whose scans are aligned (--aligned)");
    result.verdict = left                     ? Verdict::kPartlyExplained
                     : result.effects.empty() ? Verdict::kNoEffect
                                              : Verdict::kExplained;
  }

  const FlankGeometry& geometry_;
  std::vector<PartTable> parts_;
  const LoopOptions& options_;
  std::unique_ptr<PartModel> together_;
  std::vector<std::unique_ptr<PartModel>> each_;
  std::vector<Member> members_;
  std::vector<Eigen::VectorXd> sizes_;                  ///< of the columns of each member
  std::vector<std::vector<Eigen::MatrixXd>> spreads_;   ///< covariance of each member on each part
};

}  // namespace

GearLoop close_loop_of_parts(const FlankGeometry& geometry, std::vector<PartTable> parts,
                             const LoopOptions& options) {
  return PartsLoop(geometry, std::move(parts), options).run();
}

}  // namespace trueflank::loop

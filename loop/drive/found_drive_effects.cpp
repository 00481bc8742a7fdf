// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/drive/found_drive_effects.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <string_view>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/base/legendre.h"
#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/geometry/linear_equations.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/result/describe.h"

namespace trueflank::loop {
namespace {

/// Rows that carry less than this share of the largest load say little about efficiency.
constexpr double kLoaded = 0.2;

double rms_of(const DriveContext& context, const Eigen::VectorXd& left, bool held_out,
              bool points) {
  double sum = 0.0, count = 0.0;
  for (std::size_t i = 0; i < context.table.points.size(); ++i) {
    const BenchPoint& p = context.table.points[i];
    if (held_out && p.fold != 0) continue;
    double error = left[static_cast<Eigen::Index>(i)];
    if (points) {
      if (p.load_nm < kLoaded * context.table.most_load_nm) continue;
      error *= 100.0 / (p.load_nm * (p.forward ? context.model.ratio : 1.0));
    }
    sum += error * error;
    count += 1.0;
  }
  return count > 0.0 ? std::sqrt(sum / count) : kNaN;
}

class Describer {
 public:
  explicit Describer(const DriveSources& s)
      : s_(s), covariance_(s.all.covariance()), t_(student_95(s.all.degrees())) {}

  std::vector<FoundEffect> run() {
    std::map<double, std::size_t> unnamed_at;  // order -> place in found_
    for (int e = 0; e < static_cast<int>(s_.all.effects().size()); ++e) {
      const DriveEffect& effect = s_.all.effects()[e];
      if (effect.family->named) {
        found_.push_back(common(e));
        found_.back().parameters = drive_parameters(s_.all, covariance_, e);
        if (effect.family->told)
          found_.back().description = effect.family->told(
              s_.context, effect.shape, s_.all.coefficients()[s_.all.first_column(e)], {});
        if (is_a_guess(found_.back()))
          take_the_name(found_.back(), e,
                        "a loss at the input of which these data do not say whether it follows "
                        "load, speed or "
                        "neither");
        else if (may_be_a_bent_sensor(found_.back()))
          take_the_name(found_.back(), e,
                        "a torque that bends over the load, in one direction alone: a loss, or a "
                        "sensor or motor "
                        "constant that is not straight");
        else if (leaves_too_much(e))
          take_the_name(
              found_.back(), e,
              "a torque that differs from the model, of which more than a quarter does not "
              "follow any known cause");
        members_.push_back({e});
        continue;
      }
      if (effect.family->stands_alone) {
        found_.push_back(common(e));
        members_.push_back({e});
        finish_alone(found_.back(), e);
        continue;
      }
      const double order = effect.order();
      const auto [place, is_new] = unnamed_at.emplace(order, found_.size());
      if (is_new) {
        found_.push_back(common(e));
        members_.push_back({});
      }
      members_[place->second].push_back(e);
      add_terms(found_[place->second].terms, e);
    }
    for (const auto& [order, place] : unnamed_at)
      finish_unnamed(found_[place], order, members_[place]);
    for (std::size_t i = 0; i < found_.size(); ++i) add_figures(found_[i], members_[i]);
    share_what_is_explained();
    return std::move(found_);
  }

 private:
  FoundEffect common(int e) const {
    const DriveEffect& effect = s_.all.effects()[e];
    const DriveFamily& family = *effect.family;
    const ChosenGroup& chosen = s_.chosen[e];
    FoundEffect found;
    found.id = family.id;
    found.named = family.named;
    found.description = family.description;
    found.cause = family.cause;
    found.correction = family.correction;
    found.side = family.side;
    found.p_value = chosen.p_value;
    found.bic_gain = chosen.bic_gain;
    found.correctable = family.is_loss && family.named;
    if (family.detail) found.description += family.detail(s_.context.model, effect.shape);
    const auto add = [&](const std::string& id) {
      if (id != found.id && std::find(found.confounded_with.begin(), found.confounded_with.end(),
                                      id) == found.confounded_with.end())
        found.confounded_with.push_back(id);
    };
    for (const int group : chosen.confounded)
      if (s_.candidates[group].family->named) add(s_.candidates[group].family->id);
    if (const auto others = s_.exchangeable.find(family.id); others != s_.exchangeable.end())
      for (const std::string& id : others->second) add(id);
    // (what a sensor reads otherwise on either way is no friction)
    const bool reads_either_way = family.stands_alone && !family.is_loss;
    if (s_.context.table.impossible == Impossible::kEfficiencyAboveOne && !reads_either_way) {
      // Not tried, and not because the data exclude them.
      for (const DriveFamily& hidden : drive_library())
        if (hidden.hides_in_gains && !is_fitted(hidden)) add(hidden.id);
      if (!s_.context.table.has(true) || !s_.context.table.has(false)) add("swapped_side");
    }
    std::sort(found.confounded_with.begin(), found.confounded_with.end());
    return found;
  }

  [[nodiscard]] bool is_fitted(const DriveFamily& family) const {
    const std::vector<DriveEffect>& effects = s_.all.effects();
    return std::any_of(effects.begin(), effects.end(),
                       [&](const DriveEffect& e) { return e.family == &family; });
  }

  [[nodiscard]] static std::size_t size_of(const DriveFamily& family) {
    return family.parameters.size() + family.shape_names.size();
  }

  /// True where a loss bends over the load and one direction alone was run: a sensor that is bent,
  /// or a motor's constant that falls, does the same.
  [[nodiscard]] bool may_be_a_bent_sensor(const FoundEffect& found) const {
    const DriveFamily* family = find_drive_family(found.id);
    return family && family->bends_over_load &&
           (!s_.context.table.has(true) || !s_.context.table.has(false));
  }

  /// True where a loss may as well follow the load, the speed or nothing: what it is was not
  /// measured.
  [[nodiscard]] static bool is_a_guess(const FoundEffect& found) {
    constexpr std::size_t kTooMany = 3;
    std::set<std::string> follows;
    const auto add = [&](const std::string& id) {
      if (const DriveFamily* family = find_drive_family(id); family && !family->follows.empty())
        follows.insert(family->follows);
    };
    add(found.id);
    if (follows.empty()) return false;
    // One with more parameters holds this one as a limit: no other cause.
    const std::size_t own = size_of(*find_drive_family(found.id));
    for (const std::string& other : found.confounded_with)
      if (const DriveFamily* family = find_drive_family(other); family && size_of(*family) <= own)
        add(other);
    return follows.size() >= kTooMany;
  }

  /// True where what is left holds structure of a good part of the effect's own size: a form that
  /// does not follow the data is no ground for a name.
  [[nodiscard]] bool leaves_too_much(int e) const {
    constexpr double kPart = 0.25;
    const Eigen::VectorXd& structure = s_.remainder.structure_nm;
    if (structure.size() == 0) return false;
    const Eigen::VectorXd moved = s_.all.explained_nm(e);
    double left = 0.0, own = 0.0;
    for (Eigen::Index i = 0; i < moved.size(); ++i) {
      const double sigma = s_.context.table.points[static_cast<std::size_t>(i)].sigma_nm;
      left += structure[i] * structure[i] / (sigma * sigma);
      own += moved[i] * moved[i] / (sigma * sigma);
    }
    return left > kPart * kPart * own;
  }

  /// Of a size, without a name: the names it could have stay in confounded_with.
  void take_the_name(FoundEffect& found, int e, const std::string& why) const {
    const Eigen::VectorXd moved = s_.all.explained_nm(e);
    double sum = 0.0;
    for (std::size_t i = 0; i < s_.context.table.points.size(); ++i) {
      const double lost =
          moved[static_cast<Eigen::Index>(i)] / s_.context.lever(s_.context.table.points[i]);
      sum += lost * lost;
    }
    const Parameter& main = found.parameters.back();
    const double size = std::sqrt(sum / static_cast<double>(s_.context.table.points.size()));
    const double share =
        main.value != 0.0 ? 0.5 * (main.high - main.low) / std::abs(main.value) : 0.0;
    Term term{.shape = {0.0, 0.0, 0.0, 0.0, 0.0}, .cos = size, .half_width = size * share};
    term.keys.emplace_back("like", found.id);
    term.text = why;
    std::string known = found.id;
    std::replace(known.begin(), known.end(), '_', ' ');
    found.description = term.text + "; of the known causes " + known + " comes nearest";
    found.confounded_with.insert(found.confounded_with.begin(), found.id);
    found.id = "unnamed";
    found.named = false;
    found.cause.clear();
    found.correction.clear();
    found.terms = {term};
    found.parameters = parameters_of_terms(found.terms, 0.0, "amplitude_nm", false);
  }

  [[nodiscard]] double half(int column) const {
    return t_ * std::sqrt(std::max(0.0, covariance_(column, column)));
  }

  void add_terms(std::vector<Term>& terms, int e) const {
    const DriveEffect& effect = s_.all.effects()[e];
    int column = s_.all.first_column(e);
    const auto shapes = effect.family->term_shapes(effect.shape);
    const int each = effect.columns() / static_cast<int>(shapes.size());
    for (const DriveShape& shape : shapes) {
      Term t = term_of(*effect.family, shape);
      t.text = words_for(s_.context.model, effect, &s_.context);
      t.cos = s_.all.coefficients()[column];
      t.half_width = half(column);
      if (each == 2) {
        t.sin = s_.all.coefficients()[column + 1];
        t.half_width = std::max(t.half_width, half(column + 1));
      }
      column += each;
      terms.push_back(std::move(t));
    }
  }

  /// One that is told by figures of its own: where it begins, how wide it is.
  void finish_alone(FoundEffect& found, int e) const {
    const DriveEffect& effect = s_.all.effects()[e];
    const double amount = s_.all.coefficients()[s_.all.first_column(e)];
    const std::vector<Parameter>& figures = s_.figures[static_cast<std::size_t>(e)];
    add_terms(found.terms, e);
    found.parameters = parameters_of_terms(found.terms, 0.0, "amplitude_nm", false);
    for (const Parameter& figure : figures) {
      const auto own = std::find_if(found.parameters.begin(), found.parameters.end(),
                                    [&](const Parameter& p) { return p.name == figure.name; });
      if (own != found.parameters.end())
        *own = figure;
      else
        found.parameters.push_back(figure);
    }
    found.description = effect.family->told(s_.context, effect.shape, amount, figures);
    for (Term& term : found.terms) term.text = found.description;
  }

  void finish_unnamed(FoundEffect& found, double order, const std::vector<int>& members) const {
    sort_by_size(found.terms);
    // Pieces of one course that are smaller than their error say nothing beside its larger ones.
    std::set<std::string> said;
    std::erase_if(found.terms, [&](const Term& t) {
      return !said.insert(t.text).second && t.amplitude() < t.half_width;
    });
    // The same sign as a reading in both directions.
    const bool reads = only_reads(members);
    found.description = reads ? "a reading of the output's torque " : "a loss at the input ";
    bool first = true;
    for (const Term& term : found.terms) {
      Term t = term;
      const std::string opposite = ", opposite in the two directions";
      if (const auto at = t.text.find(opposite); reads && at != std::string::npos)
        t.text.erase(at, opposite.size());
      if (found.description.find(t.text) != std::string::npos) continue;
      found.description += (first ? "" : "; and ") + t.text;
      first = false;
    }
    found.parameters = parameters_of_terms(found.terms, order, "amplitude_nm", order != 0.0);
    found.description += order != 0.0 ? where_a_wave_is_most(found.terms.front(), order, reads)
                                      : where_it_is_most(members);
    if (!reads) return;
    if (order != 0.0) {
      constexpr std::size_t kAmplitude = 1;  // after the order
      Parameter at_output = found.parameters[kAmplitude];
      at_output.name = "reads_more_nm";
      for (double* value : {&at_output.value, &at_output.low, &at_output.high})
        *value *= s_.context.model.ratio;
      found.description +=
          ": " + drive_effects::with_interval(at_output, " N m more and less of it");
      found.parameters.push_back(at_output);
    }
    found.description += drive_effects::kNoLoss;
  }

  /// True of courses and waves that are opposite in the two directions, as a sensor's are.
  [[nodiscard]] bool only_reads(const std::vector<int>& members) const {
    return std::all_of(members.begin(), members.end(), [&](int e) {
      const DriveEffect& effect = s_.all.effects()[e];
      const DriveFamily& family = *effect.family;
      if (family.named || family.stands_alone) return false;
      if (!family.is_loss) return true;
      const std::vector<DriveShape> terms = family.term_shapes(effect.shape);
      return std::all_of(terms.begin(), terms.end(),
                         [](const DriveShape& term) { return term[4] != 0.0; });
    });
  }

  /// At which angle of the input the loss is most.
  [[nodiscard]] static std::string where_a_wave_is_most(const Term& term, double order,
                                                        bool reads) {
    // (forward a loss reads less)
    const double sign = reads ? -1.0 : 1.0;
    const double most = deg_from_rad(std::atan2(sign * term.sin, sign * term.cos)) / order,
                 every = 360.0 / order;
    // What takes longer than a turn is counted in turns.
    if (every > 361.0)
      return printed(", most %.3g turns of the input", (most < 0.0 ? most + every : most) / 360.0) +
             printed(" after its angle is 0 and every %.4g turns on", every / 360.0);
    return printed(", most at %.3g degrees of the input", most < 0.0 ? most + every : most) +
           (every < 359.0 ? printed(" and every %.4g degrees on", every) : "");
  }

  /// True of courses without a name: where they cost most and least, and how much, says their sign.
  [[nodiscard]] bool tells_sizes(const std::vector<int>& members) const {
    return std::all_of(members.begin(), members.end(), [&](int e) {
      const DriveEffect& effect = s_.all.effects()[e];
      return !effect.family->named && effect.family->is_loss && !effect.family->stands_alone &&
             effect.order() == 0.0;
    });
  }

  /// Where what they tell together costs most and least, and by how much.
  [[nodiscard]] std::string where_it_is_most(const std::vector<int>& members) const {
    constexpr double kNothing = 0.02;
    if (!tells_sizes(members)) return "";
    const auto& points = s_.context.table.points;
    Eigen::VectorXd lost = Eigen::VectorXd::Zero(s_.value.size());
    // over load, speed, temperature; the directions, the course of the run
    bool over[3] = {false, false, false}, directions = false, run = false;
    for (const int e : members) {
      const DriveEffect& effect = s_.all.effects()[e];
      lost += s_.all.explained_nm(e);
      bool any = false;
      for (const DriveShape& term : effect.family->term_shapes(effect.shape)) {
        for (const std::size_t k : {0U, 1U, 2U}) any = (over[k] = over[k] || term[k] != 0.0) || any;
        directions = directions || term[4] != 0.0;
      }
      run = run || (!any && !effect.family->piece_over);
    }
    const bool reads = only_reads(members);
    for (Eigen::Index i = 0; i < lost.size(); ++i) {
      const BenchPoint& p = points[static_cast<std::size_t>(i)];
      lost[i] /= reads ? s_.context.misread(p, false) : -s_.context.lever(p);
    }
    directions = directions && !reads;
    Eigen::Index low = 0, high = 0;
    lost.minCoeff(&low);
    lost.maxCoeff(&high);
    const auto at = [&](Eigen::Index i) {
      const BenchPoint& p = points[static_cast<std::size_t>(i)];
      std::string text;
      const auto add = [&](const std::string& what) { text += (text.empty() ? "" : ", ") + what; };
      if (over[0]) add(printed("%.3g N m", p.load_nm));
      if (over[1]) add(printed("%.4g rpm", p.speed_rpm));
      if (over[2]) add(printed("%.3g C", p.temperature_c));
      if (run) add("line " + std::to_string(p.line));
      if (directions || run) add(p.forward ? "forward" : "backward");
      if (std::abs(lost[i]) < kNothing * lost.cwiseAbs().maxCoeff())
        return "next to nothing at " + text;
      return printed("%.3g N m ", std::abs(lost[i])) + (lost[i] > 0.0 ? "more" : "less") +
             (text.empty() ? "" : " at " + text);
    };
    return ": " + at(high) + ", " + at(low);
  }

  void add_figures(FoundEffect& found, const std::vector<int>& members) const {
    std::vector<bool> left_out(s_.all.effects().size(), false);
    for (const int e : members) left_out[e] = true;
    const Eigen::VectorXd held = s_.value - s_.training.explained_nm();
    const Eigen::VectorXd held_lost =
        s_.value - s_.training.columns() * s_.training.without(left_out);
    found.held_out_gain =
        rms_of(s_.context, held_lost, true, false) - rms_of(s_.context, held, true, false);
    found.sure = sure_words(found.p_value, found.confounded_with);
    if (follows_the_warmth(members) && warmed_with_the_run()) {
      constexpr std::string_view kCertain = "as good as certain";
      if (found.sure.starts_with(kCertain)) found.sure.replace(0, kCertain.size(), "sure");
      found.sure +=
          "; but the temperature changed with the course of the run, and anything else that "
          "changed meanwhile would look the same";
    }
    found.sentence = sentence(found, members);
    if (const std::string& law = s_.all.effects()[members.front()].family->law; !law.empty())
      found.description += ": " + law;
  }

  /// True of a form over the temperature that has no name.
  [[nodiscard]] bool follows_the_warmth(const std::vector<int>& members) const {
    constexpr double kWarmth = 2.0;
    return std::any_of(members.begin(), members.end(), [&](int e) {
      const DriveEffect& effect = s_.all.effects()[e];
      const DriveFamily& family = *effect.family;
      return !family.named && ((family.over && family.over(effect.shape) == kWarmth) ||
                               (family.piece_over && family.piece_over(effect.shape) == kWarmth));
    });
  }

  /// True where a smooth course over the run has nearly all that the temperature changes.
  [[nodiscard]] bool warmed_with_the_run() const {
    constexpr double kNearlyAll = 0.9;
    const BenchTable& table = s_.context.table;
    if (!table.has_temperature) return false;
    const auto n = static_cast<Eigen::Index>(table.points.size());
    Eigen::MatrixXd course(n, 5);
    Eigen::VectorXd warmth(n);
    for (Eigen::Index i = 0; i < n; ++i) {
      const BenchPoint& p = table.points[static_cast<std::size_t>(i)];
      warmth[i] = p.temperature_c - table.mean_temperature_c;
      for (int k = 0; k < 5; ++k) course(i, k) = legendre(k, 2.0 * p.taken - 1.0);
    }
    const double left = (warmth - course * least_squares(course, warmth)).squaredNorm();
    return left < (1.0 - kNearlyAll) * warmth.squaredNorm();
  }

  /// What it is, how much, what it moves the efficiency by, what to do.
  std::string sentence(const FoundEffect& found, const std::vector<int>& members) const {
    Eigen::VectorXd moved = Eigen::VectorXd::Zero(s_.value.size());
    for (const int e : members) moved += s_.all.explained_nm(e);
    std::string text = capitalised(found.description);
    // After the shape's values comes what it amounts to; of one without a name after its order.
    const std::size_t main = found.named ? s_.all.effects()[members.front()].shape.size() : 1;
    // What is told with its figures has told them.
    const DriveFamily& first = *s_.all.effects()[members.front()].family;
    const bool told = first.told && (found.named || first.stands_alone);
    if (!told && (found.named || !tells_sizes(members)) && main < found.parameters.size()) {
      const Parameter& p = found.parameters[main];
      const auto [name, unit] = name_and_unit(p.name);
      text += ": " + name + printed(" %.3g", p.value) + (unit.empty() ? "" : " " + unit);
    }
    const DriveFamily& family = *s_.all.effects()[members.front()].family;
    if (found.named && family.base && !told)
      text += printed(" instead of %.3g as designed", family.base(s_.context));
    const bool reads = !family.is_loss || only_reads(members);
    return text + consequence(reads, moved) + action(found, family);
  }

  /// What to do about it, once what would look the same is ruled out.
  [[nodiscard]] std::string action(const FoundEffect& found, const DriveFamily& family) const {
    if (!found.named && !found.correction.empty()) return "; " + found.correction;
    if (!found.named) return "; its cause is not known: find it before anything is designed on it";
    const bool changes =
        family.into_state && family.follows == "load" &&
        std::any_of(s_.all.effects().begin(), s_.all.effects().end(), [](const DriveEffect& e) {
          return e.family->stands_alone && e.family->beside_load &&
                 e.family->beside_load(e.shape) != kOverNothing;
        });
    if (changes) return "; no one coefficient to design with: it changes, as told beside this";
    return first_action(found.correction) +
           (found.correction.empty() ? "" : once_ruled_out(found.confounded_with));
  }

  /// What it does to the efficiency, in points of it, where the drive is loaded.
  [[nodiscard]] std::string consequence(bool reads, const Eigen::VectorXd& moved) const {
    const double size = rms_of(s_.context, moved, false, true);
    if (!std::isfinite(size)) return {};
    double sum = 0.0, count = 0.0, sizes = 0.0, most = 0.0;
    for (std::size_t i = 0; i < s_.context.table.points.size(); ++i) {
      const BenchPoint& p = s_.context.table.points[i];
      if (p.load_nm < kLoaded * s_.context.table.most_load_nm) continue;
      const double points = moved[static_cast<Eigen::Index>(i)] * 100.0 /
                            (p.load_nm * (p.forward ? s_.context.model.ratio : 1.0));
      sum += points;
      sizes += std::abs(points);
      most = std::max(most, std::abs(points));
      count += 1.0;
    }
    // one that has no side to speak of comes and goes, or raises one direction and lowers the
    // other; one of one side alone costs where it is
    constexpr double kOneSided = 0.95;
    const bool spread = std::abs(sum) < 0.7 * size * count,
               up_and_down = spread && std::abs(sum) < kOneSided * sizes;
    if (reads) return printed(", which falsifies the efficiency by %.2g points under load", size);
    if (up_and_down)
      return printed(", which moves the efficiency by %.2g points up and down under load", size);
    return std::string(sum < 0.0 ? ", which costs " : ", which adds ") + (spread ? "up to " : "") +
           printed("%.2g points of efficiency under load", spread ? most : size);
  }

  /// Every effect's share of what all explain together.
  void share_what_is_explained() {
    const double before = rms_of(s_.context, s_.value, false, false);
    if (!(before > 0.0)) return;
    std::vector<double> squares;
    for (const auto& members : members_) {
      Eigen::VectorXd moved = Eigen::VectorXd::Zero(s_.value.size());
      for (const int e : members) moved += s_.all.explained_nm(e);
      const double size = rms_of(s_.context, moved, false, false);
      squares.push_back(size * size);
    }
    const double left = rms_of(s_.context, s_.value - s_.all.explained_nm(), false, false) / before;
    share_out(found_, squares, 1.0 - left * left);
  }

  const DriveSources& s_;
  const Eigen::MatrixXd covariance_;
  const double t_;
  std::vector<FoundEffect> found_;
  std::vector<std::vector<int>> members_;
};

}  // namespace

std::vector<Parameter> drive_parameters(const DriveFit& fit, const Eigen::MatrixXd& covariance,
                                        int effect) {
  const DriveEffect& e = fit.effects()[static_cast<std::size_t>(effect)];
  const DriveFamily& family = *e.family;
  const DriveContext& context = fit.context();
  const double t = student_95(fit.degrees());
  const auto half = [&](int column) {
    return t * std::sqrt(std::max(0.0, covariance(column, column)));
  };
  const int column = fit.first_column(effect);
  const auto& b = fit.coefficients();
  std::vector<Parameter> parameters;
  for (std::size_t k = 0; k < e.shape.size(); ++k) {
    const int shape = fit.shape_column(effect, static_cast<int>(k));
    parameters.push_back(
        parameter_of(family.shape_names[k], e.shape[k], shape < 0 ? 0.0 : half(shape)));
  }
  if (family.form == ParameterForm::kWave) {
    const auto [amplitude, phase] = wave_parameters(family, b[column], b[column + 1],
                                                    covariance.block<2, 2>(column, column), t);
    parameters.push_back(amplitude);
    parameters.push_back(phase);
    return parameters;
  }
  // A friction is given as the whole coefficient, not as its change.
  const double base = family.base ? family.base(context) : 0.0;
  for (int k = 0; k < e.columns(); ++k)
    parameters.push_back(
        parameter_of(family.parameters[k], base + b[column + k], half(column + k)));
  if (!family.references) return parameters;
  for (const auto& [name, value] : family.references(context))
    parameters.push_back(parameter_of(name, value, 0.0));
  return parameters;
}

std::vector<FoundEffect> describe_drive_effects(const DriveSources& sources) {
  return Describer(sources).run();
}

std::string words_for(const DriveModel& model, const DriveEffect& effect,
                      const DriveContext* context) {
  return effect.family->words ? effect.family->words(model, effect.shape, context)
                              : effect.family->id;
}

ErrorFigures drive_errors(const DriveContext& context, const Eigen::VectorXd& left_all,
                          const Eigen::VectorXd& left_training) {
  ErrorFigures figures;
  figures.rms = rms_of(context, left_all, false, false);
  figures.held_out_rms = rms_of(context, left_training, true, false);
  figures.max = left_all.size() > 0 ? left_all.cwiseAbs().maxCoeff() : 0.0;
  figures.rms_points = rms_of(context, left_all, false, true);
  figures.held_out_rms_points = rms_of(context, left_training, true, true);
  return figures;
}

}  // namespace trueflank::loop

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/found_effects.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <optional>
#include <set>
#include <tuple>

#include "trueflank/base/number_text.h"
#include "trueflank/base/units.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/pose/arbitrary_pose.h"
#include "trueflank/loop/gear/effects/columns.h"
#include "trueflank/loop/gear/orders_alike.h"
#include "trueflank/loop/gear/part/ends.h"
#include "trueflank/loop/result/describe.h"

namespace trueflank::loop {
namespace {

std::string flank_text(FlankChoice flank) {
  switch (flank) {
    case FlankChoice::kLeft:
      return "left";
    case FlankChoice::kRight:
      return "right";
    default:
      return "both";
  }
}

/// Standard errors of a 95 % interval.
double t_of(double degrees) { return student_95(std::max(1.0, degrees)); }

class Describer {
 public:
  explicit Describer(const EffectSources& sources) : sources_(sources) {}

  std::vector<FoundEffect> run() {
    const auto& effects = sources_.fit.effects();
    using TermsOf = std::tuple<const EffectFamily*, FlankChoice, int>;  // and the order
    std::map<TermsOf, std::size_t> unnamed_at;                          // place in found_
    for (int e = 0; e < static_cast<int>(effects.size()); ++e) {
      if (!sources_.only.empty() && !sources_.only[e]) continue;
      if (effects[e].is_term()) {
        const int order = static_cast<int>(effects[e].order());
        const auto [place, is_new] =
            unnamed_at.emplace(TermsOf{effects[e].family, effects[e].flank, order}, found_.size());
        if (is_new) {
          found_.push_back(common(e));
          members_.push_back({});
        }
        members_[place->second].push_back(e);
        found_[place->second].terms.push_back(term(e));
      } else {
        found_.push_back(common(e));
        add_parameters(found_.back(), e);
        members_.push_back({e});
      }
    }
    for (const auto& [terms, place] : unnamed_at)
      finish_unnamed(found_[place], std::get<int>(terms));
    for (std::size_t i = 0; i < found_.size(); ++i) add_figures(found_[i], members_[i]);
    say_what_is_alike();
    say_what_is_one_form();
    say_which_flank_is_open();
    share_what_is_explained();
    return std::move(found_);
  }

 private:
  FoundEffect common(int e) const {
    const Effect& effect = sources_.fit.effects()[e];
    const EffectFamily& family = *effect.family;
    const ChosenGroup& chosen = sources_.discovery.chosen[e];
    FoundEffect found;
    found.id = family.named ? family.id : "unnamed";
    found.named = family.named;
    found.description = with_remark(family.description, family);
    found.cause =
        family.causes.empty() ? family.cause : causes_text(family.causes, sources_.makings);
    if (sources_.makings == kAnyMaking)
      for (const CauseOfMaking& cause : family.causes)
        found.by_process.emplace_back(making_text(cause.makings), cause.cause);
    found.correction = correction_text(family.correction, family.corrections, sources_.makings);
    found.flank = flank_text(effect.flank);
    found.p_value = chosen.p_value;
    found.bic_gain = chosen.bic_gain;
    found.correctable = family.correctable == Correctable::kGeometry;
    found.form = family.formulas;
    if (!family.named && family.local) {
      found.terms = {term(e)};
      found.description = found.terms.front().text;
    }
    for (const int group : chosen.confounded) {
      if (!sources_.unseen.empty() && sources_.unseen[group]) continue;
      const EffectFamily& other = *sources_.candidates[group].family;
      const bool listed = std::find(found.confounded_with.begin(), found.confounded_with.end(),
                                    other.id) != found.confounded_with.end();
      if (other.named && other.id != family.id && !listed)
        found.confounded_with.push_back(other.id);
    }
    return found;
  }

  void add_parameters(FoundEffect& found, int e) const {
    const Effect& effect = sources_.fit.effects()[e];
    const EffectFamily& family = *effect.family;
    const int column = sources_.fit.first_column(e);
    const auto& b = sources_.fit.coefficients();
    const auto& covariance = sources_.uncertainty.covariance;
    for (std::size_t k = 0; k < effect.shape.size(); ++k) {
      const double value = effect.shape[k];
      const double error = sources_.uncertainty.errors[e][k];
      const double half = std::isnan(error) ? 0.0 : 1.96 * error;
      found.parameters.push_back(parameter_of(family.shape_names[k], value, half));
    }
    if (family.form == ParameterForm::kWave) {
      const auto [amplitude, phase] =
          wave_parameters(family, b[column], b[column + 1], covariance.block<2, 2>(column, column),
                          t_of(sources_.fit.degrees(column)));
      found.parameters.push_back(amplitude);
      found.parameters.push_back(phase);
      return;
    }
    for (int k = 0; k < effect.columns(); ++k) {
      Parameter& told = found.parameters.emplace_back(
          parameter_of(family.parameters[k], b[column + k],
                       t_of(sources_.fit.degrees(column + k)) *
                           std::sqrt(std::max(0.0, covariance(column + k, column + k)))));
      if (sources_.uncertainty.otherwise.size() == 0) continue;
      const double change = sources_.uncertainty.otherwise[column + k];
      (change < 0.0 ? told.low : told.high) += change;
    }
  }

  /// Teeth on which an effect stands, or most of it.
  std::vector<int> teeth_of(const Effect& effect) const {
    constexpr double kMostly = 0.5;
    const FlankGeometry& g = sources_.geometry;
    const double low = g.root_form_roll_mm(), high = g.tip_form_roll_mm();
    std::vector<double> sizes;
    for (int tooth = 1; tooth <= g.teeth(); ++tooth) {
      double most = 0.0;
      for (const int side : {1, -1})
        for (const double u : {0.05, 0.3, 0.5, 0.7, 0.95})
          for (const double v : {0.05, 0.3, 0.5, 0.7, 0.95}) {
            std::array<double, 8> columns{};
            effect.evaluate(g,
                            g.on_flank(tooth, side, low + u * (high - low), v * g.face_width_mm()),
                            columns.data());
            for (const double column : columns) most = std::max(most, std::abs(column));
          }
      sizes.push_back(most);
    }
    const double largest = *std::max_element(sizes.begin(), sizes.end());
    std::vector<int> teeth;
    for (int tooth = 1; tooth <= g.teeth(); ++tooth)
      if (sizes[static_cast<std::size_t>(tooth) - 1] > kMostly * largest) teeth.push_back(tooth);
    return teeth;
  }

  /// "first.csv: " of an effect of one file's records.
  std::string in_which_file(const Effect& effect) const {
    if (!effect.family->of_one_file || sources_.table == nullptr) return "";
    const auto file = static_cast<std::size_t>(effect.shape[0]);
    const std::vector<std::string>& files = sources_.table->files;
    return file >= 1 && file <= files.size() ? files[file - 1] + ": " : "";
  }

  /// The traced teeth among those that an effect of some neighbouring teeth is told of, where not
  /// all of these were traced: "; of these teeth 19 and 20 were traced".
  std::string traced_of_them(const Effect& effect, const std::string& words) const {
    if (sources_.table == nullptr || words.find(" teeth from tooth ") == std::string::npos)
      return "";
    const std::vector<int> traced = traced_teeth(*sources_.table), all = teeth_of(effect);
    std::vector<int> these;
    std::set_intersection(all.begin(), all.end(), traced.begin(), traced.end(),
                          std::back_inserter(these));
    if (these.empty() || these.size() == all.size()) return "";
    if (these.size() == traced.size())
      return "; all teeth traced are among these, and the others may have it too";
    if (these.size() == 1) return printed("; of these tooth %d was traced", these.front());
    std::string text = "; of these teeth ";
    for (std::size_t k = 0; k < these.size(); ++k)
      text += (k == 0 ? "" : k + 1 == these.size() ? " and " : ", ") + std::to_string(these[k]);
    return text + " were traced";
  }

  /// Of what stands out towards an end, and most at it: how far it does where the last value was
  /// measured. Empty where that is hardly less.
  std::string at_last_place(const Effect& effect, double amount_um) const {
    constexpr double kHardlyLess = 0.97;
    const std::optional<FormAtAnEnd> form = form_at_an_end(sources_.geometry, effect);
    if (sources_.table == nullptr || !form) return "";
    const bool over_face = form->face != 0.0;
    const auto along = [&](const Place& place) {
      return over_face ? place.z_mm : sources_.geometry.profile_coordinate(place.roll_mm);
    };
    const Place* last = nullptr;
    for (const Observation& row : sources_.table->rows) {
      if (row.kind != ObservationKind::kScanFlank &&
          row.kind != (over_face ? ObservationKind::kHelix : ObservationKind::kProfile))
        continue;
      const Place& place = sources_.table->place(row);
      double column = 0.0;
      if (last != nullptr && !(form->end * (along(place) - along(*last)) > 0.0)) continue;
      effect.evaluate(sources_.geometry, place, &column);
      if (column != 0.0) last = &place;
    }
    if (last == nullptr) return "";
    double share = 0.0;
    effect.evaluate(sources_.geometry, *last, &share);
    if (!(std::abs(share) < kHardlyLess)) return "";
    return printed(", %.3g um", std::abs(amount_um * share)) +
           (over_face ? printed(" at the last height measured, %.4g mm", last->z_mm)
                      : printed(" at the last diameter measured, %.5g mm", 2.0 * last->radius_mm));
  }

  Term term(int e) const {
    const Effect& effect = sources_.fit.effects()[e];
    const int column = sources_.fit.first_column(e);
    const auto& b = sources_.fit.coefficients();
    const auto& covariance = sources_.uncertainty.covariance;
    Term result = term_of(*effect.family, effect.shape);
    const std::span<const double> own(b.data() + column,
                                      static_cast<std::size_t>(effect.columns()));
    const std::string words = in_which_file(effect) + words_for(sources_.geometry, effect, own);
    result.text = with_remark(
        words + traced_of_them(effect, words) + at_last_place(effect, b[column]), *effect.family);
    result.cos = b[column];
    double variance = covariance(column, column);
    if (effect.columns() == 2) {
      result.sin = b[column + 1];
      variance = std::max(variance, covariance(column + 1, column + 1));
    }
    result.half_width = t_of(sources_.fit.degrees(column)) * std::sqrt(std::max(0.0, variance));
    return result;
  }

  /// What is said of a kind of effect besides, where no other that was found denies it.
  std::string with_remark(const std::string& text, const EffectFamily& family) const {
    if (family.remark.text.empty()) return text;
    const auto& effects = sources_.fit.effects();
    const bool denied = std::any_of(effects.begin(), effects.end(), [&](const Effect& other) {
      return other.family->form_word == family.remark.not_beside;
    });
    return denied ? text : text + "; " + family.remark.text;
  }

  void finish_unnamed(FoundEffect& found, int order) const {
    sort_by_size(found.terms);
    found.description.clear();
    for (const Term& t : found.terms)
      found.description += (found.description.empty() ? "" : "; and ") + t.text;
    found.parameters = parameters_of_terms(found.terms, order, "amplitude_um", order > 0);
  }

  void add_figures(FoundEffect& found, const std::vector<int>& members) const {
    const std::size_t count = sources_.fit.effects().size();
    std::vector<bool> with(count, true);
    const auto full = sources_.fit.errors(with);
    for (const int e : members) with[e] = false;
    found.held_out_gain = sources_.fit.errors(with).held_out_rms_um - full.held_out_rms_um;
    if (sources_.table != nullptr)
      found.orders_alike =
          orders_alike(sources_.geometry, *sources_.table, sources_.fit, members.front());
    if (sources_.table != nullptr && found.correctable && is_of_any_pose(*sources_.table) &&
        hangs_on_pose(sources_.geometry, sources_.fit, members)) {
      found.correctable = false;
      found.not_corrected =
          "a scan in any pose does not say which tooth is the first, nor which end is up; measure "
          "it in the gear's frame (--aligned)";
    }
    found.sentence = plain_sentence(found, members.front());
    found.sure = sure_words(found.p_value, found.confounded_with);
    const bool may_be_nothing =
        !found.terms.empty() &&
        std::all_of(found.terms.begin(), found.terms.end(),
                    [](const Term& t) { return t.half_width >= t.amplitude(); });
    // (a small gain of many values: chance does not do it, but what stands beside it may)
    if (found.named && found.bic_gain < 0.0)
      found.sure =
          "likely: it explains no more than its values cost" + open_names(found.confounded_with);
    if (may_be_nothing) found.sure = "a guess: its size may as well be nothing";
    if (is_of_one_value(members.front())) {
      found.sure =
          "a guess: one value says so; a wild reading, dirt or a burr looks the same until that "
          "tooth is measured again";
      found.measure_again = printed(
          "tooth %.0f again, its %s flank: one value of it stands out, as a wild reading, "
          "dirt or a burr does",
          sources_.fit.effects()[static_cast<std::size_t>(members.front())].shape[0],
          found.flank.c_str());
    }
  }

  /// True of a flank that stands out in one value of an index, and in nothing else.
  bool is_of_one_value(int e) const {
    const Effect& effect = sources_.fit.effects()[static_cast<std::size_t>(e)];
    if (sources_.table == nullptr || !effect.family->local || effect.columns() != 1 ||
        effect.flank == FlankChoice::kBoth)
      return false;
    const Observations& table = *sources_.table;
    int values = 0;
    for (const Observation& row : table.rows) {
      bool shows = false;
      for (std::uint32_t p = row.first_place; p < row.first_place + row.places; ++p) {
        double column = 0.0;
        effect.evaluate(sources_.geometry, table.places[p], &column);
        shows = shows || column != 0.0;
      }
      const bool traced =
          row.kind == ObservationKind::kProfile || row.kind == ObservationKind::kHelix;
      // (a trace with a zero of its own does not show a height)
      if (!shows || row.kind == ObservationKind::kSize || (traced && row.trace >= 0)) continue;
      if (row.kind != ObservationKind::kIndex || ++values > 1) return false;
    }
    return values == 1;
  }

  /// What the teeth that were traced do not tell apart, with the first effect that it is true of.
  void say_what_is_alike() {
    std::set<std::vector<int>> said;
    for (FoundEffect& found : found_)
      if (!found.orders_alike.empty() && said.insert(found.orders_alike).second)
        found.sentence += "; the " + std::to_string(traced_teeth(*sources_.table).size()) +
                          " teeth traced would show " + waves_in_words(found.orders_alike) +
                          " alike: the simplest is reported";
  }

  std::string plain_sentence(const FoundEffect& found, int effect) const {
    const EffectFamily& family = *sources_.fit.effects()[effect].family;
    if (found.named)
      return (family.sentence ? family.sentence(sources_.geometry, found) : found.description) +
             first_action(found.correction) + once_ruled_out(found.confounded_with);
    // A form of a size or an axis has its amount in percent.
    const bool in_um = std::none_of(
        effect_library().begin(), effect_library().end(), [&](const EffectFamily& named) {
          return !family.form_word.empty() && named.form_word == family.form_word &&
                 named.parameters.front() == "percent";
        });
    const double size =
        in_um ? found.terms.front().amplitude() : sources_.fit.effect_size_um(effect);
    const FlankChoice flank = sources_.fit.effects()[effect].flank;
    const bool says_flank = family.flank_only || flank == FlankChoice::kBoth;
    const std::string on = says_flank ? "" : ", " + flank_text(flank) + " flanks alone";
    constexpr std::size_t kMostTold = 3;
    const std::size_t told = std::min(found.terms.size(), kMostTold);
    std::string beside;
    for (std::size_t k = 1; k < told; ++k)
      beside += printed("; with it %.3g um: ", found.terms[k].amplitude()) + found.terms[k].text;
    const std::size_t smaller = found.terms.size() - told;
    if (smaller > 0)
      beside += smaller == 1
                    ? printed("; and a smaller form of %.3g um", found.terms[told].amplitude())
                    : printed("; and %zu smaller forms, of %.3g um at most", smaller,
                              found.terms[told].amplitude());
    return printed("A deviation of %.3g um without a known cause: ", size) +
           found.terms.front().text + on + beside +
           (is_of_one_value(effect)
                ? "; one value says so: as likely a wild reading, dirt or a burr; measure that "
                  "tooth again"
            : family.local ? "; inspect that tooth"
                           : "; find its source before anything is corrected");
  }

  /// The flanks of an effect of one coefficient that may be opposite on the two flanks; empty of
  /// others.
  [[nodiscard]] std::optional<std::array<double, 2>> left_and_right(std::size_t place) const {
    if (members_[place].size() != 1) return {};
    const int e = members_[place].front();
    const Effect& effect = sources_.fit.effects()[e];
    const auto& names = effect.family->shape_names;
    if (effect.family->named || effect.columns() != 1 || names.empty() ||
        names.back() != "opposite_flanks" || effect.shape.size() != names.size())
      return {};
    const double amount = sources_.fit.coefficients()[sources_.fit.first_column(e)];
    const double of_left =
        effect.shape.back() != 0.0 ? flank_side(Flank::kLeft, sources_.geometry.gear().kind) : 1.0;
    const double of_right = effect.shape.back() != 0.0 ? -of_left : 1.0;
    return std::array{effect.flank == FlankChoice::kRight ? 0.0 : of_left * amount,
                      effect.flank == FlankChoice::kLeft ? 0.0 : of_right * amount};
  }

  /// One form on both flanks and on one of them as well: what each flank has of it in all.
  void say_what_is_one_form() {
    const auto form_of = [&](std::size_t place) {
      Effect effect = sources_.fit.effects()[members_[place].front()];
      effect.flank = FlankChoice::kBoth;
      effect.shape.back() = 0.0;
      return effect;
    };
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const auto own = left_and_right(i);
      if (!own) continue;
      Effect form = form_of(i);
      std::array<double, 2> in_all = *own;
      bool several = false;
      for (std::size_t k = 0; k < found_.size(); ++k) {
        const auto other = k == i ? std::nullopt : left_and_right(k);
        if (!other || !(form_of(k) == form)) continue;
        several = true;
        in_all[0] += (*other)[0];
        in_all[1] += (*other)[1];
      }
      if (!several) continue;
      // (an endless amount has a sign and no figure: the flanks have one each)
      double sign = std::copysign(std::numeric_limits<double>::infinity(), in_all[0]);
      if (in_all[0] * in_all[1] < 0.0) {
        form.shape.back() = 1.0;
        sign *= flank_side(Flank::kLeft, sources_.geometry.gear().kind);
      }
      found_[i].sentence +=
          printed(
              "; with what else has this form in all %.3g um on the left flanks and %.3g um on "
              "the right ones: ",
              std::abs(in_all[0]), std::abs(in_all[1])) +
          words_for(sources_.geometry, form, {&sign, 1});
    }
  }

  /// How far a scan in a given frame had to be turned about the axis, as far as it moves flanks
  /// [um]; NaN where none is in a given frame.
  double turned_um() const {
    double most = kNaN;
    Eigen::Index column = 0;
    for (const bool free : sources_.table->pose_is_free) {
      if (!free) {
        const double um = std::abs(sources_.fit.coefficients()[column]) *
                          sources_.geometry.base_radius_mm() * sources_.geometry.cos_base_helix();
        most = std::isnan(most) ? um : std::max(most, um);
      }
      column += free ? NuisanceColumns::kOfFreePose : 1;
    }
    return most;
  }

  /// True where tips, roots or a bore were measured, and an effect moves them by as much as the
  /// flanks or nearly: flanks of one side do not.
  bool moves_what_is_no_flank(int e, double height) const {
    constexpr double kNearly = 0.5;
    constexpr int kFewest = 10;  // points
    const Effect& effect = sources_.fit.effects()[static_cast<std::size_t>(e)];
    const double amount = sources_.fit.coefficients()[sources_.fit.first_column(e)];
    int moved = 0;
    for (const Observation& row : sources_.table->rows) {
      const Place& place = sources_.table->place(row);
      if (place.surface == Surface::kFlank || place.surface == Surface::kNone) continue;
      double column = 0.0;
      effect.evaluate(sources_.geometry, place, &column);
      moved += std::abs(amount * column) > kNearly * height ? 1 : 0;
    }
    return moved >= kFewest;
  }

  /// A scanned part may be turned about its axis: what all flanks have alike is perhaps twice as
  /// much on those of one side. Not where what was measured beside the flanks denies it, nor where
  /// the frame that was given, as it stands, bears out what is told: the other would be a turn that
  /// happens to hide in it.
  void say_which_flank_is_open() {
    if (sources_.table == nullptr || !may_be_turned(*sources_.table)) return;
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (members_[i].size() != 1) continue;
      const int e = members_[i].front();
      const double height = std::abs(height_of_flanks_um(sources_.geometry, sources_.fit, e));
      constexpr double kAsGiven = 0.25;  // of the height
      if (!(height > 0.0) || moves_what_is_no_flank(e, height) || turned_um() < kAsGiven * height)
        continue;
      const bool both = sources_.fit.effects()[e].flank == FlankChoice::kBoth;
      found_[i].sentence +=
          (both ? printed("; or flanks of one side alone do by %.3g um", 2.0 * height)
                : printed("; or both flanks do by %.3g um", 0.5 * height)) +
          ": a scan does not show how the part is turned about its axis";
      found_[i].sure = "that it is there, " + found_[i].sure + "; on which flanks is open";
    }
  }

  /// Every effect's share of what all explain together.
  void share_what_is_explained() {
    const std::size_t count = sources_.fit.effects().size();
    const auto square = [&](const std::vector<bool>& with) {
      const double rms = sources_.fit.errors(with).rms_um;
      return rms * rms;
    };
    // Effects that are not described here (of several parts) stay in the model.
    std::vector<bool> with(count, true);
    std::vector<double> squares;
    for (const auto& members : members_) {
      for (const int e : members) with[e] = false;
      const double size = sources_.fit.size_beside_pose_um(members);
      squares.push_back(size * size);
    }
    const double before = square(std::vector<bool>(count, false));
    if (!(before > 0.0)) return;
    const double own = (square(with) - square(std::vector<bool>(count, true))) / before;
    share_out(found_, squares, std::isnan(sources_.explained) ? own : sources_.explained);
  }

  const EffectSources& sources_;
  std::vector<FoundEffect> found_;
  std::vector<std::vector<int>> members_;
};

}  // namespace

std::vector<FoundEffect> describe_effects(const EffectSources& sources) {
  return Describer(sources).run();
}

std::string words_for(const FlankGeometry& geometry, const Effect& effect,
                      std::span<const double> amounts) {
  const EffectFamily& family = *effect.family;
  if (family.words) return family.words({geometry, effect.shape, effect.flank, amounts});
  std::string name = family.id;
  std::replace(name.begin(), name.end(), '_', ' ');
  return gear_effects::with_shape(name, family.shape_names, effect.shape);
}

std::vector<std::pair<std::string, double>> parameter_values(const Effect& effect,
                                                             const Eigen::VectorXd& b) {
  const EffectFamily& family = *effect.family;
  std::vector<std::pair<std::string, double>> values;
  for (std::size_t k = 0; k < effect.shape.size(); ++k)
    values.emplace_back(family.shape_names[k], effect.shape[k]);
  if (family.form == ParameterForm::kWave) {
    values.emplace_back(family.parameters[0], std::hypot(b[0], b[1]));
    values.emplace_back(family.parameters[1],
                        deg_from_rad(std::atan2(b[1], b[0])) / family.phase_divisor);
  } else {
    for (Eigen::Index k = 0; k < b.size(); ++k) values.emplace_back(family.parameters[k], b[k]);
  }
  return values;
}

}  // namespace trueflank::loop

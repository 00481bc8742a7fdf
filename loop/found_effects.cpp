// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/found_effects.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "trueflank/base/units.h"
#include "trueflank/loop/distributions.h"

namespace trueflank::loop {
namespace {

std::string flank_text(FlankChoice flank) {
  switch (flank) {
    case FlankChoice::kLeft: return "left";
    case FlankChoice::kRight: return "right";
    default: return "both";
  }
}

Parameter plain_parameter(const std::string& name, double value, double variance, double degrees) {
  const double half = student_95(std::max(1.0, degrees)) * std::sqrt(std::max(0.0, variance));
  return {name, value, value - half, value + half};
}

/// Amplitude and phase of a cosine and a sine coefficient, with intervals to first order.
std::pair<Parameter, Parameter> wave_parameters(const EffectFamily& family, double c, double s,
                                                const Eigen::Matrix2d& covariance, double degrees) {
  const double amplitude = std::hypot(c, s);
  const double t = student_95(std::max(1.0, degrees));
  const Eigen::Vector2d along(c / amplitude, s / amplitude), across(-s / amplitude, c / amplitude);
  const double half = t * std::sqrt(std::max(0.0, along.dot(covariance * along)));
  const double turn = t * std::sqrt(std::max(0.0, across.dot(covariance * across))) / amplitude;
  const double phase = deg_from_rad(std::atan2(s, c)) / family.phase_divisor;
  const double spread = deg_from_rad(std::min(turn, kPi)) / family.phase_divisor;
  return {{family.parameters[0], amplitude, std::max(0.0, amplitude - half), amplitude + half},
          {family.parameters[1], phase, phase - spread, phase + spread}};
}

class Describer {
 public:
  explicit Describer(const EffectSources& sources) : sources_(sources) {}

  std::vector<FoundEffect> run() {
    const auto& effects = sources_.fit.effects();
    std::map<int, std::size_t> unnamed_at;  // order -> place in found_
    for (int e = 0; e < static_cast<int>(effects.size()); ++e) {
      if (!sources_.only.empty() && !sources_.only[e]) continue;
      if (effects[e].family->id == "unnamed") {
        const int order = static_cast<int>(effects[e].shape[2]);
        const auto [place, is_new] = unnamed_at.emplace(order, found_.size());
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
    for (const auto& [order, place] : unnamed_at) finish_unnamed(found_[place], order);
    for (std::size_t i = 0; i < found_.size(); ++i) add_figures(found_[i], members_[i]);
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
    found.description = family.description;
    found.cause = family.cause;
    found.correction = family.correction;
    found.flank = flank_text(effect.flank);
    found.p_value = chosen.p_value;
    found.bic_gain = chosen.bic_gain;
    found.correctable = family.correctable == Correctable::kGeometry;
    found.form = family.formulas;
    if (!family.named && family.local)
      found.description = "the " + found.flank + " flank of tooth " +
                          std::to_string(static_cast<int>(effect.shape[0])) + " stands out";
    for (const int group : chosen.confounded) {
      const EffectFamily& other = *sources_.candidates[group].family;
      const bool listed = std::find(found.confounded_with.begin(), found.confounded_with.end(),
                                    other.id) != found.confounded_with.end();
      if (other.named && other.id != family.id && !listed) found.confounded_with.push_back(other.id);
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
      found.parameters.push_back({family.shape_names[k], value, value - half, value + half});
    }
    if (family.form == ParameterForm::kWave) {
      const auto [amplitude, phase] =
          wave_parameters(family, b[column], b[column + 1], covariance.block<2, 2>(column, column),
                          sources_.fit.degrees(column));
      found.parameters.push_back(amplitude);
      found.parameters.push_back(phase);
      return;
    }
    for (int k = 0; k < effect.columns(); ++k)
      found.parameters.push_back(plain_parameter(family.parameters[k], b[column + k],
                                                 covariance(column + k, column + k),
                                                 sources_.fit.degrees(column + k)));
  }

  FreeTerm term(int e) const {
    const Effect& effect = sources_.fit.effects()[e];
    const int column = sources_.fit.first_column(e);
    const auto& b = sources_.fit.coefficients();
    const auto& covariance = sources_.uncertainty.covariance;
    FreeTerm result;
    result.profile_degree = static_cast<int>(effect.shape[0]);
    result.face_degree = static_cast<int>(effect.shape[1]);
    result.order = static_cast<int>(effect.shape[2]);
    result.opposite_flanks = effect.shape[3] != 0.0;
    result.cos_um = b[column];
    double variance = covariance(column, column);
    if (effect.columns() == 2) {
      result.sin_um = b[column + 1];
      variance = std::max(variance, covariance(column + 1, column + 1));
    }
    result.error_um =
        student_95(std::max(1.0, sources_.fit.degrees(column))) * std::sqrt(std::max(0.0, variance));
    return result;
  }

  void finish_unnamed(FoundEffect& found, int order) const {
    std::sort(found.terms.begin(), found.terms.end(), [](const FreeTerm& a, const FreeTerm& b) {
      return a.amplitude_um() > b.amplitude_um();
    });
    const FreeTerm& main = found.terms.front();
    found.description.clear();
    for (const FreeTerm& t : found.terms) {
      const Effect as_effect{find_family("unnamed"), FlankChoice::kBoth,
                             {double(t.profile_degree), double(t.face_degree), double(t.order),
                              t.opposite_flanks ? 1.0 : 0.0}};
      if (!found.description.empty()) found.description += "; and ";
      found.description += words_for(as_effect);
    }
    found.parameters.push_back({"order", double(order), double(order), double(order)});
    found.parameters.push_back({"amplitude_um", main.amplitude_um(),
                                std::max(0.0, main.amplitude_um() - main.error_um),
                                main.amplitude_um() + main.error_um});
    if (order > 0) {
      const double phase = deg_from_rad(std::atan2(main.sin_um, main.cos_um));
      const double spread = deg_from_rad(std::min(kPi, main.error_um / main.amplitude_um()));
      found.parameters.push_back({"phase_deg", phase, phase - spread, phase + spread});
    }
  }

  void add_figures(FoundEffect& found, const std::vector<int>& members) const {
    const std::size_t count = sources_.fit.effects().size();
    std::vector<bool> with(count, true);
    const auto full = sources_.fit.errors(with);
    for (const int e : members) {
      with[e] = false;
      found.explained_fraction += sources_.fit.explained_fraction(e);
    }
    found.explained_fraction = std::min(1.0, found.explained_fraction);
    found.held_out_gain_um =
        sources_.fit.errors(with).held_out_rms_um - full.held_out_rms_um;
  }

  const EffectSources& sources_;
  std::vector<FoundEffect> found_;
  std::vector<std::vector<int>> members_;
};

std::string course(int degree, const std::string& over) {
  switch (degree) {
    case 0: return "constant over the " + over;
    case 1: return "sloping over the " + over;
    case 2: return "crowned over the " + over;
    case 3: return "S-shaped over the " + over;
    default: return "in a wave of degree " + std::to_string(degree) + " over the " + over;
  }
}

struct Separation {
  const char* first;
  const char* second;
  const char* measurement;
};
/// loop.json's confounded pairs and what tells them apart (docs/loop.md).
constexpr Separation kSeparations[] = {
    {"scale", "pressure_angle_error", "tooth thickness (span or over pins) and a tip or bore diameter"},
    {"scale", "contour_offset", "tip, root or bore diameter, or profile traces with a common zero"},
    {"contour_offset", "tooth_thickness", "tip, root or bore diameter: an offset moves all walls"},
    {"scale", "tooth_thickness", "profile traces over the whole flank, and the tip diameter"},
    {"eccentricity", "pitch_wave", "the index of the other flank too, or the radial runout"},
    {"scale_xy", "skew", "an orientation mark, or two parts made at 0 and 45 degrees"},
    {"scale_xy", "lobing", "both flanks: the tangential part; a circular bore"},
    {"lobing", "pitch_wave", "both flanks, or the radial runout"},
    {"helix_error", "taper", "helix traces of both flanks"},
    {"taper", "elephant_foot", "helix traces or sections at several heights near the lower face"},
    {"elephant_foot", "crowning", "sections at several heights near the lower face"},
    {"tip_relief", "flank_wear", "the unworn (coast) flank"},
    {"tip_relief", "profile_crowning", "profile traces with more points near the tip"},
    {"tip_relief", "pressure_angle_error", "profile traces over the whole flank"},
    {"flank_wear", "profile_crowning", "profile traces over the whole flank, and the unworn flank"},
    {"axis_tilt", "layer_shift", "sections at more heights"},
    {"single_tooth", "pitch_wave", "index of all teeth"},
    {"axis_tilt", "eccentricity", "sections at more heights, or helix traces"},
    {"scale_xy", "pitch_wave", "the index of both flanks"},
};

/// Causes that act alike on the geometry, so that no measurement of the teeth tells them apart.
constexpr std::pair<const char*, const char*> kCauses[] = {
    {"scale", "scale: shrinkage of the part, heat and a scale error of the measuring device look alike; note "
              "the temperature, remeasure at 20 degrees, measure a gauge block in the same setup"},
    {"lobing", "lobing: chuck jaws, gates and press fits look alike; measure before and after unclamping, "
               "compare the phase with jaws and gates"},
    {"pitch_wave", "pitch_wave: an error of the measuring table looks like one of the gear; measure at two "
                   "orientations on the table"},
    {"helix_error", "helix_error: lead of the machine and twist of a print look alike; the process tells, "
                    "or a test of the spindle"},
    {"tip_relief", "tip_relief: wear looks like relief; measure the unworn (coast) flank, or a new part"},
    {"eccentricity", "eccentricity: of the toothing against the bore, or of the mounting; measure again in "
                     "another clamping"},
};

}  // namespace

std::vector<FoundEffect> describe_effects(const EffectSources& sources) {
  return Describer(sources).run();
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

std::string words_for(const Effect& effect) {
  if (effect.family->id != "unnamed") {
    std::string text = effect.family->id;
    for (std::size_t k = 0; k < effect.shape.size(); ++k) {
      std::string value = std::to_string(effect.shape[k]);
      while (value.back() == '0') value.pop_back();
      if (value.back() == '.') value.pop_back();
      text += " (" + effect.family->shape_names[k] + " " + value + ")";
    }
    return text;
  }
  const int order = static_cast<int>(effect.shape[2]);
  std::string text = order == 0   ? "the same on every tooth"
                     : order == 1 ? "once per turn"
                     : order == 2 ? "twice per turn"
                                  : std::to_string(order) + " times per turn";
  text += ", " + course(static_cast<int>(effect.shape[0]), "profile");
  text += ", " + course(static_cast<int>(effect.shape[1]), "face");
  text += effect.shape[3] != 0.0 ? ", opposite on the two flanks" : ", equal on both flanks";
  return text;
}

std::vector<std::string> measurements_that_separate(const std::vector<FoundEffect>& effects,
                                                    const std::vector<std::string>& not_observable) {
  std::vector<std::string> sentences;
  const auto say = [&](const std::string& sentence) {
    if (std::find(sentences.begin(), sentences.end(), sentence) == sentences.end())
      sentences.push_back(sentence);
  };
  for (const FoundEffect& found : effects)
    for (const std::string& other : found.confounded_with) {
      std::string by = "the same gear in more records: both flanks, profile, helix, index and sizes";
      for (const Separation& s : kSeparations)
        if ((found.id == s.first && other == s.second) || (found.id == s.second && other == s.first))
          by = s.measurement;
      say(found.id + " and " + other + " cannot be told apart here; measure " + by);
    }
  for (const FoundEffect& found : effects)
    for (const auto& [id, sentence] : kCauses)
      if (found.id == id) say(sentence);
  const bool one_part = std::any_of(effects.begin(), effects.end(), [](const FoundEffect& found) {
    return found.correctable && !found.repeatable;
  });
  if (one_part)
    say("one part cannot show what repeats; measure a second part of the process before correcting it");
  const auto hidden = [&](const char* id) {
    return std::find(not_observable.begin(), not_observable.end(), id) != not_observable.end();
  };
  if (hidden("eccentricity"))
    say("these data cannot show eccentricity; measure in the datum's frame (--aligned), the bore in the "
        "same scan, or the index of both flanks");
  if (hidden("contour_offset") && hidden("tooth_thickness"))
    say("these data cannot show the tooth thickness; measure span or over pins");
  return sentences;
}

}  // namespace trueflank::loop

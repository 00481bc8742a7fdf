// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/found_drive_effects.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "trueflank/base/units.h"
#include "trueflank/loop/distributions.h"

namespace trueflank::loop {
namespace {

/// Rows that carry less than this share of the largest load say little about efficiency.
constexpr double kLoaded = 0.2;

std::string plain(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", value);
  return text;
}

double rms_of(const DriveContext& context, const Eigen::VectorXd& left, bool held_out, bool points) {
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
        add_parameters(found_.back(), e);
        members_.push_back({e});
        continue;
      }
      const double order = effect.shape.size() == 5 ? effect.shape[3] : 0.0;
      const auto [place, is_new] = unnamed_at.emplace(order, found_.size());
      if (is_new) {
        found_.push_back(common(e));
        members_.push_back({});
      }
      members_[place->second].push_back(e);
      if (effect.shape.size() == 5) found_[place->second].drive_terms.push_back(term(e));
      else add_course(found_[place->second], e);
    }
    for (const auto& [order, place] : unnamed_at) finish_unnamed(found_[place]);
    for (std::size_t i = 0; i < found_.size(); ++i) add_figures(found_[i], members_[i]);
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
    if (family.form == DriveForm::kWave && family.named)
      found.description += ": " + words_for(s_.context.model, effect);
    if (family.id == "mesh_friction")
      found.description += " (" + s_.context.model.meshes[static_cast<std::size_t>(effect.shape[0]) - 1] + ")";
    const auto add = [&](const std::string& id) {
      if (id != found.id && std::find(found.confounded_with.begin(), found.confounded_with.end(), id) ==
                                found.confounded_with.end())
        found.confounded_with.push_back(id);
    };
    for (const int group : chosen.confounded)
      if (s_.candidates[group].family->named) add(s_.candidates[group].family->id);
    if (const auto others = s_.exchangeable.find(family.id); others != s_.exchangeable.end())
      for (const std::string& id : others->second) add(id);
    if (s_.context.table.impossible == Impossible::kEfficiencyAboveOne) {
      // Not tried, and not because the data exclude them.
      add("friction_coefficient");
      add("direction_dependent_friction");
      if (!s_.context.table.has(true) || !s_.context.table.has(false)) add("swapped_side");
    }
    std::sort(found.confounded_with.begin(), found.confounded_with.end());
    return found;
  }

  [[nodiscard]] double half(int column) const {
    return t_ * std::sqrt(std::max(0.0, covariance_(column, column)));
  }

  void add_parameters(FoundEffect& found, int e) const {
    const DriveEffect& effect = s_.all.effects()[e];
    const DriveFamily& family = *effect.family;
    const int column = s_.all.first_column(e);
    const auto& b = s_.all.coefficients();
    for (std::size_t k = 0; k < effect.shape.size(); ++k) {
      const int shape = s_.all.shape_column(e, static_cast<int>(k));
      const double h = shape < 0 ? 0.0 : half(shape);
      found.parameters.push_back(
          {family.shape_names[k], effect.shape[k], effect.shape[k] - h, effect.shape[k] + h});
    }
    if (family.form == DriveForm::kWave) {
      add_wave(found, b[column], b[column + 1], covariance_.block<2, 2>(column, column));
      return;
    }
    // The friction is told whole, not by its change.
    const double base =
        family.id == "friction_coefficient" ? s_.context.model.friction : family.base;
    for (int k = 0; k < effect.columns(); ++k)
      found.parameters.push_back({family.parameters[k], base + b[column + k],
                                  base + b[column + k] - half(column + k),
                                  base + b[column + k] + half(column + k)});
    if (family.id.starts_with("temperature_"))
      found.parameters.push_back({"reference_c", s_.context.table.mean_temperature_c,
                                  s_.context.table.mean_temperature_c,
                                  s_.context.table.mean_temperature_c});
    if (family.id == "load_dependent_friction")
      found.parameters.push_back({"reference_nm", s_.context.table.most_load_nm,
                                  s_.context.table.most_load_nm, s_.context.table.most_load_nm});
  }

  void add_wave(FoundEffect& found, double c, double s, const Eigen::Matrix2d& covariance) const {
    const double amplitude = std::hypot(c, s);
    const Eigen::Vector2d along(c / amplitude, s / amplitude), across(-s / amplitude, c / amplitude);
    const double h = t_ * std::sqrt(std::max(0.0, along.dot(covariance * along)));
    const double turn =
        std::min(kPi, t_ * std::sqrt(std::max(0.0, across.dot(covariance * across))) / amplitude);
    const double phase = deg_from_rad(std::atan2(s, c));
    found.parameters.push_back(
        {"amplitude_nm", amplitude, std::max(0.0, amplitude - h), amplitude + h});
    found.parameters.push_back(
        {"phase_deg", phase, phase - deg_from_rad(turn), phase + deg_from_rad(turn)});
  }

  DriveTerm term(int e) const {
    const std::vector<double>& shape = s_.all.effects()[e].shape;
    const int column = s_.all.first_column(e);
    DriveTerm t;
    t.text = words_for(s_.context.model, s_.all.effects()[e]);
    t.load_degree = static_cast<int>(shape[0]);
    t.speed_degree = static_cast<int>(shape[1]);
    t.temperature_degree = static_cast<int>(shape[2]);
    t.order = shape[3];
    t.opposite_directions = shape[4] != 0.0;
    t.cos_nm = s_.all.coefficients()[column];
    t.error_nm = half(column);
    if (shape[3] != 0.0) {
      t.sin_nm = s_.all.coefficients()[column + 1];
      t.error_nm = std::max(t.error_nm, half(column + 1));
    }
    return t;
  }

  /// A course over one quantity is as many terms as it has degrees.
  void add_course(FoundEffect& found, int e) const {
    const DriveEffect& effect = s_.all.effects()[e];
    const int column = s_.all.first_column(e);
    for (int k = 0; k < effect.columns(); ++k) {
      DriveTerm t;
      t.text = words_for(s_.context.model, effect, &s_.context);
      (effect.shape[0] == 0.0   ? t.load_degree
       : effect.shape[0] == 1.0 ? t.speed_degree
                                : t.temperature_degree) = k;
      t.cos_nm = s_.all.coefficients()[column + k];
      t.error_nm = half(column + k);
      found.drive_terms.push_back(t);
    }
  }

  void finish_unnamed(FoundEffect& found) const {
    std::sort(found.drive_terms.begin(), found.drive_terms.end(),
              [](const DriveTerm& a, const DriveTerm& b) { return a.amplitude_nm() > b.amplitude_nm(); });
    found.description = "a loss at the input ";
    bool first = true;
    for (const DriveTerm& t : found.drive_terms) {
      if (found.description.find(t.text) != std::string::npos) continue;
      found.description += (first ? "" : "; and ") + t.text;
      first = false;
    }
    const DriveTerm& main = found.drive_terms.front();
    found.parameters.push_back({"order", main.order, main.order, main.order});
    found.parameters.push_back({"amplitude_nm", main.amplitude_nm(),
                                std::max(0.0, main.amplitude_nm() - main.error_nm),
                                main.amplitude_nm() + main.error_nm});
  }

  void add_figures(FoundEffect& found, const std::vector<int>& members) const {
    std::vector<bool> left_out(s_.all.effects().size(), false);
    for (const int e : members) left_out[e] = true;
    const auto square = [&](const Eigen::VectorXd& left) {
      double sum = 0.0;
      for (std::size_t i = 0; i < s_.context.table.points.size(); ++i) {
        const double x = left[static_cast<Eigen::Index>(i)] / s_.context.table.points[i].sigma_nm;
        sum += x * x;
      }
      return sum;
    };
    const Eigen::VectorXd with = s_.value - s_.all.explained_nm();
    const Eigen::VectorXd lost = s_.value - s_.all.columns() * s_.all.without(left_out);
    found.explained_fraction =
        std::clamp((square(lost) - square(with)) / std::max(square(s_.value), 1e-300), 0.0, 1.0);
    const Eigen::VectorXd held = s_.value - s_.training.explained_nm();
    const Eigen::VectorXd held_lost = s_.value - s_.training.columns() * s_.training.without(left_out);
    found.held_out_gain_um = rms_of(s_.context, held_lost, true, false) -
                             rms_of(s_.context, held, true, false);
  }

  const DriveSources& s_;
  const Eigen::MatrixXd covariance_;
  const double t_;
  std::vector<FoundEffect> found_;
  std::vector<std::vector<int>> members_;
};

std::string course(int degree, const char* over) {
  switch (degree) {
    case 0: return "";
    case 1: return std::string(", sloping over the ") + over;
    case 2: return std::string(", curved over the ") + over;
    case 3: return std::string(", S-shaped over the ") + over;
    default: return std::string(", W-shaped over the ") + over;
  }
}

std::string member_of(const DriveModel& model, double order) {
  for (const MemberOrder& member : model.orders)
    if (std::abs(member.order - order) < 1e-6 * std::max(1.0, order)) return member.member;
  return {};
}

struct Separation {
  const char* first;
  const char* second;
  const char* run;
};
/// Confounded pairs and the run that tells them apart (docs/drive-loop.md).
constexpr Separation kSeparations[] = {
    {"torque_scale", "friction_coefficient",
     "both directions, or each torque against a lever and weights, or without the gearbox"},
    {"torque_scale", "direction_dependent_friction",
     "each torque against a lever and weights, or a run without the gearbox, or with the two sides' "
     "roles swapped"},
    {"torque_scale", "swapped_side", "the other direction too"},
    {"torque_offset", "drag_torque", "both directions, and a zero reading at rest"},
    {"torque_offset", "direction_dependent_drag", "both senses of rotation, and a zero reading at rest"},
    {"torque_offset", "torque_scale", "a sweep of the load, zero included"},
    {"drag_torque", "friction_coefficient", "a sweep of the load, no load included"},
    {"drag_torque", "viscous_drag", "a sweep of the speed"},
    {"drag_torque", "load_dependent_friction", "more loads, no load included"},
    {"viscous_drag", "bearing_friction", "speeds over two decades"},
    {"stribeck_friction", "viscous_drag", "speeds over two decades, creeping included"},
    {"stribeck_friction", "mixed_friction", "a sweep of the load at creeping speed"},
    {"viscous_drag", "temperature_viscosity", "the same speeds cold and warm, temperature_c logged"},
    {"drag_torque", "temperature_drag", "the same set points cold and warm, temperature_c logged"},
    {"temperature_drag", "temperature_viscosity", "a sweep of the speed cold and one warm"},
    {"mesh_friction", "friction_coefficient",
     "a second ratio, or one layer locked: the two shafts alone cannot tell the meshes apart"},
    {"mesh_friction", "direction_dependent_friction",
     "a second ratio, or one layer locked: the two shafts alone cannot tell the meshes apart"},
    {"bearing_load_friction", "friction_coefficient",
     "teeth and bearings apart: another bearing, or the planets' teeth out of mesh"},
    {"load_dependent_friction", "friction_coefficient", "a sweep of the load over a decade"},
};

}  // namespace

std::vector<FoundEffect> describe_drive_effects(const DriveSources& sources) {
  return Describer(sources).run();
}

std::string words_for(const DriveModel& model, const DriveEffect& effect, const DriveContext* context) {
  const auto wave = [&](double order) {
    const std::string member = member_of(model, order);
    return "in a wave of order " + plain(order) + " per input turn" +
           (member.empty() ? "" : " (" + member + ")");
  };
  if (effect.family->form == DriveForm::kWave)
    return wave(effect.shape[0]) + (effect.shape[1] != 0.0 ? ", in proportion to the load" : "");
  if (effect.family->named) return effect.family->id;
  const auto& s = effect.shape;
  if (s.size() != 5) {
    const std::string over = s[0] == 0.0 ? "load" : s[0] == 1.0 ? "speed" : "temperature";
    if (effect.family->shape_names[1] == "levels") return "with a course over the " + over;
    return (s.size() == 3 ? "with a hump over the " : "with a step over the ") + over +
           (context == nullptr ? std::string()
                               : " at " + plain(context->quantity_at(s[0], s[1])) +
                                     (s[0] == 0.0   ? " N m at the input"
                                      : s[0] == 1.0 ? " rpm"
                                                    : " C"));
  }
  std::string text;
  if (s[3] != 0.0) text = wave(s[3]);
  else if (s[0] + s[1] + s[2] == 0.0) text = "constant";
  else
    text = (course(static_cast<int>(s[0]), "load") + course(static_cast<int>(s[1]), "speed") +
            course(static_cast<int>(s[2]), "temperature")).substr(2);
  return text + (s[4] != 0.0 ? ", opposite in the two directions" : "");
}

std::vector<std::string> runs_that_separate(const BenchTable& table,
                                            const std::vector<FoundEffect>& effects) {
  std::vector<std::string> runs;
  const auto say = [&](const std::string& sentence) {
    if (std::find(runs.begin(), runs.end(), sentence) == runs.end()) runs.push_back(sentence);
  };
  if (table.impossible == Impossible::kEfficiencyAboveOne)
    say("before any loss is read from these data: a run without the gearbox (or with the roles of the two "
        "sides swapped), and each torque against a lever and weights, to separate torque_scale and "
        "torque_offset from friction");
  for (const FoundEffect& found : effects)
    for (const std::string& other : found.confounded_with) {
      std::string by = "more loads, speeds, both directions and temperatures";
      for (const Separation& s : kSeparations)
        if ((found.id == s.first && other == s.second) || (found.id == s.second && other == s.first))
          by = s.run;
      say(found.id + " and " + other + " cannot be told apart here; run " + by);
    }
  if (!table.has(true) || !table.has(false))
    say("only one direction was run: the other separates torque scale and offset from friction and drag");
  if (!(table.most_speed_rpm > 1.5 * table.least_speed_rpm))
    say("the speed hardly changes: a speed sweep separates drag, viscous, bearing and Stribeck losses");
  if (!table.has_temperature)
    say("log temperature_c: without it the lubricant's thinning is not seen");
  if (!table.has_angle)
    say("log input_angle_deg, counting on over many turns: without it no eccentric member is seen");
  return runs;
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

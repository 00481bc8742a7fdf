// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/correction.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>

#include "trueflank/base/units.h"
#include "trueflank/geometry/involute.h"
#include "trueflank/loop/gear/declared_effect.h"
#include "trueflank/loop/gear/mesh_slicing.h"

namespace trueflank::loop {
namespace {

using Json = nlohmann::json;
using Point3 = std::array<double, 3>;

/// Of a loop.json, and of terms of one effect: what is corrected is computed for every corner of a
/// mesh.
constexpr std::size_t kMostEffects = 500;
/// Of a displacement: bounds are then found in half a minute.
constexpr double kMostOperations = 100'000.0;

Error broken(const std::string& what, const std::string& key = {}) {
  return {.code = ErrorCode::kWrongType, .message = what, .key = key};
}

/// A text; empty where there is none.
std::string text_of(const Json& json, const std::string& key) {
  const auto found = json.find(key);
  return found != json.end() && found->is_string() ? found->get<std::string>() : "";
}
/// A text of the file as one line: what it tells a terminal to do is not done.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < ' '; }, ' ');
  return text;
}
bool flag_of(const Json& json, const std::string& key, bool otherwise) {
  const auto found = json.find(key);
  return found != json.end() && found->is_boolean() ? found->get<bool>() : otherwise;
}

Result<Json> parsed(std::string_view text) {
  Json json = Json::parse(text, nullptr, false);
  if (json.is_discarded())
    return fail({.code = ErrorCode::kSyntax, .message = "this is no JSON document"});
  if (!json.is_object() || text_of(json, "format") != "trueflank-loop")
    return fail(broken("this is no loop.json", "format"));
  if (const auto version = json.find("version"); version != json.end() && *version != 1)
    return fail({.code = ErrorCode::kUnsupported,
                 .message = "a loop.json of a version that this program does not know",
                 .key = "version",
                 .remedy = "version 1"});
  return json;
}

/// Value of a parameter; NaN where it is not there.
double value_of(const Json& effect, const std::string& name) {
  const auto parameters = effect.find("parameters");
  if (parameters == effect.end() || !parameters->is_object()) return kNaN;
  const auto parameter = parameters->find(name);
  if (parameter == parameters->end() || !parameter->is_object()) return kNaN;
  const auto value = parameter->find("value");
  return value != parameter->end() && value->is_number() ? value->get<double>() : kNaN;
}

/// Both where nothing is said; nothing where it is none of the words.
std::optional<FlankChoice> flank_of(const Json& effect) {
  const auto found = effect.find("flank");
  if (found == effect.end() || *found == "both") return FlankChoice::kBoth;
  if (*found == "left") return FlankChoice::kLeft;
  if (*found == "right") return FlankChoice::kRight;
  return std::nullopt;
}

/// A wave around the gear whose order is no whole number does not close: the first tooth has a step.
bool closes_around(const EffectFamily& family, const std::vector<double>& shape) {
  return !family.order || shape.empty() || family.order(shape) == std::floor(family.order(shape));
}

/// Shape and coefficients from the parameters people read.
bool read_parameters(const Json& json, const EffectFamily& family, std::vector<double>& shape,
                     std::vector<double>& coefficients) {
  for (std::size_t k = 0; k < family.shape_names.size(); ++k) {
    shape.push_back(value_of(json, family.shape_names[k]));
    if (std::isnan(shape.back()) && k < family.shape_where_absent.size())
      shape.back() = family.shape_where_absent[k];
  }
  if (family.form == ParameterForm::kWave) {
    const double amplitude = value_of(json, family.parameters[0]);
    const double angle = rad_from_deg(value_of(json, family.parameters[1])) * family.phase_divisor;
    coefficients = {amplitude * std::cos(angle), amplitude * std::sin(angle)};
  } else {
    for (const std::string& name : family.parameters) coefficients.push_back(value_of(json, name));
  }
  const auto bad = [](double value) { return !std::isfinite(value); };
  return std::none_of(shape.begin(), shape.end(), bad) &&
         std::none_of(coefficients.begin(), coefficients.end(), bad);
}

/// The free form, or the form a term is of; nullptr: of none that is known.
const EffectFamily* family_of_term(const Json& term, const EffectFamily& free_form) {
  if (!term.is_object() || !term.contains("form")) return &free_form;
  return term["form"].is_string() ? find_form(term["form"].get<std::string>()) : nullptr;
}

/// A term of an effect without a name.
bool read_term(const Json& term, const EffectFamily& family, std::vector<double>& shape,
               std::vector<double>& coefficients) {
  if (!term.is_object()) return false;
  const auto number = [&](const std::string& key) {
    const auto found = term.find(key);
    return found != term.end() && found->is_number() ? found->get<double>() : kNaN;
  };
  for (const TermKey& key : family.term_keys)
    shape.push_back(key.kind == TermKey::Kind::kWord
                        ? (text_of(term, key.name) == key.words[1] ? 1.0 : 0.0)
                        : number(key.name));
  constexpr double kMostDegree = 1000.0;  // degrees and orders: far beyond what any data can show
  const auto bad = [](double value) { return !std::isfinite(value); };
  if (shape.size() != family.shape_names.size()) return false;
  for (std::size_t k = 0; k < shape.size(); ++k) {
    const bool whole = family.term_keys[k].kind != TermKey::Kind::kNumber;
    if (whole ? !(shape[k] >= 0.0 && shape[k] <= kMostDegree) || shape[k] != std::floor(shape[k])
              : !(shape[k] > 0.0))
      return false;
  }
  for (int k = 0; k < family.columns(shape); ++k) coefficients.push_back(number(family.parameters[k]));
  return std::none_of(coefficients.begin(), coefficients.end(), bad);
}

/// A user's effect carries its formulas in loop.json, so that the correction needs no other file.
Result<EffectFamily> declared_family_of(const Json& item) {
  DeclaredEffect declared{.id = item["id"], .correctable = flag_of(item, "correctable", true)};
  declared.correction = text_of(item, "correction");
  const Json& form = item["form"];
  if (!form.is_object()) return fail(broken("an effect without its formulas", "effects." + declared.id));
  for (const auto& [name, formula] : form.items()) {
    if (!formula.is_string())
      return fail(broken("an effect without its formulas", "effects." + declared.id + ".form"));
    declared.columns.emplace_back(name, formula.get<std::string>());
  }
  auto family = declared_family(declared);
  if (!family) return fail(family.error().front());
  return std::move(*family);
}

Error too_many(const std::string& what, const std::string& key, std::size_t count) {
  return {.code = ErrorCode::kOutOfRange,
          .message = "more " + what + " than any loop finds",
          .key = key,
          .value = std::to_string(count),
          .remedy = std::to_string(kMostEffects) + " at most"};
}

Error wrong_flank(const std::string& id) {
  return broken("flank is neither left nor right nor both", "effects." + id);
}
Error moves_both(const std::string& id) {
  return broken("what moves the body moves both flanks", "effects." + id);
}
Error broken_wave(const std::string& id) {
  return broken("the order of a wave around the gear is a whole number", "effects." + id);
}

/// An effect without a name: its terms, each an effect of its own.
struct CorrectableTerms {
  std::vector<Correction::Part> parts;
  std::vector<std::string> left;
};
Result<CorrectableTerms> correctable_terms(const std::string& id, const Json& item, const EffectFamily& family) {
  CorrectableTerms found;
  const auto terms = item.find("terms");
  if (terms == item.end() || !terms->is_array() || terms->empty()) {
    const std::string description = text_of(item, "description");
    found.left.push_back(id + ": " + (description.empty() ? "no terms" : description) + "; inspect or reject the part");
    return found;
  }
  if (terms->size() > kMostEffects) return fail(too_many("terms", "effects.terms", terms->size()));
  const auto flank = flank_of(item);
  if (!flank) return fail(wrong_flank(id));
  for (const Json& term : *terms) {
    Correction::Part part;
    part.effect.family = family_of_term(term, family);
    if (part.effect.family == nullptr || !read_term(term, *part.effect.family, part.effect.shape, part.coefficients))
      return fail(broken("a term without its numbers", "effects.terms"));
    if (!closes_around(*part.effect.family, part.effect.shape)) return fail(broken_wave("terms"));
    part.effect.flank = *flank;
    if (part.effect.family->displacement_mm && *flank != FlankChoice::kBoth)
      return fail(moves_both(id));
    if (part.effect.family->correctable != Correctable::kGeometry)
      found.left.push_back(id + ": " + part.effect.family->description);
    else
      found.parts.push_back(std::move(part));
  }
  return found;
}

/// The family an effect is of; one with formulas of a user's own is kept in `declared`.
Result<const EffectFamily*> family_of_effect(const std::string& id, const Json& item,
                                             std::vector<std::shared_ptr<const EffectFamily>>& declared) {
  if (const EffectFamily* known = find_family(id)) return known;
  if (!item.contains("form"))
    return fail({.code = ErrorCode::kUnknownKey,
                 .message = "an effect nobody knows",
                 .key = "effects.id",
                 .value = id});
  auto own = declared_family_of(item);
  if (!own) return fail(own.error());
  declared.push_back(std::make_shared<const EffectFamily>(std::move(*own)));
  return declared.back().get();
}

/// An effect with a name, from the flanks, shape and amounts that loop.json says.
Result<Correction::Part> named_part(const std::string& id, const Json& item, const EffectFamily& family) {
  Correction::Part part;
  part.effect.family = &family;
  const auto flank = flank_of(item);
  if (!flank) return fail(wrong_flank(id));
  part.effect.flank = *flank;
  if (!read_parameters(item, family, part.effect.shape, part.coefficients))
    return fail(broken("an effect without its parameters", "effects." + id));
  if (!closes_around(family, part.effect.shape)) return fail(broken_wave(id));
  if (family.displacement_mm && part.effect.flank != FlankChoice::kBoth)
    return fail(moves_both(id));
  return part;
}

}  // namespace

Result<std::string> Correction::gear_of(std::string_view loop_json) {
  const auto json = parsed(loop_json);
  if (!json) return fail(json.error());
  const auto gear = json->find("gear");
  if (gear == json->end() || !gear->is_string()) return fail(broken("loop.json names no gear", "gear"));
  return gear->get<std::string>();
}

Result<Correction> Correction::make(std::string_view loop_json, const FlankGeometry& geometry) {
  const auto json = parsed(loop_json);
  if (!json) return fail(json.error());
  const auto effects = json->find("effects");
  if (effects == json->end() || !effects->is_array())
    return fail(broken("loop.json has no list of effects", "effects"));
  if (effects->size() > kMostEffects) return fail(too_many("effects", "effects", effects->size()));
  Correction result(geometry);
  for (const Json& item : *effects) {
    if (!item.is_object() || !item.contains("id") || !item["id"].is_string())
      return fail(broken("an effect without id", "effects"));
    const std::string id = item["id"];
    if (!flag_of(item, "repeatable", true)) {
      const std::string part = text_of(item, "part");
      result.left_.push_back(id + ": one-off, on part " + (part.empty() ? "?" : part) +
                             " only; what does not repeat is not corrected");
      continue;
    }
    if (const std::string why = text_of(item, "not_corrected"); !why.empty()) {
      result.left_.push_back(id + ": " + why);
      continue;
    }
    const auto found = family_of_effect(id, item, result.declared_);
    if (!found) return fail(found.error());
    const EffectFamily& family = **found;
    if (!family.named && !flag_of(item, "correctable", true)) {
      const std::string what = text_of(item, "description");
      result.left_.push_back(id + ": " + (what.empty() ? "" : what + ": ") +
                             "described only; its cause is not known");
    } else if (!family.named) {
      auto terms = correctable_terms(id, item, family);
      if (!terms) return fail(std::move(terms.error()));
      if (!terms->parts.empty()) result.corrected_.push_back(id);
      std::move(terms->parts.begin(), terms->parts.end(), std::back_inserter(result.parts_));
      std::move(terms->left.begin(), terms->left.end(), std::back_inserter(result.left_));
    } else if (family.correctable != Correctable::kGeometry) {
      result.left_.push_back(id + ": " + family.correction);
    } else {
      auto part = named_part(id, item, family);
      if (!part) return fail(std::move(part.error()));
      result.parts_.push_back(std::move(*part));
      result.corrected_.push_back(id);
    }
  }
  for (std::string& text : result.left_) text = one_line(std::move(text));
  for (std::string& text : result.corrected_) text = one_line(std::move(text));
  if (result.operations() > kMostOperations)
    return fail({.code = ErrorCode::kOutOfRange,
                 .message = "the effects take more computing at each place than any mesh has time for",
                 .key = "effects",
                 .value = std::to_string(std::lround(result.operations())) + " operations",
                 .remedy = std::to_string(std::lround(kMostOperations)) +
                           " at most: fewer effects or shorter formulas"});
  return result;
}

/// Deviation of a flank from all effects that are no displacement of the body.
double Correction::flank_deviation_mm(int tooth, int side, double roll_mm, double z_mm) const {
  const int z = geometry_.teeth();
  const Place place = geometry_.on_flank((tooth - 1 + z) % z + 1, side, roll_mm, z_mm);
  double sum = 0.0, values[8];
  for (const Part& part : parts_) {
    if (part.effect.family->displacement_mm) continue;
    part.effect.evaluate(geometry_, place, values);
    for (std::size_t k = 0; k < part.coefficients.size(); ++k) sum += values[k] * part.coefficients[k];
  }
  return mm_from_um(sum);
}

/// The turn about the axis that takes the flanks' deviations away at a point: on a flank that flank's,
/// over the tip from one flank to the other, in the gap from this tooth to the next.
double Correction::turn_rad(const Point3& p) const {
  const double radius = std::hypot(p[0], p[1]);
  const double pitch = kTwoPi / geometry_.teeth();
  const auto [number, offset] = place_in_tooth(p);
  const double low = std::min(geometry_.root_form_roll_mm(), geometry_.tip_form_roll_mm());
  const double high = std::max(geometry_.root_form_roll_mm(), geometry_.tip_form_roll_mm());
  const double roll = std::clamp(geometry_.roll_at_radius_mm(radius), low, high);
  const auto turn_of = [&](int of_tooth, int side) {
    const double transverse =
        flank_deviation_mm(of_tooth, side, roll, p[2]) / std::cos(geometry_.base_helix_rad());
    return -side * transverse / geometry_.base_radius_mm();
  };
  const double half = half_angle_rad(std::hypot(geometry_.base_radius_mm(), roll));
  const double w = half > 0.0 ? offset / half : (offset >= 0.0 ? 1.0 : -1.0);
  const double ahead = turn_of(number, 1), behind = turn_of(number, -1);
  if (std::abs(w) <= 1.0) return 0.5 * (1.0 + w) * ahead + 0.5 * (1.0 - w) * behind;
  const int side = w > 0.0 ? 1 : -1;
  const double q = std::clamp((std::abs(offset) - half) / (0.5 * pitch - half), 0.0, 1.0);
  const double own = side > 0 ? ahead : behind;
  return own + 0.5 * q * (turn_of(number + side, -side) - own);
}

Point3 Correction::displacement_mm(const Point3& p) const {
  // Where will the process take the point? The field there, turned round.
  constexpr int kMostSteps = 60;
  constexpr double kSame_mm = 1e-10;
  Point3 sum{0.0, 0.0, 0.0};
  bool found = false;
  for (int step = 0; step < kMostSteps && !found; ++step) {
    const Point3 at{p[0] + sum[0], p[1] + sum[1], p[2] + sum[2]}, before = sum;
    sum = {0.0, 0.0, 0.0};
    for (const Part& part : parts_) {
      if (!part.effect.family->displacement_mm) continue;
      const auto u = part.effect.family->displacement_mm(geometry_, at, part.effect.shape,
                                                         part.coefficients.data());
      // The faces stay where they are: what moves along the axis is turned instead, which is the
      // same on a helical flank.
      const double turned = geometry_.twist_rad(at[2] - u[2]) - geometry_.twist_rad(at[2]);
      sum[0] -= u[0] - turned * at[1];
      sum[1] -= u[1] + turned * at[0];
    }
    found = std::hypot(sum[0] - before[0], sum[1] - before[1], sum[2] - before[2]) <= kSame_mm;
  }
  if (!found) return {kNaN, kNaN, kNaN};
  const double turn = turn_rad(p);
  double offset = 0.0;
  for (const Part& part : parts_)
    if (part.effect.family->moves_circles)
      offset += mm_from_um(part.effect.family->walls_outside_um(geometry_, part.coefficients.data()));
  if (offset == 0.0) {
    const double c = std::cos(turn) - 1.0, s = std::sin(turn);
    return {sum[0] + c * p[0] - s * p[1], sum[1] + s * p[0] + c * p[1], sum[2]};
  }
  const CircleMove move = circle_move(p, offset);
  const double angle = std::atan2(p[1], p[0]) + turn + move.turn_rad;
  return {sum[0] + move.radius_mm * std::cos(angle) - p[0],
          sum[1] + move.radius_mm * std::sin(angle) - p[1], sum[2]};
}

/// An offset of all walls moves the root circle and the tip circle, too. The flanks, which already
/// have been moved, end on the new tip circle: their upper halves slide along the involute they are
/// on, and what lies between them goes along in proportion.
Correction::CircleMove Correction::circle_move(const Point3& p, double offset_mm) const {
  const double radius = std::hypot(p[0], p[1]), sense = geometry_.sense();
  const double root = geometry_.root_radius_mm(), tip = geometry_.tip_radius_mm();
  const double root_form = std::hypot(geometry_.base_radius_mm(), geometry_.root_form_roll_mm());
  const double middle = 0.5 * (root_form + tip);
  const double up = (radius - middle) / (tip - middle);
  if (!(up > 0.0)) {
    const double down = root_form == root ? 0.0 : (radius - root_form) / (root - root_form);
    return {radius - sense * offset_mm * std::clamp(down, 0.0, 1.0), 0.0};
  }
  const double to = radius - sense * offset_mm * std::min(up, 1.0);
  const PlaceInTooth place = place_in_tooth(p);
  const double half = half_angle_rad(radius);
  const double share = half > 0.0 ? std::clamp(place.offset_rad / half, -1.0, 1.0) : 0.0;
  return {to, share * (half_angle_rad(to) - half)};
}

/// From the middle of a tooth to its flank.
double Correction::half_angle_rad(double radius_mm) const {
  const double xi = geometry_.roll_at_radius_mm(radius_mm) / geometry_.base_radius_mm();
  return geometry_.base_half_angle() - geometry_.sense() * (xi - std::atan(xi));
}

Correction::PlaceInTooth Correction::place_in_tooth(const Point3& p) const {
  const double pitch = kTwoPi / geometry_.teeth();
  const double from_first = std::atan2(p[1], p[0]) - geometry_.twist_rad(p[2]);
  const int tooth = static_cast<int>(std::round(from_first / pitch)) + 1, z = geometry_.teeth();
  return {((tooth - 1) % z + z) % z + 1, from_first - pitch * (tooth - 1)};
}

bool Correction::bends_over_the_face() const {
  return std::any_of(parts_.begin(), parts_.end(), [](const Part& part) {
    const EffectFamily& family = *part.effect.family;
    return family.bends_over_the_face && family.bends_over_the_face(part.effect.shape);
  });
}

Correction Correction::scale_alone() const {
  Correction some = *this;
  std::erase_if(some.parts_, [](const Part& p) { return !p.effect.family->moves_whole_part; });
  return some;
}

Correction Correction::without_scale() const {
  Correction some = *this;
  std::erase_if(some.parts_, [](const Part& p) { return p.effect.family->moves_whole_part; });
  return some;
}

std::string Correction::name_of(const EffectFamily& family) {
  return family.named || family.form_word.empty() ? family.id : "unnamed (" + family.form_word + ")";
}

Correction Correction::of(const std::string& name) const {
  Correction some = *this;
  std::erase_if(some.parts_, [&](const Part& p) { return name_of(*p.effect.family) != name; });
  return some;
}

Correction Correction::of_body() const {
  Correction some = *this;
  std::erase_if(some.parts_, [](const Part& p) { return !p.effect.family->displacement_mm; });
  return some;
}

std::vector<std::string> Correction::effects() const {
  std::vector<std::string> names;
  for (const Part& part : parts_) {
    const std::string name = name_of(*part.effect.family);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

bool Correction::moves_whole_part() const {
  return std::any_of(parts_.begin(), parts_.end(),
                     [](const Part& p) { return p.effect.family->moves_whole_part; });
}

double Correction::operations() const {
  constexpr double kOfPlaces = 500.0, kFlanks = 3.0;
  double sum = 0.0;
  for (const Part& part : parts_) sum += part.effect.family->operations;
  return kOfPlaces + kFlanks * sum;
}

double Correction::magnification() const { return 1.0 + displacement_mm({1.0, 0.0, 0.0})[0]; }

double Correction::walls_outside_mm() const {
  double outside = 0.0;
  for (const Part& part : parts_)
    if (part.effect.family->walls_outside_um)
      outside += mm_from_um(part.effect.family->walls_outside_um(geometry_, part.coefficients.data()));
  return outside;
}

TriangleMesh Correction::apply(const TriangleMesh& mesh, double z_lower_mm) const {
  const double b = geometry_.face_width_mm();
  TriangleMesh result = mesh;
  if (bends_over_the_face()) {
    std::vector<double> heights;
    constexpr int kLayers = 32;
    for (int i = 1; i < kLayers; ++i) heights.push_back(z_lower_mm + b * i / kLayers);
    // First layers bulge within tenths of a millimetre.
    for (const double z : {0.05, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.7, 0.9})
      if (z < b) heights.push_back(z_lower_mm + z);
    std::sort(heights.begin(), heights.end());
    result = sliced(mesh, heights);
  }
  // Of the body only the ring of the teeth moves; a scale is of the whole part.
  const bool whole = moves_whole_part();
  const double root = geometry_.root_radius_mm(), margin = 1e-3;
  for (auto& vertex : result.vertices) {
    const double radius = std::hypot(vertex[0], vertex[1]);
    const bool toothed = geometry_.sense() > 0.0 ? radius > root - margin : radius < root + margin;
    const double z = vertex[2] - z_lower_mm;
    if ((!toothed && !whole) || z < -1e-9 || z > b + 1e-9 || radius == 0.0) continue;
    const Point3 u = displacement_mm({vertex[0], vertex[1], z});
    for (int k = 0; k < 3; ++k) vertex[k] += u[k];
  }
  return result;
}

}  // namespace trueflank::loop

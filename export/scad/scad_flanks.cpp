// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/export/scad/scad_flanks.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "trueflank/base/units.h"
#include "trueflank/export/scad/scad_text.h"

namespace trueflank::io {
namespace {

/// Tables are interpolated by straight lines: so near, on the base circle.
constexpr double kTable_mm = 1e-5;
/// More than this off a sum of a term along the profile and one along the face is no such sum.
constexpr double kSum_mm = 2e-6;
constexpr int kMostNodes = 128;
/// Places looked at to tell a sum: of the profile, of the face.
constexpr int kLooks = 9;

using Function = std::function<double(double)>;

/// Places between breaks, close enough for straight lines between them.
std::vector<double> nodes_of(const Function& f, const std::vector<double>& breaks, double within) {
  std::vector<double> nodes{breaks.front()};
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) {
    const double from = breaks[i], to = breaks[i + 1];
    int count = 1;
    const auto off = [&] {
      double worst = 0.0;
      for (int k = 0; k < count; ++k) {
        const double a = std::lerp(from, to, static_cast<double>(k) / count);
        const double b = std::lerp(from, to, (k + 1.0) / count);
        for (const double share : {0.25, 0.5, 0.75})
          worst = std::max(worst, std::abs(f(std::lerp(a, b, share)) - std::lerp(f(a), f(b), share)));
      }
      return worst;
    };
    while (count < kMostNodes && off() > within) count *= 2;
    for (int k = 1; k <= count; ++k) nodes.push_back(std::lerp(from, to, static_cast<double>(k) / count));
  }
  return nodes;
}

/// `[[place, degrees], ...]`; one pair where it is nothing.
std::string table(const Function& turn_rad, const std::vector<double>& breaks, double within_rad,
                  const Function& key) {
  std::vector<double> nodes = nodes_of(turn_rad, breaks, within_rad);
  std::vector<std::pair<double, double>> rows;
  for (const double at : nodes) rows.emplace_back(key(at), deg_from_rad(turn_rad(at)));
  std::sort(rows.begin(), rows.end());
  if (std::all_of(rows.begin(), rows.end(), [](const auto& r) { return r.second == 0.0; })) rows.resize(1);
  std::string text;
  for (const auto& [place, turn] : rows) {
    text += (text.empty() ? "[[" : ", [") + number(std::round(place * 1e9) * 1e-9) + ", " +
            number(std::round(turn * 1e9) * 1e-9) + "]";
  }
  return text + "]";
}

/// What a toothing's deviation turns its flanks by, the chamfer apart: at the place a point comes from.
class Turns {
 public:
  explicit Turns(const ToothedOutline& teeth) : toothing_(teeth.toothing()) {
    const auto& pieces = teeth.profile->pieces();
    while (pieces[flank_].kind != PieceKind::kInvolute) ++flank_;
    mid_roll_ = 0.5 * (curve().begin + curve().end);
    mid_z_ = 0.5 * toothing_.twist.face_width_mm;
  }
  [[nodiscard]] std::size_t flank() const { return flank_; }
  [[nodiscard]] double base_radius() const { return base_radius_mm(toothing_.profile->gear()); }
  [[nodiscard]] double along_profile(int side, double roll) const { return at(side, roll, mid_z_); }
  [[nodiscard]] double along_face(int side, double z_mm) const {
    return at(side, mid_roll_, z_mm) - at(side, mid_roll_, mid_z_);
  }
  /// Roll angles of the field: its breaks on the flank, and as far beyond either end as points come from.
  [[nodiscard]] std::vector<double> field_breaks() const {
    double reach = 0.0;
    for (const int side : {1, -1})
      for (int i = 0; i < kLooks; ++i)
        for (int j = 0; j < kLooks; ++j) reach = std::max(reach, std::abs(at(side, roll_at(i), z_at(j))));
    const double outwards = std::copysign(2.0 * reach, curve().end - curve().begin);
    return with_breaks(curve().begin - outwards, curve().end + outwards, 0.0);
  }
  /// Roll angles between which the section's flank is smooth: on the circles its points are taken to.
  [[nodiscard]] std::vector<double> flank_breaks() const {
    return with_breaks(curve().begin, curve().end,
                       toothing_.profile->gear().kind == GearKind::kExternal ? 1.0 : -1.0);
  }
  [[nodiscard]] bool is_sum() const {
    for (const int side : {1, -1})
      for (int i = 0; i < kLooks; ++i)
        for (int j = 0; j < kLooks; ++j) {
          const double off = at(side, roll_at(i), z_at(j)) - along_profile(side, roll_at(i)) -
                             along_face(side, z_at(j));
          if (std::abs(off) * base_radius() > kSum_mm) return false;
        }
    return true;
  }

 private:
  [[nodiscard]] const Curve& curve() const { return toothing_.profile->pieces()[flank_].curve; }
  [[nodiscard]] double roll_at(int i) const { return std::lerp(curve().begin, curve().end, i / (kLooks - 1.0)); }
  [[nodiscard]] double z_at(int j) const { return toothing_.twist.face_width_mm * j / (kLooks - 1.0); }
  [[nodiscard]] double at(int side, double roll, double z_mm) const {
    if (!toothing_.has_deviation()) return 0.0;
    const Gear& gear = toothing_.profile->gear();
    const Flank flank = flank_side(Flank::kLeft, gear.kind) == side ? Flank::kLeft : Flank::kRight;
    return toothing_.deviation->deviation_mm(0, flank, base_radius() * roll, z_mm) /
           (std::cos(base_helix_angle_rad(gear)) * base_radius());
  }
  [[nodiscard]] std::vector<double> with_breaks(double begin, double end, double moved) const {
    std::vector<double> breaks{begin, end};
    if (toothing_.has_deviation())
      for (const double roll_mm : toothing_.deviation->roll_breaks_mm) {
        const double roll = roll_mm / base_radius();
        const double place = roll + moved * along_profile(1, roll);
        if ((place - begin) * (place - end) < 0.0) breaks.push_back(place);
      }
    std::sort(breaks.begin(), breaks.end());
    if (begin > end) std::reverse(breaks.begin(), breaks.end());
    return breaks;
  }

  Toothing toothing_;
  std::size_t flank_ = 0;
  double mid_roll_ = 0.0, mid_z_ = 0.0;
};

/// Shares of the fillet at the ends of each of its pieces, as fillet_turn_share() counts them.
std::string fades(const ToothProfile& profile) {
  std::vector<double> lengths;
  double whole = 0.0;
  for (const ProfilePiece& piece : profile.pieces()) {
    if (piece.kind != PieceKind::kFillet) continue;
    lengths.push_back((piece.curve.end_point() - piece.curve.start_point()).norm());
    whole += lengths.back();
  }
  std::string text;
  double from = 0.0;
  for (const double length : lengths) {
    text += (text.empty() ? "[" : ", [") + number(from / whole) + ", " + number((from + length) / whole) + "]";
    from += length;
  }
  return "[" + text + "]";
}

}  // namespace

bool is_modified(const ToothedOutline& teeth) {
  return teeth.toothing().has_deviation() || teeth.edge_chamfer_mm > 0.0 || teeth.displacement != nullptr;
}

std::optional<ScadFlanks> scad_flanks(const ToothedOutline& teeth) {
  const Toothing toothing = teeth.toothing();
  if (teeth.displacement != nullptr || teeth.bed != nullptr) return std::nullopt;
  if (toothing.has_deviation() && teeth.deviation->varies_by_tooth) return std::nullopt;
  const Turns turns(teeth);
  if (toothing.has_deviation() && !turns.is_sum()) return std::nullopt;
  ScadFlanks result;
  result.along_face = teeth.edge_chamfer_mm > 0.0 ||
                      (toothing.has_deviation() && teeth.deviation->varies_along_face);
  const std::vector<double> breaks = turns.flank_breaks();
  const auto& pieces = teeth.profile->pieces();
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    if (i != turns.flank()) {
      result.curves.push_back(pieces[i].curve);
      continue;
    }
    for (std::size_t k = 0; k + 1 < breaks.size(); ++k)
      result.curves.push_back({pieces[i].curve.shape, breaks[k], breaks[k + 1]});
  }
  result.profile = "[" + std::to_string(turns.flank()) + ", " +
                   std::to_string(turns.flank() + breaks.size() - 2);
  for (const int side : {1, -1})
    result.profile += ",\n  " + table([&](double roll) { return turns.along_profile(side, roll); },
                                      turns.field_breaks(), kTable_mm / turns.base_radius(), deg_from_rad);
  result.profile += ",\n  " + fades(*teeth.profile) + "]";
  return result;
}

std::string scad_face(const ToothedOutline& teeth, double z_lower_mm, double z_upper_mm) {
  const Toothing toothing = teeth.toothing();
  const Turns turns(teeth);
  const double width = toothing.twist.face_width_mm, chamfer = teeth.edge_chamfer_mm;
  std::vector<double> inner;
  const auto add = [&](double z) {
    if (z > z_lower_mm + 1e-9 && z < z_upper_mm - 1e-9) inner.push_back(z);
  };
  if (chamfer > 0.0) add(chamfer), add(width - chamfer);
  if (toothing.twist.herringbone) add(0.5 * width);
  if (toothing.has_deviation())
    for (const double z : teeth.deviation->z_breaks_mm) add(z);
  std::sort(inner.begin(), inner.end());
  std::vector<double> breaks{z_lower_mm};
  for (const double z : inner)
    if (z > breaks.back() + 1e-9) breaks.push_back(z);
  breaks.push_back(z_upper_mm);
  const auto share = [&](double z) { return (z - z_lower_mm) / (z_upper_mm - z_lower_mm); };
  std::string text = "[";
  for (const int side : {1, -1})
    text += table([&](double z) { return turns.along_face(side, z); }, breaks, kTable_mm / turns.base_radius(), share) +
            ",\n  ";
  std::string depths, shares;
  for (const double z : breaks) {
    const double depth = std::max(0.0, chamfer - std::min(z, width - z));
    depths += (depths.empty() ? "[" : ", [") + number(share(z)) + ", " + number(depth) + "]";
    shares += (shares.empty() ? "" : ", ") + number(share(z));
  }
  return text + "[" + depths + "], [" + shares + "]]";
}

}  // namespace trueflank::io

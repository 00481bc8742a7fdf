// SPDX-License-Identifier: GPL-3.0-or-later
//
// Every limit is a function of the centre distance and one shift; its most over a box is the less
// of two: what the interval says, and the middle's value with the slopes' intervals over the way
// from it.
#include "trueflank/search/search_enclosure.h"

#include <optional>

#include "trueflank/geometry/involute.h"
#include "trueflank/search/search_enclosed_root.h"
#include "trueflank/search/search_mesh_loss.h"

namespace trueflank {
namespace {

/// Corners are looked at that come this near to a root between the samples, in modules.
constexpr double kNear = 0.1;

/// A mesh at a centre distance and two tip radii.
template <class T>
struct Contact {
  T tangent, involute;  ///< of the working pressure angle
  T approach, recess;   ///< path between the tips, before and after the pitch point
};

template <class T>
struct LayerShape {
  T a;
  EnclosedGear<T> sun, planet, ring;
  Contact<T> outer, inner;
};

class LayerEncloser {
 public:
  LayerEncloser(const SearchRequirements& r, const EnclosedLayer& layer, const LayerBox& box)
      : r_(r),
        layer_(layer),
        tan_(std::tan(r.rack.pressure_angle_rad)),
        middle_distance_(box.distance.middle()),
        middle_shift_(box.shift.middle()) {
    way_[0] = box.distance - Interval(middle_distance_);
    way_[box.which] = box.shift - Interval(middle_shift_);
    whole_ = shape<Slope>(Slope::variable(box.distance, 0), Slope::variable(box.shift, box.which));
    middle_ = shape<Interval>(middle_distance_, middle_shift_);
    point_ = shape<double>(middle_distance_, middle_shift_);
    shifts_ = box.shift;
  }

  LayerEnclosure run() {
    LayerEnclosure result;
    result.possible = possible_outline() && possible_tips() && possible_corners() && lost(result);
    return result;
  }

 private:
  template <class T>
  const LayerShape<T>& of() const {
    if constexpr (std::is_same_v<T, Slope>)
      return whole_;
    else if constexpr (std::is_same_v<T, Interval>)
      return middle_;
    else
      return point_;
  }

  /// The most of a function of the shape, told by what it is of each kind of number.
  [[nodiscard]] double most(const Slope& whole, const Interval& middle) const {
    Interval rise = middle;
    for (std::size_t i = 0; i < 3; ++i) rise = rise + whole.d[i] * way_[i];
    return std::min(whole.v.hi, rise.hi);
  }
  /// The lesser range of the two.
  [[nodiscard]] Slope tightened(Slope whole, const Interval& middle) const {
    Interval around = middle;
    for (std::size_t i = 0; i < 3; ++i) around = around + whole.d[i] * way_[i];
    whole.v = {std::max(whole.v.lo, around.lo), std::min(whole.v.hi, around.hi)};
    return whole;
  }
  /// Whether f(shape) may reach `least`, give or take kLooseLimit.
  template <class F>
  [[nodiscard]] bool may_reach(const F& f, double least) const {
    return !(most(Slope(f(whole_)), Interval(f(middle_))) < least - kLooseLimit);
  }

  template <class T>
  Contact<T> contact(const T& a, const EnclosedGear<T>& gear1, const EnclosedGear<T>& gear2) const {
    const double sum =
        gear2.ring ? gear2.base_radius - gear1.base_radius : gear1.base_radius + gear2.base_radius;
    Contact<T> c;
    c.tangent = tangent_at(a, sum);
    c.involute = involute_of_tangent(c.tangent);
    const T roll2 = tangent_at(gear2.tip, gear2.base_radius) * T(gear2.base_radius),
            pitch2 = T(gear2.base_radius) * c.tangent;
    c.approach = gear2.ring ? pitch2 - roll2 : roll2 - pitch2;
    c.recess = (tangent_at(gear1.tip, gear1.base_radius) - c.tangent) * T(gear1.base_radius);
    return c;
  }

  template <class T>
  EnclosedGear<T> gear(int teeth, bool ring, const T& shift) const {
    EnclosedGear<T> g{.teeth = teeth, .ring = ring, .shift = shift};
    g.base_radius = 0.5 * teeth * std::cos(r_.rack.pressure_angle_rad);
    const double inv = involute_function(r_.rack.pressure_angle_rad);
    const T part = T(2.0 * tan_ / teeth) * shift;
    g.base_half_angle =
        ring ? T(0.5 * kPi / teeth - inv) - part : T(0.5 * kPi / teeth + inv) + part;
    g.tip = ring ? T(0.5 * teeth - r_.rack.addendum) + shift
                 : T(0.5 * teeth + r_.rack.addendum) + shift;
    g.root = ring ? T(0.5 * teeth + r_.rack.dedendum) + shift
                  : T(0.5 * teeth - r_.rack.dedendum) + shift;
    return g;
  }

  /// x1 + x2, or x2 - x1, that leaves no backlash.
  template <class T>
  T shift_sum(const T& a, int teeth1, int teeth2, bool internal) const {
    const double teeth = internal ? teeth2 - teeth1 : teeth1 + teeth2;
    const double base_sum = 0.5 * teeth * std::cos(r_.rack.pressure_angle_rad);
    return T(0.5 * teeth / tan_) * (involute_of_tangent(tangent_at(a, base_sum)) -
                                    T(involute_function(r_.rack.pressure_angle_rad)));
  }

  template <class T>
  LayerShape<T> shape(const T& distance, const T& shift) const {
    LayerShape<T> s{.a = distance * T(1.0 / layer_.module)};
    T planet = shift;
    if (layer_.ring) {
      s.ring = gear<T>(layer_.ring, true, shift);
      planet = shift - shift_sum(s.a, layer_.planet, layer_.ring, true);
    }
    s.planet = gear<T>(layer_.planet, false, planet);
    if (layer_.sun) {
      s.sun = gear<T>(layer_.sun, false, shift_sum(s.a, layer_.sun, layer_.planet, false) - planet);
      const T rise = s.a - T(0.5 * (layer_.sun + layer_.planet));
      s.sun.tip = T(0.5 * layer_.sun + r_.rack.addendum) + rise - planet;
      s.planet.tip =
          min(s.planet.tip, T(0.5 * layer_.planet + r_.rack.addendum) + rise - s.sun.shift);
      s.outer = contact(s.a, s.sun, s.planet);
    }
    if (layer_.ring) s.inner = contact(s.a, s.planet, s.ring);
    return s;
  }

  bool possible_outline() const {
    const auto within = [&](const auto& of_shape) {
      return may_reach(of_shape, r_.shift_min) &&
             may_reach([&](const auto& s) { return -of_shape(s); }, -r_.shift_max);
    };
    if (layer_.sun && !within([](const auto& s) { return s.sun.shift; })) return false;
    if (layer_.ring && !within([](const auto& s) { return s.planet.shift; })) return false;
    if (layer_.planets > 1) {
      const double sine = 2.0 * std::sin(kPi / layer_.planets);
      if (!may_reach(
              [&]<class S>(const S& s) {
                return decltype(s.a)(sine) * s.a - decltype(s.a)(2.0) * s.planet.tip;
              },
              r_.planet_clearance_mm / layer_.least_module_mm))
        return false;
    }
    if (layer_.ring &&
        !may_reach([](const auto& s) { return s.ring.tip; }, point_.ring.base_radius))
      return false;
    return (!layer_.sun || thick([](const auto& s) -> const auto& { return s.sun; })) &&
           thick([](const auto& s) -> const auto& { return s.planet; }) &&
           (!layer_.ring || thick([](const auto& s) -> const auto& { return s.ring; }));
  }

  template <class Get>
  bool thick(const Get& get) const {
    const double backlash =
        r_.backlash_mm ? *r_.backlash_mm / layer_.least_module_mm : kUsualBacklash;
    if (get(whole_).tip.v.lo <= point_base(get))
      return may_reach([&](const auto& s) { return get(s).tip; }, point_base(get));
    return may_reach(
        [&](const auto& s) {
          const auto& g = get(s);
          using T = std::decay_t<decltype(g.tip)>;
          return T(2.0) * g.tip * half_angle_at(g, g.tip) -
                 T(0.55 * backlash / (0.5 * g.teeth)) * g.tip;
        },
        r_.tip_thickness);
  }
  template <class Get>
  double point_base(const Get& get) const {
    return get(point_).base_radius;
  }

  bool possible_tips() const {
    const double base_pitch = kPi * std::cos(r_.rack.pressure_angle_rad);
    const auto lengths = [&](auto get) {
      const auto length = [&](const auto& s) { return get(s).approach + get(s).recess; };
      return may_reach(length, r_.contact_ratio_min * base_pitch) &&
             may_reach([&](const auto& s) { return -length(s); },
                       -r_.contact_ratio_max * base_pitch);
    };
    if (layer_.sun && !lengths([](const auto& s) -> const auto& { return s.outer; })) return false;
    if (layer_.ring && !lengths([](const auto& s) -> const auto& { return s.inner; })) return false;
    if (layer_.sun && (!may_reach([](const auto& s) { return s.a - s.sun.tip - s.planet.root; },
                                  r_.tip_clearance) ||
                       !may_reach([](const auto& s) { return s.a - s.planet.tip - s.sun.root; },
                                  r_.tip_clearance)))
      return false;
    if (layer_.ring && (!may_reach([](const auto& s) { return s.ring.root - s.a - s.planet.tip; },
                                   r_.tip_clearance) ||
                        !may_reach([](const auto& s) { return s.ring.tip - s.a - s.planet.root; },
                                   r_.tip_clearance)))
      return false;
    return !layer_.ring || tips_pass();
  }

  [[nodiscard]] double corner_clearance() const {
    return std::max(1e-6, mm_from_um(r_.clearance_um) / layer_.least_module_mm);
  }

  /// Tips of planet and ring outside the line of action (search_model.cpp).
  bool tips_pass() const {
    const auto cosines = []<class S>(const S& s) {
      using T = std::decay_t<decltype(s.a)>;
      const T r1 = square(s.planet.tip), r2 = square(s.ring.tip), a = square(s.a);
      return std::pair<T, T>{(r2 - r1 - a) / (T(2.0) * s.a * s.planet.tip),
                             (a + r2 - r1) / (T(2.0) * s.a * s.ring.tip)};
    };
    const auto [first, second] = cosines(whole_);
    if (!(first.v.lo > -1.0 && first.v.hi < 1.0 && second.v.lo > -1.0 && second.v.hi < 1.0))
      return true;
    return may_reach(
        [&](const auto& s) {
          using T = std::decay_t<decltype(s.a)>;
          const auto [cos1, cos2] = cosines(s);
          const T theta1 = acos(cos1) + involute_at(s.planet, s.planet.tip) - s.inner.involute;
          return s.ring.tip * (theta1 * T(static_cast<double>(layer_.planet) / layer_.ring) +
                               s.inner.involute - involute_at(s.ring, s.ring.tip) - acos(cos2));
        },
        corner_clearance());
  }

  /// The tip corner of one gear in the root of another, at the place of its root curve where it
  /// comes closest in the middle of the box.
  template <class Own, class Mate>
  bool corner_passes(const Own& own, const Mate& mate) const {
    const RootPlace place =
        closest_place(r_.rack, own(point_), mate(point_), point_.a, corner_clearance() + kNear);
    if (!place.found || !surely_root(r_.rack, own(whole_), own(middle_), way_, place)) return true;
    const auto whole = corner_distance(r_.rack, own(whole_), mate(whole_), whole_.a, place);
    if (!whole) return true;
    const auto middle = corner_distance(r_.rack, own(middle_), mate(middle_), middle_.a, place);
    return !middle || !(most(*whole, *middle) < corner_clearance() - kLooseLimit);
  }

  bool possible_corners() const {
    const auto sun = [](const auto& s) -> const auto& { return s.sun; };
    const auto planet = [](const auto& s) -> const auto& { return s.planet; };
    const auto ring = [](const auto& s) -> const auto& { return s.ring; };
    return (!layer_.sun || (corner_passes(sun, planet) && corner_passes(planet, sun))) &&
           (!layer_.ring || (corner_passes(planet, ring) && corner_passes(ring, planet)));
  }

  /// What undercut and root form leave of a path; false: not enough for any point of the box.
  template <class Get1, class Get2, class GetContact>
  bool path_left(const Get1& gear1, const Get2& gear2, const GetContact& contact, LossPath& whole,
                 LossPath& middle) const {
    const auto left = [&]<class S>(const S& s, LossPath& path, auto&& tight) {
      using T = std::decay_t<decltype(s.a)>;
      const auto& c = contact(s);
      const auto& m = contact(middle_);
      const auto &g1 = gear1(s), &g2 = gear2(s);
      path.tangent = tight(c.tangent, m.tangent);
      const Slope pitch1 = Slope(g1.base_radius) * path.tangent,
                  pitch2 = Slope(g2.base_radius) * path.tangent;
      const T form1 = root_form_roll(r_.rack, g1), form2 = root_form_roll(r_.rack, g2);
      path.approach = min(tight(c.approach, m.approach), pitch1 - Slope(form1));
      path.recess =
          min(tight(c.recess, m.recess), g2.ring ? Slope(form2) - pitch2 : pitch2 - Slope(form2));
    };
    left(whole_, whole, [&](const Slope& s, const Interval& m) { return tightened(s, m); });
    left(middle_, middle, [](const Interval& s, const Interval&) { return Slope(s); });
    const double base_pitch = kPi * std::cos(r_.rack.pressure_angle_rad);
    const double least = (r_.contact_ratio_min - kLooseLimit) * base_pitch;
    if (most(whole.approach + whole.recess, (middle.approach + middle.recess).v) < least)
      return false;
    // where the limit is kept, what one part lacks the other has
    const auto at_least = [](Slope& part, const Slope& other, double length) {
      part.v.lo = std::min(part.v.hi, std::max(part.v.lo, length - other.v.hi));
    };
    at_least(whole.approach, whole.recess, least);
    at_least(whole.recess, whole.approach, least);
    return true;
  }

  /// By the contact ratios of the tips.
  static Slope by_formula(double friction, double curvature, double base_pitch,
                          const Slope& approach, const Slope& recess) {
    const Slope e1 = approach * Slope(1.0 / base_pitch), e2 = recess * Slope(1.0 / base_pitch);
    // e^2 - e = (e - 1/2)^2 - 1/4
    const Slope sum = square(e1 - Slope(0.5)) + square(e2 - Slope(0.5)) + Slope(0.5);
    return Slope(1.0) - Slope(friction * kPi * curvature) * sum;
  }

  template <class Get1, class Get2, class GetContact>
  bool mesh_lost(const Get1& gear1, const Get2& gear2, const GetContact& contact, bool gear1_drives,
                 Slope& whole, Interval& middle) const {
    LossPath path, middle_path;
    if (!path_left(gear1, gear2, contact, path, middle_path)) return false;
    const double base_pitch = kPi * std::cos(r_.rack.pressure_angle_rad);
    const auto &g1 = gear1(point_), &g2 = gear2(point_);
    if (r_.loss_model == LossModel::kContactRatios) {
      const double curvature = 1.0 / g1.teeth + (g2.ring ? -1.0 : 1.0) / g2.teeth;
      whole = by_formula(r_.friction, curvature, base_pitch, contact(whole_).approach,
                         contact(whole_).recess);
      middle = by_formula(r_.friction, curvature, base_pitch, contact(middle_).approach,
                          contact(middle_).recess)
                   .v;
      whole = tightened(whole, middle);
      return true;
    }
    const LossMesh mesh{.base_radius1 = g1.base_radius,
                        .base_radius2 = g2.base_radius,
                        .internal = g2.ring,
                        .gear1_drives = gear1_drives,
                        .base_pitch = base_pitch,
                        .friction = r_.friction};
    middle = enclosed_path_efficiency(mesh, middle_path).v;
    whole = tightened(enclosed_path_efficiency(mesh, path), middle);
    return true;
  }

  bool lost(LayerEnclosure& result) const {
    const auto sun = [](const auto& s) -> const auto& { return s.sun; };
    const auto planet = [](const auto& s) -> const auto& { return s.planet; };
    const auto ring = [](const auto& s) -> const auto& { return s.ring; };
    if (layer_.sun && !mesh_lost(
                          sun, planet, [](const auto& s) -> const auto& { return s.outer; },
                          layer_.sun_drives, result.sun_planet, result.sun_planet_middle))
      return false;
    return !layer_.ring ||
           mesh_lost(
               planet, ring, [](const auto& s) -> const auto& { return s.inner; },
               layer_.planet_drives_ring, result.planet_ring, result.planet_ring_middle);
  }

  const SearchRequirements& r_;
  const EnclosedLayer& layer_;
  double tan_, middle_distance_, middle_shift_;
  std::array<Interval, 3> way_{};  ///< from the box's middle
  Interval shifts_;
  LayerShape<Slope> whole_;
  LayerShape<Interval> middle_;
  LayerShape<double> point_;
};

}  // namespace

LayerEnclosure enclose(const SearchRequirements& requirements, const EnclosedLayer& layer,
                       const LayerBox& box) {
  return LayerEncloser(requirements, layer, box).run();
}

}  // namespace trueflank

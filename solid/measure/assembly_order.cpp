// SPDX-License-Identifier: GPL-3.0-or-later
//
// Which body lies above which: a is below b where a, moved up, meets b. Moved down, b meets a then,
// so that one relation tells both directions. Bodies go together exactly where it has no circle. A
// unit may be made by itself where nothing else must come between its bodies.
#include "trueflank/solid/measure/assembly_order.h"

#include <algorithm>

#include "trueflank/base/tolerance.h"
#include "trueflank/solid/measure/body_layers.h"
#include "trueflank/train/machine/machine_layout.h"

namespace trueflank {
namespace {

using Bodies = std::vector<std::size_t>;

/// What herringbone planets and their sun are, once they stand round it; and a herringbone pair.
constexpr const char* kSunAndPlanets = "sun_and_planets";
constexpr const char* kPinionAndWheel = "pinion_and_wheel";

/// A relation between things that are numbered.
class Relation {
 public:
  explicit Relation(std::size_t count) : count_(count), holds_(count * count, 0) {}

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool holds(std::size_t a, std::size_t b) const {
    return holds_[a * count_ + b] != 0;
  }
  void set(std::size_t a, std::size_t b) { holds_[a * count_ + b] = 1; }
  /// With everything that follows: a before b before c.
  [[nodiscard]] Relation closed() const {
    Relation all = *this;
    for (std::size_t k = 0; k < count_; ++k)
      for (std::size_t a = 0; a < count_; ++a)
        if (all.holds(a, k))
          for (std::size_t b = 0; b < count_; ++b)
            if (all.holds(k, b)) all.set(a, b);
    return all;
  }

 private:
  std::size_t count_;
  std::vector<std::uint8_t> holds_;
};

bool ends_with(const std::string& text, const std::string& end) { return text.ends_with(end); }

/// What lies below what, of the bodies of an assembly.
class Stack {
 public:
  Stack(const GearTrain& train, const PartShapes& shapes) : train_(train), shapes_(shapes) {
    if (const auto layout = machine_layout(train)) meant_mm_ += layout->press_mm;
    for (const Placement& body : shapes.assembly) layers_.push_back(body_layers(part(body), body));
  }

  [[nodiscard]] Relation below() const {
    Relation relation(layers_.size());
    for (std::size_t a = 0; a < layers_.size(); ++a)
      for (std::size_t b = 0; b < layers_.size(); ++b)
        if (a != b && meets_going_up(a, b)) relation.set(a, b);
    return relation;
  }

 private:
  [[nodiscard]] const PartShape& part(const Placement& body) const {
    return shapes_.parts[static_cast<std::size_t>(body.part)];
  }
  [[nodiscard]] int gear_of(const ToothedOutline& teeth) const {
    for (std::size_t i = 0; i < train_.gears.size(); ++i)
      if (teeth.profile == &train_.gears[i].profile) return static_cast<int>(i);
    return -1;
  }
  [[nodiscard]] bool in_mesh(const BodyLayer& a, const BodyLayer& b) const {
    if (!a.teeth || !b.teeth) return false;
    const int one = gear_of(*a.teeth), other = gear_of(*b.teeth);
    return one >= 0 && other >= 0 &&
           std::any_of(train_.meshes.begin(), train_.meshes.end(), [&](const TrainMesh& mesh) {
             return (mesh.gear1 == one && mesh.gear2 == other) ||
                    (mesh.gear1 == other && mesh.gear2 == one);
           });
  }
  /// The motor's shaft with its flat goes into the bore on it.
  [[nodiscard]] bool is_shaft(std::size_t a, std::size_t b) const {
    return part(shapes_.assembly[a]).bought.starts_with("motor ") &&
           part(shapes_.assembly[b]).member == train_.topology().input &&
           part(shapes_.assembly[b]).bought.empty();
  }
  /// The shaft against what is round the axis of the other body.
  [[nodiscard]] double shaft_gap_mm(const BodyLayer& motor, const BodyLayer& other) const {
    const double shaft =
        train_.design.machine ? 0.5 * train_.design.machine->motor.shaft_diameter_mm : 0.0;
    const bool bored = std::any_of(other.holes.begin(), other.holes.end(), [](const Disc& hole) {
      return hole.centre.norm() < tolerance::kTouch_mm;
    });
    return motor.outer.radius_mm <= shaft + tolerance::kTouch_mm && bored
               ? 0.0
               : gap_at_rest_mm(motor, other);
  }
  /// Herringbone teeth on the way up: those below the apex do not go through those above it. Two
  /// external gears are brought together across the axis (Orderer::join_round_the_sun), and so is a
  /// pinion from the middle of its ring.
  [[nodiscard]] bool passes_the_apex(std::size_t a, const BodyLayer& s, const BodyLayer& t) const {
    const ToothedOutline& teeth = *s.teeth;
    if (!teeth.twist.herringbone || is_external_mesh(s, t) || !train_.topology().has_planets()) return false;
    const double apex = shapes_.assembly[a].translation_mm[2] + teeth.z_lower_mm +
                        0.5 * teeth.twist.face_width_mm;
    return s.z.lower_mm < apex - tolerance::kTouch_mm && t.z.upper_mm > apex + tolerance::kTouch_mm;
  }
  [[nodiscard]] static bool is_external_mesh(const BodyLayer& a, const BodyLayer& b) {
    return a.teeth->profile->gear().kind == GearKind::kExternal &&
           b.teeth->profile->gear().kind == GearKind::kExternal;
  }
  [[nodiscard]] bool meets_going_up(std::size_t a, std::size_t b) const {
    for (const BodyLayer& s : layers_[a])
      for (const BodyLayer& t : layers_[b]) {
        if (t.z.upper_mm <= s.z.lower_mm + tolerance::kTouch_mm) continue;
        if (in_mesh(s, t)) {
          if (passes_the_apex(a, s, t)) return true;
          continue;
        }
        const double gap = is_shaft(a, b)   ? shaft_gap_mm(s, t)
                           : is_shaft(b, a) ? shaft_gap_mm(t, s)
                                            : gap_at_rest_mm(s, t);
        if (gap < -meant_mm_) return true;
      }
    return false;
  }

  const GearTrain& train_;
  const PartShapes& shapes_;
  double meant_mm_ = tolerance::kTouch_mm;  ///< so deep one part is pressed into another
  std::vector<std::vector<BodyLayer>> layers_;
};

/// A body, bodies of one kind that stand side by side, or a unit.
struct Item {
  Bodies bodies;
  std::string name;
  int unit = -1;
};

class Orderer {
 public:
  Orderer(const GearTrain& train, const PartShapes& shapes)
      : train_(train), shapes_(shapes), below_(Stack(train, shapes).below()) {}

  AssemblyOrder order() {
    for (std::size_t i = 0; i < below_.count(); ++i) items_.push_back({{i}, name_of(i)});
    const std::vector<Item> single = items_;
    join_round_the_sun();
    const Relation all = below(items_).closed();
    for (std::size_t i = 0; i < all.count(); ++i)
      if (all.holds(i, i))
        result_.stuck.insert(result_.stuck.end(), items_[i].bodies.begin(), items_[i].bodies.end());
    if (!result_.stuck.empty()) {
      result_.units.clear();
      std::sort(result_.stuck.begin(), result_.stuck.end());
      return std::move(result_);
    }
    items_ = single;
    result_.units.clear();
    if (train_.design.machine)
      make_units();
    else
      join_round_the_sun();
    join_kin();
    put_together("gearbox", items_, main_rank());
    return std::move(result_);
  }

 private:
  [[nodiscard]] std::string name_of(std::size_t body) const {
    return shapes_.parts[static_cast<std::size_t>(shapes_.assembly[body].part)].name;
  }
  [[nodiscard]] int member_of(std::size_t body) const {
    return shapes_.parts[static_cast<std::size_t>(shapes_.assembly[body].part)].member;
  }

  /// The relation between items.
  [[nodiscard]] Relation below(const std::vector<Item>& items) const {
    Relation relation(items.size());
    for (std::size_t i = 0; i < items.size(); ++i)
      for (std::size_t j = 0; j < items.size(); ++j) {
        if (i == j) continue;
        for (const std::size_t a : items[i].bodies)
          for (const std::size_t b : items[j].bodies)
            if (below_.holds(a, b)) relation.set(i, j);
      }
    return relation;
  }
  /// Nothing else lies between the items of a set.
  [[nodiscard]] static bool is_convex(const Relation& closed, const std::vector<bool>& in) {
    for (std::size_t k = 0; k < in.size(); ++k) {
      if (in[k]) continue;
      bool under = false, over = false;
      for (std::size_t i = 0; i < in.size(); ++i) {
        under = under || (in[i] && closed.holds(i, k));
        over = over || (in[i] && closed.holds(k, i));
      }
      if (under && over) return false;
    }
    return true;
  }
  /// With all that lies between them.
  static void close(const Relation& closed, std::vector<bool>& in) {
    const std::vector<bool> given = in;
    for (std::size_t k = 0; k < in.size(); ++k) {
      bool under = false, over = false;
      for (std::size_t i = 0; i < in.size(); ++i) {
        under = under || (given[i] && closed.holds(i, k));
        over = over || (given[i] && closed.holds(k, i));
      }
      in[k] = in[k] || (under && over);
    }
  }

  using Rank = std::vector<std::string>;  ///< beginnings of names, in the order that is wished for

  [[nodiscard]] static std::size_t rank_of(const Item& item, const Rank& rank) {
    for (std::size_t i = 0; i < rank.size(); ++i) {
      const std::string& wish = rank[i];  // "=name", "*end" or "beginning"
      if (wish[0] == '=') {
        if (item.name == wish.substr(1)) return i;
        continue;
      }
      if (wish[0] == '*' ? ends_with(item.name, wish.substr(1)) : item.name.starts_with(wish))
        return i;
    }
    return rank.size();
  }

  /// Item by item, the first by rank for which nothing is left to come between.
  void put_together(const std::string& name, std::vector<Item> items, const Rank& rank) {
    std::stable_sort(items.begin(), items.end(), [&](const Item& a, const Item& b) {
      return rank_of(a, rank) < rank_of(b, rank);
    });
    const Relation relation = below(items), closed = relation.closed();
    std::vector<bool> there(items.size(), false);
    AssemblyUnit unit{.name = name, .steps = {}};
    for (std::size_t made = 0; made < items.size(); ++made)
      for (std::size_t i = 0; i < items.size(); ++i) {
        if (there[i]) continue;
        there[i] = true;
        if (!is_convex(closed, there)) {
          there[i] = false;
          continue;
        }
        bool from_above = true;
        for (std::size_t j = 0; j < items.size(); ++j)
          from_above = from_above && !(j != i && there[j] && relation.holds(i, j));
        unit.steps.push_back({items[i].bodies, items[i].unit, from_above ? 1.0 : -1.0});
        break;
      }
    result_.units.push_back(std::move(unit));
  }

  /// Makes one item of several, where they can be put together by themselves.
  void make_unit(const std::string& name, const std::vector<bool>& wanted, const Rank& rank) {
    if (std::count(wanted.begin(), wanted.end(), true) < 2) return;
    const Relation closed = below(items_).closed();
    std::vector<bool> in = wanted;
    close(closed, in);
    if (!is_convex(closed, in) || std::count(in.begin(), in.end(), false) == 0) return;
    Item unit{.bodies = {}, .name = name, .unit = -1};
    std::vector<Item> inside, rest;
    for (std::size_t i = 0; i < items_.size(); ++i) (in[i] ? inside : rest).push_back(items_[i]);
    for (const Item& item : inside)
      unit.bodies.insert(unit.bodies.end(), item.bodies.begin(), item.bodies.end());
    put_together(name, join_kin(std::move(inside)), rank);
    unit.unit = static_cast<int>(result_.units.size()) - 1;
    rest.push_back(std::move(unit));
    items_ = std::move(rest);
  }
  template <class Wanted>
  void make_unit_of(const std::string& name, const Rank& rank, const Wanted& wanted) {
    std::vector<bool> in;
    for (const Item& item : items_) in.push_back(wanted(item));
    make_unit(name, in, rank);
  }

  /// Single bodies of one part that do not lie above each other become one item.
  [[nodiscard]] std::vector<Item> join_kin(std::vector<Item> items) const {
    for (std::size_t i = 0; i < items.size(); ++i)
      for (std::size_t j = items.size() - 1; j > i; --j) {
        if (items[i].name != items[j].name || (items[i].unit < 0) != (items[j].unit < 0) ||
            items[i].unit >= 0)
          continue;
        std::vector<Item> joined = items;
        joined[i].bodies.insert(joined[i].bodies.end(), items[j].bodies.begin(),
                                items[j].bodies.end());
        joined.erase(joined.begin() + static_cast<std::ptrdiff_t>(j));
        const Relation before = below(items), after = below(joined).closed();
        bool circle = before.holds(i, j) || before.holds(j, i);
        for (std::size_t k = 0; k < joined.size(); ++k) circle = circle || after.holds(k, k);
        if (!circle) items = std::move(joined);
      }
    for (Item& item : items) std::sort(item.bodies.begin(), item.bodies.end());
    return items;
  }
  void join_kin() { items_ = join_kin(std::move(items_)); }

  /// "" where there is none.
  [[nodiscard]] std::string carrier() const {
    const Topology& topology = train_.topology();
    const int planet = topology.first_planet();
    return planet == kNoMember ? "" : topology.name_of(topology.carrier_of(planet));
  }
  /// The ring or the wheel that drives out, or the carrier's far plate: where the output's inserts
  /// sit.
  [[nodiscard]] std::string driving_part() const {
    const Topology& topology = train_.topology();
    const bool gear = !topology.is_carrier(topology.output);
    return gear ? topology.name_of(topology.output) : carrier() + "_top";
  }

  [[nodiscard]] double height_of(const std::string& part) const {
    for (std::size_t i = 0; i < shapes_.assembly.size(); ++i)
      if (name_of(i) == part) return shapes_.assembly[i].translation_mm[2];
    return 0.0;
  }

  void make_units() {
    const auto with_inserts = [&](const std::string& part,
                                  std::initializer_list<const char*> inserts) {
      make_unit_of(part, {part}, [&](const Item& item) {
        return item.name == part ||
               (item.name.starts_with("insert_") &&
                std::any_of(inserts.begin(), inserts.end(), [&](const char* what) {
                  return ends_with(item.name, std::string("_") + what);
                }));
      });
    };
    const double lid = height_of("lid");
    const auto in_lid = [&](const Item& item) {
      const std::size_t body = item.bodies.front();
      return item.name.starts_with("bearing_") && member_of(body) == kNoMember &&
             (carrier() != "" || shapes_.assembly[body].translation_mm[2] > lid);
    };
    make_unit_of("housing", {"housing", "insert_", "bearing_"}, [&](const Item& item) {
      return item.name == "housing" ||
             (item.name.starts_with("insert_") && ends_with(item.name, "_housing")) ||
             (item.name.starts_with("bearing_") && member_of(item.bodies.front()) == kNoMember &&
              !in_lid(item));
    });
    with_inserts("output", {"load"});
    const std::string top = carrier() + "_top";
    if (driving_part() == top) {
      with_inserts(top, {"carrier", "output"});
    } else {
      if (carrier() != "") with_inserts(top, {"carrier"});
      with_inserts(driving_part(), {"output"});
    }
    make_unit_of(
        "lid", {"lid", "insert_", "bearing_", "retainer", "screw_"}, [&](const Item& item) {
          return item.name == "lid" || item.name == "retainer" ||
                 ends_with(item.name, "_retainer") || in_lid(item);
        });
    if (carrier() == "") return join_round_the_sun();
    make_planets();
    join_round_the_sun();
    const int arm = train_.topology().carrier_of(train_.topology().first_planet());
    make_unit_of(
        carrier(),
        {"=" + carrier(), "pin_", "*_pillar", kSunAndPlanets, "planet", "bearing_", top, "screw_"},
        [&](const Item& item) {
          return item.name.starts_with("planet") || item.name == kSunAndPlanets ||
                 std::any_of(item.bodies.begin(), item.bodies.end(), [&](std::size_t body) {
                   return member_of(body) == arm && !is_of_output(name_of(body));
                 });
        });
  }
  /// Of what stands on the carrier where that drives out.
  [[nodiscard]] static bool is_of_output(const std::string& name) {
    return name == "journal" || name == "output" || ends_with(name, "_output") ||
           ends_with(name, "_load");
  }
  /// Herringbone planets go round their sun from the side, and a wheel to its pinion, before anything
  /// else holds them: one thing from then on. The planets' items may already be units of their own.
  void join_round_the_sun() {
    const Topology& topology = train_.topology();
    const auto is_gear_of = [&](const Item& item, bool planet) {
      return std::any_of(item.bodies.begin(), item.bodies.end(), [&](std::size_t body) {
        const int member = member_of(body);
        if (member == kNoMember || topology.gears_of(member).empty()) return false;
        if (!topology.has_planets())  // not what is screwed to the wheel
          return name_of(body) == topology.name_of(member) &&
                 topology.gears_of(member).front() == (planet ? 1 : 0);
        if (planet) return topology.is_planet(member);
        const auto first = static_cast<std::size_t>(topology.first_gear_of(member));
        return !topology.is_planet(member) && is_made(body) &&
               train_.gears[first].profile.gear().kind == GearKind::kExternal &&
               is_in_external_mesh(static_cast<int>(first));
      });
    };
    if (!train_.design.herringbone) return;
    std::vector<Item> suns, planets, rest;
    for (const Item& item : items_)
      (is_gear_of(item, false) ? suns : is_gear_of(item, true) ? planets : rest).push_back(item);
    if (suns.size() != 1 || planets.empty()) return;
    Item joined{.bodies = suns[0].bodies,
                .name = topology.has_planets() ? kSunAndPlanets : kPinionAndWheel,
                .unit = -1};
    AssemblyUnit unit{.name = joined.name, .steps = {{suns[0].bodies, suns[0].unit, 1.0}}};
    for (const Item& planet : planets) {
      joined.bodies.insert(joined.bodies.end(), planet.bodies.begin(), planet.bodies.end());
      unit.steps.push_back({planet.bodies, planet.unit, 0.0});
    }
    result_.units.push_back(std::move(unit));
    joined.unit = static_cast<int>(result_.units.size()) - 1;
    rest.push_back(std::move(joined));
    items_ = std::move(rest);
  }
  [[nodiscard]] bool is_made(std::size_t body) const {
    return shapes_.parts[static_cast<std::size_t>(shapes_.assembly[body].part)].bought.empty();
  }
  [[nodiscard]] bool is_in_external_mesh(int gear) const {
    return std::any_of(train_.meshes.begin(), train_.meshes.end(), [&](const TrainMesh& mesh) {
      return (mesh.gear1 == gear || mesh.gear2 == gear) && !train_.pair(mesh).internal();
    });
  }

  /// Each planet with its two bearings.
  void make_planets() {
    const auto at = [&](std::size_t body) {
      const auto& move = shapes_.assembly[body].translation_mm;
      return Point2(move[0], move[1]);
    };
    Bodies planets;
    for (const Item& item : items_) {
      const int member = member_of(item.bodies.front());
      if (member != kNoMember && train_.topology().is_planet(member))
        planets.push_back(item.bodies.front());
    }
    for (const std::size_t planet : planets)
      make_unit_of(name_of(planet), {"planet"}, [&](const Item& item) {
        const std::size_t body = item.bodies.front();
        return body == planet ||
               (item.name.starts_with("bearing_") && member_of(body) != kNoMember &&
                (at(body) - at(planet)).norm() < tolerance::kTouch_mm);
      });
  }

  [[nodiscard]] Rank main_rank() const {
    const Topology& topology = train_.topology();
    if (!train_.design.machine) return {"*ring1", "*ring", "planet", "sun"};
    std::string held = carrier();
    for (const int member : topology.fixed)
      if (!topology.gears_of(member).empty()) held = topology.name_of(member);
    // a set screw is tightened before the housing goes over the gear
    const auto layout = machine_layout(train_);
    const std::string first =
        layout && layout->set_screw.is_there() ? topology.name_of(topology.input) : "motor";
    return {"motor",     "=" + first, "housing", "insert_",      "*_motor", topology.name_of(topology.input),
            held,        carrier(), driving_part(), "journal", "lid",
            "*_housing", "output",  "*_output"};
  }

  const GearTrain& train_;
  const PartShapes& shapes_;
  const Relation below_;
  std::vector<Item> items_;
  AssemblyOrder result_;
};

}  // namespace

AssemblyOrder assembly_order(const GearTrain& train, const PartShapes& shapes) {
  return Orderer(train, shapes).order();
}

}  // namespace trueflank

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/search/search_train.h"

#include <algorithm>
#include <limits>
#include <numeric>

#include "trueflank/base/contract.h"
#include "trueflank/design/kinds/train_kind.h"
#include "trueflank/train/stages.h"

namespace trueflank {
namespace {

std::size_t at(int index) { return static_cast<std::size_t>(index); }

/// A mesh's gears get their places: the inner gear of an internal mesh is the planet, the driving
/// gear of an external one, or the one on the axis, the sun.
void add_mesh(const Topology& t, int index, bool internal_wheel, SearchLayer& layer) {
  const TopologyMesh& mesh = t.meshes[at(index)];
  const TopologyGear& outer = t.gears[at(mesh.gear2)];
  if (outer.form == GearForm::kRing || (outer.form == GearForm::kEither && internal_wheel)) {
    layer.planet = mesh.gear1;
    layer.ring = mesh.gear2;
    layer.planet_ring = index;
  } else {
    layer.sun = mesh.gear1;
    layer.planet = mesh.gear2;
    layer.sun_planet = index;
  }
}

void add_limits(const SearchTrain& train, int number, std::vector<LimitEntry>& limits) {
  using enum Limit;
  const SearchLayer& layer = train.layers[at(number - 1)];
  const auto gear = [&](int index) { return train.topology.gears[at(index)].name; };
  const auto mesh = [&](int index) {
    return train.topology.mesh_name(train.topology.meshes[at(index)]);
  };
  const auto add = [&](Limit limit, const std::string& where,
                       const std::vector<std::string>& each = {""}) {
    for (const std::string& which : each) limits.push_back({limit, number, where, which});
  };
  const std::vector<std::string> ends{"least", "greatest"};
  const auto tips = [&](int index) {
    const TopologyMesh& m = train.topology.meshes[at(index)];
    return std::vector<std::string>{"tip of " + gear(m.gear1), "tip of " + gear(m.gear2)};
  };
  const auto roots = [&](int index) {
    const TopologyMesh& m = train.topology.meshes[at(index)];
    return std::vector<std::string>{"root of " + gear(m.gear1), "root of " + gear(m.gear2)};
  };
  const bool sun = layer.sun >= 0, ring = layer.ring >= 0;
  const std::string planet = gear(layer.planet);
  if (sun) add(kShift, gear(layer.sun), ends);
  if (ring) add(kShift, planet, ends);  // the last gear's own bounds are the optimiser's
  add(kPlanetSpacing, planet);
  if (sun) add(kTipThickness, gear(layer.sun));
  add(kTipThickness, planet);
  if (ring) add(kTipThickness, gear(layer.ring)), add(kRingTip, gear(layer.ring));
  const std::string outer = sun ? mesh(layer.sun_planet) : "",
                    inner = ring ? mesh(layer.planet_ring) : "";
  if (sun) add(kContactRatio, outer, ends);
  if (ring) add(kContactRatio, inner, ends);
  if (sun) add(kTipClearance, outer, tips(layer.sun_planet));
  if (ring) add(kTipClearance, inner, tips(layer.planet_ring)), add(kTrochoid, inner);
  const std::vector<std::string> left{"least after roots"};
  if (sun) add(kFillet, outer, roots(layer.sun_planet)), add(kContactRatio, outer, left);
  if (ring) add(kFillet, inner, roots(layer.planet_ring)), add(kContactRatio, inner, left);
}

SearchTrain search_train(Topology topology, std::string output, std::string input,
                         bool internal_wheel) {
  for (int g = static_cast<int>(topology.gears.size()) - 1; g >= 0; --g)
    if (topology.gears[at(g)].optional) topology = without_gear(topology, g);
  SearchTrain train{.topology = std::move(topology),
                    .output = std::move(output),
                    .input = std::move(input),
                    .internal_wheel = internal_wheel};
  const Topology& t = train.topology;
  for (std::size_t k = 0; k < t.meshes.size(); ++k) {
    const auto number = at(t.gears[at(t.meshes[k].gear1)].layer);
    if (train.layers.size() < number) train.layers.resize(number);
    add_mesh(t, static_cast<int>(k), internal_wheel, train.layers[number - 1]);
  }
  for (std::size_t l = 0; l < train.layers.size(); ++l) {
    add_limits(train, static_cast<int>(l) + 1, train.limits);
    if (l == 0) train.layer1_limits = train.limits.size();
  }
  TRUEFLANK_EXPECTS(train.layers.size() <= 2 && train.limits.size() <= kLimits);
  return train;
}

std::vector<SearchTrain> all_trains() {
  std::vector<SearchTrain> trains;
  for (const TrainKind& kind : train_kinds())
    for (const std::string& input : kind.inputs)
      for (const std::string& output : kind.outputs) {
        Topology topology = kind.topology(output, input);
        if (topology.meshes.empty()) continue;
        if (topology.stage_count() > 1) {
          for (StageTopology& stage : stage_topologies(topology)) {
            const int number = trains.empty() ? 1 : trains.back().stage + 1;
            trains.push_back(search_train(std::move(stage.topology), output, input, false));
            trains.back().stage = number;
          }
          continue;
        }
        const bool either =
            std::any_of(topology.gears.begin(), topology.gears.end(),
                        [](const TopologyGear& g) { return g.form == GearForm::kEither; });
        trains.push_back(search_train(topology, output, input, false));
        if (either) trains.push_back(search_train(std::move(topology), output, input, true));
      }
  return trains;
}

/// A speed against the carrier, per that of the planet body, as a fraction.
struct Fraction {
  long long over = 0, under = 1;
};

}  // namespace

const char* to_text(Limit limit) {
  switch (limit) {
    case Limit::kShift:
      return "shift";
    case Limit::kContactRatio:
      return "contact_ratio";
    case Limit::kFillet:
      return "fillet_interference";
    case Limit::kTipClearance:
      return "tip_clearance";
    case Limit::kTrochoid:
      return "trochoid_interference";
    case Limit::kTipThickness:
      return "tip_thickness";
    case Limit::kPlanetSpacing:
      return "planet_spacing";
    case Limit::kRingTip:
      return "ring_tip";
  }
  return "";
}

TrainPlace SearchTrain::place_of(int gear) const {
  for (std::size_t l = 0; l < layers.size(); ++l) {
    if (layers[l].sun == gear && l == 0) return TrainPlace::kSun;
    if (layers[l].planet == gear) return l == 0 ? TrainPlace::kPlanet1 : TrainPlace::kPlanet2;
    if (layers[l].ring == gear) return l == 0 ? TrainPlace::kRing1 : TrainPlace::kRing2;
  }
  TRUEFLANK_EXPECTS(false);
  return TrainPlace::kSun;
}

std::vector<TrainPlace> SearchTrain::places() const {
  std::vector<TrainPlace> places;
  for (std::size_t g = 0; g < topology.gears.size(); ++g)
    places.push_back(place_of(static_cast<int>(g)));
  return places;
}

const std::string& SearchTrain::name_at(TrainPlace place) const {
  std::size_t g = 0;
  while (place_of(static_cast<int>(g)) != place) ++g;
  return topology.gears[g].name;
}

double SearchTrain::signed_ratio(const ToothNumbers& z) const {
  const auto teeth = [&](int gear) {
    return static_cast<long long>(z[static_cast<std::size_t>(place_of(gear))]);
  };
  const SearchLayer& first = layers.front();
  if (!has_planets()) {  // a pair
    const bool external = first.sun >= 0;
    const double ratio = static_cast<double>(teeth(external ? first.planet : first.ring)) /
                         static_cast<double>(teeth(external ? first.sun : first.planet));
    return external ? -ratio : ratio;
  }
  const auto speed = [&](int member) {
    if (topology.is_carrier(member)) return Fraction{};
    for (const SearchLayer& layer : layers) {
      if (layer.sun >= 0 && topology.gears[at(layer.sun)].member == member)
        return Fraction{-teeth(layer.planet), teeth(layer.sun)};
      if (layer.ring >= 0 && topology.gears[at(layer.ring)].member == member)
        return Fraction{teeth(layer.planet), teeth(layer.ring)};
    }
    return Fraction{};
  };
  const Fraction in = speed(topology.input), out = speed(topology.output),
                 held = speed(topology.fixed.front());
  const long long driven = out.over * held.under - held.over * out.under;
  if (driven == 0) return std::numeric_limits<double>::infinity();
  return static_cast<double>((in.over * held.under - held.over * in.under) * out.under) /
         static_cast<double>(driven * in.under);
}

bool SearchTrain::accepts_planets(const ToothNumbers& z, int planets) const {
  const SearchLayer& layer = layers.front();
  if (!has_planets() || layer.sun < 0 || layer.ring < 0) return true;
  return (z[static_cast<std::size_t>(TrainPlace::kSun)] +
          z[static_cast<std::size_t>(TrainPlace::kRing1)]) %
             planets ==
         0;
}

bool SearchTrain::planets_are_identical(const ToothNumbers& z, int planets) const {
  if (!has_planets() || layers.size() < 2) return true;
  const auto teeth = [&](TrainPlace place) {
    return static_cast<long long>(z[static_cast<std::size_t>(place)]);
  };
  // a gear about the axis turns a body by its teeth a turn of its own: a sun against a ring
  const long long central1 =
      layers[0].ring >= 0 ? teeth(TrainPlace::kRing1) : -teeth(TrainPlace::kSun);
  const long long planet1 = teeth(TrainPlace::kPlanet1), planet2 = teeth(TrainPlace::kPlanet2);
  const long long difference = central1 * planet2 - teeth(TrainPlace::kRing2) * planet1;
  return difference % (planets * std::gcd(planet1, planet2)) == 0;
}

const std::vector<SearchTrain>& search_trains() {
  static const std::vector<SearchTrain> kTrains = all_trains();
  return kTrains;
}

const SearchTrain& usual_search_train(const std::string& kind) {
  const auto& trains = search_trains();
  const auto it = std::find_if(trains.begin(), trains.end(),
                               [&](const SearchTrain& train) { return train.kind() == kind; });
  TRUEFLANK_EXPECTS(it != trains.end());
  return *it;
}

std::string searched_kind_names() {
  std::string names;
  const SearchTrain* last = nullptr;
  for (const SearchTrain& train : search_trains()) {
    if (!last || last->kind() != train.kind()) names += (names.empty() ? "" : ", ") + train.kind();
    last = &train;
  }
  return names;
}

}  // namespace trueflank

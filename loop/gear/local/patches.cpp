// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/local/patches.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <tuple>
#include <unordered_map>

#include "trueflank/base/threads.h"
#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/mixed_bits.h"
#include "trueflank/loop/discovery/order_statistics.h"
#include "trueflank/loop/gear/local/loud_places.h"
#include "trueflank/loop/gear/local/neighbour_variance.h"
#include "trueflank/loop/gear/table/rows_by_class.h"

namespace trueflank::loop {
namespace {

constexpr int kMostPatches = 24000, kFewestUnits = 24;  // below that, units are cut into parts

bool is_trace(ObservationKind kind) {
  return kind == ObservationKind::kProfile || kind == ObservationKind::kHelix;
}
bool is_single(ObservationKind kind) {
  return kind == ObservationKind::kIndex || kind == ObservationKind::kRadial ||
         kind == ObservationKind::kSize;
}

/// Numbers 0 ... n-1 in an order that no wave follows; the same every time.
std::vector<int> shuffled(int n) {
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  std::mt19937_64 random(20260102);
  for (int i = n - 1; i > 0; --i) std::swap(order[i], order[random() % (i + 1)]);
  return order;
}

class PatchMaker {
 public:
  PatchMaker(const FlankGeometry& geometry, const Observations& table,
             const std::vector<float>* left_um)
      : geometry_(geometry), table_(table), left_um_(left_um) {
    const int per_height = 2 * geometry.teeth() * kProfileParts;
    face_parts_ = std::clamp(kMostPatches / per_height, 8, 20);
  }

  Patches make() {
    gather();
    number_units();
    assign_folds();
    weigh();
    return std::move(result_);
  }

 private:
  static constexpr int kProfileParts = 12, kTraceParts = 40;
  static constexpr int kFinerParts = 8;  // of the lowest millimetre
  static constexpr double kOfCircles = 0.4;  // of the face
  using Key = std::array<int, 7>;        // kind, source, zero, tooth, side, profile part, face part
  struct HashOfKey {
    std::size_t operator()(const Key& key) const {
      std::size_t hash = 0;
      for (const int part : key)
        hash = (hash ^ static_cast<std::size_t>(part)) * 0x9E3779B97F4A7C15U;
      return hash ^ (hash >> 32U);
    }
  };

  /// Height band; the lowest millimetre is cut finer, because first layers are.
  [[nodiscard]] int face_part(double z) const {
    const int part = part_of(geometry_.face_coordinate(z), face_parts_);
    if (z >= 1.0) return part + kFinerParts;
    return std::min(part, static_cast<int>(std::max(0.0, z) * kFinerParts));
  }

  [[nodiscard]] Key key_of(const Observation& row, int number) const {
    const Place& place = table_.place(row);
    Key key{static_cast<int>(row.kind), row.source, row.trace, place.tooth, place.side, 0, 0};
    if (is_single(row.kind))
      key[5] = number;
    else if (row.kind == ObservationKind::kProfile)
      key[5] = part_of(geometry_.profile_coordinate(place.roll_mm), kTraceParts), key[6] = row.line;
    else if (row.kind == ObservationKind::kHelix)
      key[5] = row.line, key[6] = part_of(geometry_.face_coordinate(place.z_mm), kTraceParts);
    else if (row.kind == ObservationKind::kScanFlank) {
      key[5] = part_of(geometry_.profile_coordinate(place.roll_mm), kProfileParts);
      key[6] = face_part(place.z_mm);
    } else if (row.kind == ObservationKind::kScanBore) {
      key[3] = static_cast<int>(wrapped_rad(place.polar_rad) / kTwoPi * 16) + 1;
      key[6] = part_of(geometry_.face_coordinate(place.z_mm), 4);
    } else {  // tips and roots: a step over the face leaves some of them whole
      key[6] = part_of(geometry_.face_coordinate(place.z_mm) / kOfCircles, 4);
    }
    return key;
  }

  /// How many there can be of one source.
  [[nodiscard]] std::size_t patches_of_flanks() const {
    return static_cast<std::size_t>(2 * geometry_.teeth() * kProfileParts *
                                    (face_parts_ + kFinerParts));
  }
  [[nodiscard]] std::size_t place_in_list(const Key& key) const {
    const int flank = (key[1] * geometry_.teeth() + key[3] - 1) * 2 + (key[4] > 0 ? 1 : 0);
    const int in_flank = key[5] * (face_parts_ + kFinerParts) + key[6];
    return static_cast<std::size_t>(flank) *
               static_cast<std::size_t>(kProfileParts * (face_parts_ + kFinerParts)) +
           static_cast<std::size_t>(in_flank);
  }

  struct Sum {
    double weight = 0.0, value = 0.0, left = 0.0, roll = 0.0, z = 0.0, x = 0.0, y = 0.0,
           count = 0.0;
    double z_low_mm = 1e300, z_high_mm = -1e300;
    void add(const Observation& row, const Place& place, double sigma_um, double left_um) {
      const double w = std::isnan(sigma_um) ? 1.0 : 1.0 / (sigma_um * sigma_um);
      weight += w;
      value += w * row.deviation_um;
      left += w * left_um;
      roll += w * place.roll_mm;
      z += w * place.z_mm;
      x += w * place.polar_direction[0];
      y += w * place.polar_direction[1];
      count += 1.0;
      z_low_mm = std::min(z_low_mm, place.z_mm);
      z_high_mm = std::max(z_high_mm, place.z_mm);
    }
  };
  static constexpr std::size_t kMostSamples = 8;
  static constexpr int kNoPatch = -1, kByKey = -2;  // and below
  static constexpr std::size_t kRowsOfWork = 16384;

  /// What takes time for every row is done on all processors; patches get their numbers in the order
  /// of the rows.
  void gather() {
    find_places_in_lists();
    number_patches();
    sum_patches();
  }

  /// Patches of scanned flanks, nearly all there are, by their place in a list; of other rows by their
  /// key's number among those of the same piece. Into patch_of_row.
  void find_places_in_lists() {
    const std::size_t rows = table_.rows.size();
    result_.patch_of_row.assign(rows, kNoPatch);
    keys_of_pieces_.resize((rows + kRowsOfWork - 1) / kRowsOfWork);
    const double b = geometry_.face_width_mm();
    for_each_piece(keys_of_pieces_.size(), [&](std::size_t piece) {
      std::unordered_map<Key, int, HashOfKey> numbers;
      const std::size_t end = std::min(rows, (piece + 1) * kRowsOfWork);
      for (std::size_t i = piece * kRowsOfWork; i < end; ++i) {
        const Observation& row = table_.rows[i];
        const double z = table_.place(row).z_mm;
        const bool circle =
            row.kind == ObservationKind::kScanTip || row.kind == ObservationKind::kScanRoot;
        // Tip and root serve as sizes: taken where face effects are small.
        if (circle && std::abs(z - 0.5 * b) > 0.5 * kOfCircles * b) continue;
        const Key key = key_of(row, static_cast<int>(i));
        if (row.kind == ObservationKind::kScanFlank) {
          result_.patch_of_row[i] = static_cast<int>(place_in_list(key));
          continue;
        }
        std::vector<Key>& keys = keys_of_pieces_[piece];
        const auto [known, is_new] = numbers.try_emplace(key, static_cast<int>(keys.size()));
        if (is_new) keys.push_back(key);
        result_.patch_of_row[i] = kByKey - known->second;
      }
    });
  }

  void number_patches() {
    std::unordered_map<Key, int, HashOfKey> numbers;
    std::vector<int> of_flanks;
    const auto number = [&](int& known, std::size_t row) {
      if (known < 0) known = add_patch(row);
      return known;
    };
    for (std::size_t piece = 0; piece < keys_of_pieces_.size(); ++piece) {
      const std::vector<Key>& keys = keys_of_pieces_[piece];
      std::vector<int> of_keys(keys.size(), -1);
      const std::size_t end = std::min(table_.rows.size(), (piece + 1) * kRowsOfWork);
      for (std::size_t i = piece * kRowsOfWork; i < end; ++i) {
        int& patch = result_.patch_of_row[i];
        if (patch == kNoPatch) continue;
        if (patch >= 0) {
          const auto at = static_cast<std::size_t>(patch);
          if (at >= of_flanks.size()) of_flanks.resize(at + patches_of_flanks(), -1);
          patch = number(of_flanks[at], i);
        } else {
          const auto at = static_cast<std::size_t>(kByKey - patch);
          if (of_keys[at] < 0) of_keys[at] = number(numbers.try_emplace(keys[at], -1).first->second, i);
          patch = of_keys[at];
        }
      }
    }
    keys_of_pieces_ = {};
  }

  /// Its number.
  int add_patch(std::size_t first_row) {
    const Observation& row = table_.rows[first_row];
    Patches::Patch patch;
    patch.kind = row.kind;
    patch.source = row.source;
    patch.zero = row.trace;
    for (std::uint32_t k = 0; k < row.places; ++k)
      patch.places.push_back({table_.places[row.first_place + k], row.weight});
    result_.patches.push_back(std::move(patch));
    keys_.push_back(key_of(row, static_cast<int>(first_row)));
    samples_.emplace_back();
    return static_cast<int>(keys_.size()) - 1;
  }

  void sum_patches() {
    const std::size_t patches = result_.patches.size();
    constexpr std::size_t kPatchesOfWork = 256;
    const std::size_t pieces = (patches + kPatchesOfWork - 1) / kPatchesOfWork;
    const RowsByClass rows(table_.rows.size(), pieces, [&](std::size_t i) {
      const int patch = result_.patch_of_row[i];
      return patch < 0 ? -1 : patch / static_cast<int>(kPatchesOfWork);
    });
    std::vector<Sum> sums(patches);
    scatters_um_.resize(patches);
    for_each_piece(pieces, [&](std::size_t piece) {
      rows.for_each(piece, table_, [&](std::size_t i) {
        const Observation& row = table_.rows[i];
        const auto patch = static_cast<std::size_t>(result_.patch_of_row[i]);
        sums[patch].add(row, table_.place(row), table_.sigma_um(row),
                        left_um_ != nullptr ? (*left_um_)[i] : row.deviation_um);
        keep_sample(patch, i);
      });
    });
    // (by one thread: threads that ask for memory wait for each other)
    for (std::size_t k = 0; k < patches; ++k)
      result_.patches[k].sample.reserve(std::min<std::size_t>(samples_[k].count, kMostSamples));
    for_each_run(patches, kPatchesOfWork, [&](std::size_t from, std::size_t to) {
      for (std::size_t k = from; k < to; ++k) finish_patch(k, sums[k]);
    });
    samples_ = {};
  }

  void finish_patch(std::size_t number, const Sum& s) {
    Patches::Patch& patch = result_.patches[number];
    patch.mean_um = s.value / s.weight;
    scatters_um_[number] = s.left / s.weight;
    patch.count = s.count;
    patch.z_low_mm = s.z_low_mm;
    patch.z_high_mm = s.z_high_mm;
    if (is_single(patch.kind)) return;
    const Sample& sample = samples_[number];
    for (std::size_t k = 0; k < std::min<std::size_t>(sample.count, kMostSamples); ++k)
      patch.sample.push_back(table_.place(table_.rows[sample.rows[k]]));
    Place& place = patch.places.front().place;
    if (place.surface == Surface::kFlank)
      place = geometry_.on_flank(place.tooth, place.side, s.roll / s.weight, s.z / s.weight);
    else
      place = geometry_.on_circle(place.surface, place.tooth, std::atan2(s.y, s.x), place.radius_mm,
                                  s.z / s.weight);
    place.file = patch.sample.front().file;
  }

  /// Rows of a patch that are kept, and how many there were.
  struct Sample {
    std::uint32_t count = 0;
    std::array<std::uint32_t, kMostSamples> rows{};
  };

  /// Every value is as likely to be among those kept. Each patch draws by itself.
  void keep_sample(std::size_t patch, std::size_t row) {
    if (is_single(result_.patches[patch].kind)) return;
    Sample& sample = samples_[patch];
    std::uint64_t at = sample.count++;
    if (at >= kMostSamples) at = mixed_bits(sample.count, patch << 32U) % sample.count;
    if (at < kMostSamples) sample.rows[at] = static_cast<std::uint32_t>(row);
  }

  /// What may share its random error: a flank of a scan, a trace, a single value. Where there are
  /// few, they are cut across, far longer than the error hangs together.
  void number_units() {
    const auto id_of = [&](std::size_t i) {
      const Key& k = keys_[i];
      if (is_trace(result_.patches[i].kind))
        return k[2] >= 0 ? k[2] : k[3] * 2 + (k[4] > 0 ? 1 : 0);
      if (is_single(result_.patches[i].kind)) return k[5];
      return k[3] * 2 + (k[4] > 0 ? 1 : 0);
    };
    // What has one id of one kind and source is a member of these, numbered as met.
    std::unordered_map<Key, int, HashOfKey> members;
    std::map<std::pair<int, int>, int> counts;  // of kind and source
    std::vector<int> member_of(keys_.size());
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      const auto [known, is_new] = members.try_emplace({keys_[i][0], keys_[i][1], id_of(i)},
                                                       static_cast<int>(members.size()));
      member_of[i] = known->second;
      if (is_new) ++counts[{keys_[i][0], keys_[i][1]}];
    }
    constexpr int kMostParts = 6, kNone = -1;
    std::vector<std::array<int, kMostParts>> units(members.size());
    for (std::array<int, kMostParts>& parts : units) parts.fill(kNone);
    std::vector<int> wholes(members.size(), kNone);
    int whole = 0;
    for (std::size_t i = 0; i < keys_.size(); ++i) {
      Patches::Patch& patch = result_.patches[i];
      const int count = counts[{keys_[i][0], keys_[i][1]}];
      int part = 0;
      if (!is_single(patch.kind) && count < kFewestUnits) {
        const int parts =
            std::min((kFewestUnits + count - 1) / count, is_trace(patch.kind) ? kMostParts : 4);
        const Place& place = patch.places.front().place;
        part = patch.kind == ObservationKind::kProfile
                   ? part_of(geometry_.profile_coordinate(place.roll_mm), parts)
                   : part_of(geometry_.face_coordinate(place.z_mm), parts);
      }
      const auto member = static_cast<std::size_t>(member_of[i]);
      int& unit = units[member][static_cast<std::size_t>(part)];
      if (unit == kNone) unit = result_.units++;
      patch.unit = unit;
      if (!is_trace(patch.kind) && patch.kind != ObservationKind::kScanFlank) continue;
      if (wholes[member] == kNone) wholes[member] = whole++;
      patch.whole = wholes[member];
    }
  }

  void assign_folds() {
    // Traces are often of three or four teeth, an index of all: each is shared out by itself, so
    // that the lock does not take most of the traces.
    std::set<int> trace_teeth, single_teeth;
    std::set<int> traces;
    for (const auto& patch : result_.patches) {
      const int tooth = patch.places.front().place.tooth;
      if (is_trace(patch.kind)) {
        trace_teeth.insert(tooth);
        traces.insert(patch.whole);
      } else if (patch.kind == ObservationKind::kIndex || patch.kind == ObservationKind::kRadial) {
        single_teeth.insert(tooth);
      }
    }
    const std::vector<int> order = shuffled(geometry_.teeth());
    // Rank of each measured tooth in shuffled order: folds of equal size whatever was measured.
    const auto ranks_of = [&](const std::set<int>& teeth) {
      std::map<int, int> rank;
      for (const int number : order)
        if (teeth.contains(number + 1)) rank.emplace(number + 1, static_cast<int>(rank.size()));
      return rank;
    };
    const std::map<int, int> trace_rank = ranks_of(trace_teeth),
                             single_rank = ranks_of(single_teeth);
    const auto fold_of_class = [](int c) { return c == 0 || c == 5 ? 0 : c < 5 ? c : c - 1; };
    int single = 0;
    for (std::size_t i = 0; i < result_.patches.size(); ++i) {
      Patches::Patch& patch = result_.patches[i];
      const Place& place = patch.places.front().place;
      if (patch.kind == ObservationKind::kScanFlank) {
        const int band = part_of(geometry_.face_coordinate(place.z_mm), 5);
        patch.fold = fold_of_class((order[place.tooth - 1] + 2 * band) % 10);
      } else if (is_trace(patch.kind) || patch.kind == ObservationKind::kIndex ||
                 patch.kind == ObservationKind::kRadial) {
        const auto& rank = is_trace(patch.kind) ? trace_rank : single_rank;
        if (rank.size() >= 10)
          patch.fold = fold_of_class(rank.at(place.tooth) % 10);
        else if (rank.size() >= 5)
          patch.fold = rank.at(place.tooth) % 5;
        else if (!is_trace(patch.kind))
          patch.fold = 1 + keys_[i][5] % 4;
        else if (traces.size() >= 5)
          patch.fold = patch.whole % 5;
        else
          patch.fold = 1 + patch.whole % 4;
        patch.fold = std::max(0, patch.fold);
      } else if (patch.kind == ObservationKind::kScanBore) {
        patch.fold = 1 + single++ % kFolds;
      } else {
        patch.fold = kAnchorFold;
      }
    }
  }

  /// Variances of the patch means of one kind and source: of all, and of those of either side.
  struct Variances {
    double all = 0.0;
    std::array<double, 2> of_side{};
  };

  /// From neighbours: effects hardly change between them. A probe may be noisier on one side: where
  /// that is more than chance the sides have variances of their own.
  [[nodiscard]] Variances variances_of(ObservationKind kind, const std::vector<int>& members) const {
    std::vector<double> squares;
    std::array<std::vector<double>, 2> of_side;
    if (is_single(kind)) return {};
    // Patches of scanned flanks by their place in a list, others through a hash.
    const bool listed = kind == ObservationKind::kScanFlank;
    constexpr int kNone = -1;
    std::vector<int> in_list;
    std::unordered_map<Key, int, HashOfKey> at;
    for (const int i : members) {
      if (!listed) {
        at[keys_[i]] = i;
        continue;
      }
      const std::size_t place = place_in_list(keys_[i]);
      if (place >= in_list.size()) in_list.resize(place + patches_of_flanks(), kNone);
      in_list[place] = i;
    }
    const auto patch_at = [&](const Key& key) {
      if (!listed) {
        const auto found = at.find(key);
        return found == at.end() ? kNone : found->second;
      }
      if (key[5] < 0 || key[5] >= kProfileParts) return kNone;
      const std::size_t place = place_in_list(key);
      return place < in_list.size() ? in_list[place] : kNone;
    };
    const int axis = kind == ObservationKind::kHelix || kind == ObservationKind::kScanBore      ? 6
                     : kind == ObservationKind::kProfile || kind == ObservationKind::kScanFlank ? 5
                                                                                                : 3;
    for (const int i : members) {
      Key right = keys_[i], left = keys_[i];
      ++right[axis];
      --left[axis];
      const int r = patch_at(right), l = patch_at(left);
      if (r == kNone || l == kNone) continue;
      const double d = scatters_um_[l] - 2.0 * scatters_um_[i] + scatters_um_[r];
      const double times = loud_square(l) + 4.0 * loud_square(i) + loud_square(r);
      squares.push_back(d * d / times);
      of_side[keys_[i][4] > 0 ? 1 : 0].push_back(d * d / times);
    }
    constexpr std::size_t kFewOf = 4;
    if (is_trace(kind) && squares.size() * kFewOf < members.size()) {
      std::map<Key, std::vector<OnTrace>> traces;
      for (const int i : members) {
        Key trace = keys_[i];
        trace[axis] = 0;
        const Place& place = result_.patches[i].places.front().place;
        traces[trace].push_back(
            {axis == 6 ? place.z_mm : place.roll_mm, scatters_um_[i], loud_square(i)});
      }
      squares.clear();
      of_side = {};
      for (auto& [trace, values] : traces)
        for (const double square : squares_beside_lines(std::move(values))) {
          squares.push_back(square);
          of_side[trace[4] > 0 ? 1 : 0].push_back(square);
        }
    }
    const std::array<std::size_t, 2> counts{of_side[0].size(), of_side[1].size()};
    Variances result{robust_variance(squares), {robust_variance(of_side[0]), robust_variance(of_side[1])}};
    if (!are_apart(result.of_side, counts)) result.of_side = {result.all, result.all};
    return result;
  }

  /// Of values one a tooth: second differences around the gear, each flank apart, but no more than
  /// the values scatter: where every other tooth differs, neighbours are no neighbourhood.
  [[nodiscard]] double variance_around(const std::vector<int>& members) const {
    std::map<std::pair<int, int>, int> at;
    for (const int i : members) at[{keys_[i][4], keys_[i][3]}] = i;
    std::vector<double> squares;
    for (const auto& [key, i] : at) {
      const auto l = at.find({key.first, key.second - 1}), r = at.find({key.first, key.second + 1});
      if (l == at.end() || r == at.end()) continue;
      const double d = scatters_um_[l->second] - 2.0 * scatters_um_[i] + scatters_um_[r->second];
      squares.push_back(d * d / 6.0);
    }
    std::map<int, std::array<double, 3>> sums;  // of a flank: count, sum, squares
    for (const auto& [key, i] : at) {
      const double um = scatters_um_[i];
      auto& [count, sum, square] = sums[key.first];
      count += 1.0;
      sum += um;
      square += um * um;
    }
    double scatter = 0.0, degrees = 0.0;
    for (const auto& [flank, s] : sums) {
      scatter += s[2] - s[1] * s[1] / s[0];
      degrees += s[0] - 1.0;
    }
    const double by_differences = robust_variance(squares);
    constexpr double kEnough = 8.0;
    return degrees < kEnough ? by_differences : std::min(by_differences, scatter / degrees);
  }

  [[nodiscard]] double loud_square(int patch) const {
    const double loud = result_.patches[patch].loud;
    return loud * loud;
  }

  template <class OwnOf>
  void tell_loud_places(const std::vector<int>& members, const OwnOf& own_of) {
    std::vector<FlankPart> parts;
    parts.reserve(members.size());
    for (const int i : members) {
      const Key& key = keys_[i];
      const Patches::Patch& patch = result_.patches[i];
      parts.push_back(
          {key[3], key[4] > 0 ? 1U : 0U, key[5], key[6], scatters_um_[i], own_of(patch)});
    }
    LoudPlaces loud = loud_places(parts);
    for (std::size_t k = 0; k < members.size(); ++k)
      result_.patches[members[k]].loud = loud.factors[k];
    const int source = result_.patches[members.front()].source;
    for (const LoudPlace& place : loud.places) tell_louder(place, source);
    result_.flank_scatters.emplace_back(source, std::move(loud.flanks));
  }

  void tell_louder(const LoudPlace& place, int source) {
    const bool flank = place.of == LoudPlace::Of::kFlank;
    LouderPlace told{.source = source,
                     .flank = (place.side > 0) == (geometry_.sense() > 0.0) ? FlankChoice::kLeft
                                                                            : FlankChoice::kRight,
                     .tooth = flank ? place.first : 0,
                     .over_face = place.of == LoudPlace::Of::kFace,
                     .times = place.times,
                     .p_value = place.p_value};
    if (!flank) {
      const double low = told.over_face ? low_of_face_part(place.first)
                                        : diameter_at_part(place.first),
                   high = told.over_face ? low_of_face_part(place.last + 1)
                                         : diameter_at_part(place.last + 1);
      std::tie(told.low_mm, told.high_mm) = std::minmax(low, high);
      told.share = told.over_face ? (told.high_mm - told.low_mm) / geometry_.face_width_mm()
                                  : (place.last + 1.0 - place.first) / kProfileParts;
    }
    add_louder(result_.louder, told);
  }
  [[nodiscard]] double low_of_face_part(int part) const {
    const double b = geometry_.face_width_mm();
    if (part < kFinerParts) return std::min(b, static_cast<double>(part) / kFinerParts);
    return std::clamp(b * (part - kFinerParts) / face_parts_, 0.0, b);
  }
  [[nodiscard]] double diameter_at_part(int part) const {
    const double low = geometry_.root_form_roll_mm(), high = geometry_.tip_form_roll_mm();
    return 2.0 * geometry_.on_flank(1, 1, low + (high - low) * part / kProfileParts, 0.0).radius_mm;
  }

  void weigh() {
    std::map<std::pair<int, int>, std::vector<int>> classes;
    for (std::size_t i = 0; i < keys_.size(); ++i)
      classes[{keys_[i][0], keys_[i][1]}].push_back(static_cast<int>(i));
    for (const auto& [key, members] : classes) {
      const auto kind = static_cast<ObservationKind>(key.first);
      double mean_count = 0.0;
      for (const int i : members)
        mean_count += result_.patches[i].count / static_cast<double>(members.size());
      const auto own_of = [&](const Patches::Patch& patch) {
        return is_single(kind) ? 1.0 : 2.0 * patch.count / (patch.count + mean_count);
      };
      if (kind == ObservationKind::kScanFlank) tell_loud_places(members, own_of);
      Variances variances = variances_of(kind, members);
      if (kind == ObservationKind::kIndex || kind == ObservationKind::kRadial)
        variances.of_side.fill(variance_around(members));
      // Tip and root circles are turned, not cut with the teeth: trusted to a few um only.
      for (double& variance : variances.of_side) {
        if (kind == ObservationKind::kScanTip || kind == ObservationKind::kScanRoot)
          variance = std::max(variances.all, 1.0) * static_cast<double>(members.size()) / 8.0;
        if (!(variance > 1e-6)) variance = 1e-6;
      }
      for (const int i : members) {
        Patches::Patch& patch = result_.patches[i];
        const double variance = variances.of_side[keys_[i][4] > 0 ? 1 : 0];
        patch.weight = own_of(patch) / (variance * loud_square(i));
      }
    }
    // Single values say their own error; sizes have no neighbours to ask.
    if (std::none_of(classes.begin(), classes.end(), [](const auto& one) {
          return is_single(static_cast<ObservationKind>(one.first.first));
        }))
      return;
    for (std::size_t row = 0; row < table_.rows.size(); ++row) {
      const Observation& observation = table_.rows[row];
      if (!is_single(observation.kind)) continue;
      Patches::Patch& patch = result_.patches[result_.patch_of_row[row]];
      const double sigma = observation.kind == ObservationKind::kSize
                               ? table_.size_sigma_um(observation)
                               : table_.sigma_um(observation);
      if (!std::isnan(sigma)) patch.weight = 1.0 / (sigma * sigma);
    }
  }

  const FlankGeometry& geometry_;
  const Observations& table_;
  const std::vector<float>* left_um_;  ///< of rows; nullptr: as they deviate
  std::vector<double> scatters_um_;    ///< means over patches of what tells how they scatter
  int face_parts_ = 8;
  std::vector<Key> keys_;
  std::vector<std::vector<Key>> keys_of_pieces_;  ///< of rows: keys in no list, as they come
  std::vector<Sample> samples_;
  Patches result_;
};

}  // namespace

Patches make_patches(const FlankGeometry& geometry, const Observations& table,
                     const std::vector<float>* left_um) {
  return PatchMaker(geometry, table, left_um).make();
}

}  // namespace trueflank::loop

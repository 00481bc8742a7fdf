// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/rougher_members.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/discovery/order_statistics.h"

namespace trueflank::loop {
namespace {

constexpr std::size_t kFewestMembers = 8;
constexpr double kLeastTimes = 2.0;
/// Variance of the logarithm of a median of sizes, times their number: as in loudness_of.
constexpr double kByChance = 2.5;

/// The mean logarithm of what one member's courses scatter, less what is usual in their set.
struct Member {
  int number = 0;
  double log = 0.0, chance = 0.0;  ///< the latter its variance by chance
};

/// Of one set, or of both where it is -1.
std::vector<Member> members_of(const std::vector<MemberScatter>& all, int set, double& usual) {
  std::array<std::vector<double>, 2> logs;
  for (const MemberScatter& one : all)
    if (one.scatter > 0.0 && one.values > 0.0 && (set < 0 || one.set == set))
      logs[static_cast<std::size_t>(one.set)].push_back(std::log(one.scatter));
  std::array<double, 2> middle{};
  double sum = 0.0, sets = 0.0;
  for (std::size_t s = 0; s < logs.size(); ++s) {
    if (logs[s].empty()) continue;
    middle[s] = median(std::move(logs[s]));
    sum += middle[s];
    sets += 1.0;
  }
  usual = sets > 0.0 ? std::exp(sum / sets) : 0.0;
  struct Sums {
    double log = 0.0, chance = 0.0, count = 0.0;
  };
  std::map<int, Sums> of_number;
  for (const MemberScatter& one : all) {
    if (!(one.scatter > 0.0 && one.values > 0.0 && (set < 0 || one.set == set))) continue;
    Sums& sums = of_number[one.number];
    sums.log += std::log(one.scatter) - middle[static_cast<std::size_t>(one.set)];
    sums.chance += kByChance / one.values;
    sums.count += 1.0;
  }
  std::vector<Member> members;
  for (const auto& [number, sums] : of_number)
    members.push_back({number, sums.log / sums.count, sums.chance / (sums.count * sums.count)});
  return members;
}

double mean_chance(const std::vector<Member>& members) {
  double sum = 0.0;
  for (const Member& member : members) sum += member.chance;
  return sum / static_cast<double>(members.size());
}

/// A straight line of the logarithms over the numbers.
RougherMembers growth_of(const std::vector<Member>& members) {
  const auto n = static_cast<double>(members.size());
  double mean = 0.0, middle = 0.0;
  for (const Member& member : members) {
    mean += member.log / n;
    middle += member.number / n;
  }
  double product = 0.0, square = 0.0;
  for (const Member& member : members) {
    product += (member.number - middle) * (member.log - mean);
    square += (member.number - middle) * (member.number - middle);
  }
  const double slope = product / square;
  double left = 0.0;
  for (const Member& member : members) {
    const double off = member.log - mean - slope * (member.number - middle);
    left += off * off;
  }
  const double variance = std::max(left / (n - 2.0), mean_chance(members));
  const int low = members.front().number, high = members.back().number;
  RougherMembers found{.grows = true, .first = low, .last = high};
  if (slope < 0.0) std::swap(found.first, found.last);
  found.times = std::exp(std::abs(slope) * (high - low));
  found.inside = std::exp(mean + slope * (found.last - middle));
  found.p_value = student_two_sided(slope * std::sqrt(square / variance), n - 2.0);
  return found;
}

/// The run of neighbours of which the two means are surest; `looks`: how many were asked.
RougherMembers run_of(const std::vector<Member>& members, double& looks) {
  const std::size_t count = members.size();
  const auto n = static_cast<double>(count);
  double all = 0.0, squares = 0.0;
  for (const Member& member : members) {
    all += member.log;
    squares += member.log * member.log;
  }
  const double chance = mean_chance(members);
  RougherMembers surest;
  for (std::size_t first = 0; first < count; ++first) {
    double inside = members[first].log;
    for (std::size_t length = 2; 3 * length <= count; ++length) {
      inside += members[(first + length - 1) % count].log;
      looks += 1.0;
      const auto in = static_cast<double>(length), out = n - in;
      const double mean_in = inside / in, mean_out = (all - inside) / out;
      const double apart = mean_in - mean_out;
      if (apart < std::log(kLeastTimes)) continue;
      const double left = squares - in * mean_in * mean_in - out * mean_out * mean_out;
      const double variance = std::max(left / (n - 2.0), chance);
      const double p =
          0.5 * student_two_sided(apart / std::sqrt(variance * (1.0 / in + 1.0 / out)), n - 2.0);
      if (p >= surest.p_value) continue;
      surest.p_value = p;
      surest.first = members[first].number;
      surest.last = members[(first + length - 1) % count].number;
      surest.times = std::exp(apart);
      surest.inside = std::exp(mean_in);
    }
  }
  return surest;
}

}  // namespace

bool are_asked(const std::vector<MemberScatter>& members) {
  double usual = 0.0;
  return members_of(members, -1, usual).size() >= kFewestMembers;
}

std::optional<RougherMembers> rougher_members(const std::vector<MemberScatter>& members) {
  std::optional<RougherMembers> surest;
  double sets = 0.0;
  for (const int set : {-1, 0, 1}) {
    double usual = 0.0;
    const std::vector<Member> own = members_of(members, set, usual);
    if (own.size() < kFewestMembers) continue;
    sets += 1.0;
    double looks = 0.0;
    RougherMembers growth = growth_of(own), run = run_of(own, looks);
    run.p_value = std::min(1.0, looks * run.p_value);
    for (RougherMembers* found : {&growth, &run}) {
      if (found->times < kLeastTimes || (surest && found->p_value >= surest->p_value)) continue;
      surest = *found;
      surest->set = set;
      surest->inside *= usual;
    }
  }
  if (surest) surest->p_value = std::min(1.0, 2.0 * sets * surest->p_value);
  return surest;
}

}  // namespace trueflank::loop

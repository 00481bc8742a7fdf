// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/measure_next.h"

#include <algorithm>
#include <array>
#include <string_view>

#include "trueflank/loop/gear/effect.h"
#include "trueflank/loop/result/describe.h"

namespace trueflank::loop {
namespace {

/// What a table has, as measurements are named.
struct Measured {
  struct Sides {
    bool clockwise = false, counter_clockwise = false;
    [[nodiscard]] bool both() const { return clockwise && counter_clockwise; }
  };
  Sides index, profile, helix, flanks;  ///< flanks: followed by a trace or a scan, or indexed
  bool radial = false, scan = false, common_zero = false;
  bool tip_or_root = false, bore = false, thickness = false;
};

Measured measured_in(const Observations& table) {
  Measured measured;
  const auto add = [](Measured::Sides& sides, const Place& place) {
    (place.side > 0 ? sides.counter_clockwise : sides.clockwise) = true;
  };
  for (const Observation& row : table.rows) {
    const Place& place = table.place(row);
    switch (row.kind) {
      case ObservationKind::kIndex:
        add(measured.index, place);
        break;
      case ObservationKind::kProfile:
        add(measured.profile, place);
        measured.common_zero = measured.common_zero || row.trace < 0;
        break;
      case ObservationKind::kHelix:
        add(measured.helix, place);
        break;
      case ObservationKind::kScanFlank:
        measured.scan = true;
        break;
      case ObservationKind::kRadial:
        measured.radial = true;
        continue;
      default:
        measured.tip_or_root = measured.tip_or_root || place.surface == Surface::kTip ||
                               place.surface == Surface::kRoot;
        measured.bore = measured.bore || place.surface == Surface::kBore;
        measured.thickness = measured.thickness || (row.kind == ObservationKind::kSize &&
                                                    place.surface == Surface::kFlank);
        continue;
    }
    add(measured.flanks, place);
  }
  return measured;
}

constexpr const char* kMoreRecords =
    "the same gear in more records: both flanks, profile, helix, index and sizes";

/// A measurement, as the effects name it, whose parts each would tell: of those measured already
/// nothing is to be had.
struct OneOf {
  std::string_view words;
  bool (*is_measured)(const Measured&);
};

const std::vector<std::pair<std::string_view, std::vector<OneOf>>>& measurements_in_parts() {
  const auto index = [](const Measured& m) { return m.index.both(); };
  const auto radial = [](const Measured& m) { return m.radial; };
  const auto both = [](const Measured& m) { return m.flanks.both(); };
  const auto bore = [](const Measured& m) { return m.bore; };
  const auto tip = [](const Measured& m) { return m.tip_or_root || m.bore; };
  static const std::vector<std::pair<std::string_view, std::vector<OneOf>>> all{
      {"the index of the other flank too, or the radial runout",
       {{"the index of the other flank too", index}, {"the radial runout", radial}}},
      {"both flanks, or the radial runout",
       {{"the index of both flanks", both}, {"the radial runout", radial}}},
      {"the index of both flanks", {{"the index of both flanks", index}}},
      {"index of all teeth",
       {{"index of all teeth",
         [](const Measured& m) { return m.index.clockwise || m.index.counter_clockwise; }}}},
      {"both flanks: the tangential part; a circular bore",
       {{"both flanks: the tangential part", both}, {"a circular bore", bore}}},
      {"helix traces of both flanks",
       {{"helix traces of both flanks",
         [](const Measured& m) { return m.helix.both() || (m.scan && m.flanks.both()); }}}},
      {"the unworn (coast) flank", {{"the unworn (coast) flank", both}}},
      {"tip, root or bore diameter: an offset moves all walls",
       {{"tip, root or bore diameter: an offset moves all walls", tip}}},
      {"tip, root or bore diameter, or profile traces with a common zero",
       {{"tip, root or bore diameter", tip},
        {"profile traces with a common zero",
         [](const Measured& m) { return m.common_zero || m.scan; }}}},
      {kMoreRecords,
       {{"profile", [](const Measured& m) { return m.scan || m.profile.both(); }},
        {"helix", [](const Measured& m) { return m.scan || m.helix.both(); }},
        {"index", [](const Measured& m) { return m.scan || m.index.both(); }},
        {"sizes", [](const Measured& m) { return m.thickness && m.tip_or_root; }}}},
  };
  return all;
}

/// A measurement without those of its parts that were made; where all were, the same once more.
std::string not_yet_measured(const std::string& measurement, const Measured& measured) {
  const auto& known = measurements_in_parts();
  const auto of = std::find_if(known.begin(), known.end(),
                               [&](const auto& one) { return one.first == measurement; });
  if (of == known.end()) return measurement;
  std::vector<std::string_view> parts;
  for (const OneOf& part : of->second)
    if (!part.is_measured(measured)) parts.push_back(part.words);
  if (parts.size() == of->second.size()) return measurement;
  if (parts.empty()) return "what was measured again, several times over, for a smaller error";
  const bool records = measurement == kMoreRecords;
  std::string words = records ? "the same gear in more records: " : "";
  for (std::size_t k = 0; k < parts.size(); ++k) {
    if (k > 0) words += k + 1 < parts.size() ? ", " : records ? " and " : ", or ";
    words += parts[k];
  }
  return words;
}

/// What would show an effect that these data cannot: said where everything that it would show is
/// hidden.
void say_what_is_hidden(const std::vector<std::string>& not_observable,
                        std::vector<std::string>& sentences) {
  const auto hidden = [&](const EffectFamily& family) {
    return std::find(not_observable.begin(), not_observable.end(), family.id) !=
           not_observable.end();
  };
  const auto& library = effect_library();
  for (const EffectFamily& family : library) {
    if (family.shown_by.empty()) continue;
    const bool all = std::all_of(library.begin(), library.end(), [&](const EffectFamily& other) {
      return other.shown_by != family.shown_by || hidden(other);
    });
    if (all) say_once(sentences, family.shown_by);
  }
}

}  // namespace

std::vector<std::string> measurements_that_separate(const std::vector<FoundEffect>& effects,
                                                    const std::vector<std::string>& not_observable,
                                                    const Observations& table) {
  const Measured measured = measured_in(table);
  std::vector<std::string> sentences;
  ToldApart told;
  for (const FoundEffect& found : effects)
    for (const std::string& other : found.confounded_with)
      told.add(found.id, other,
               not_yet_measured(measurement_between(found.id, find_family(found.id), other,
                                                    find_family(other), kMoreRecords),
                                measured));
  told.say(sentences, "measure");
  for (const FoundEffect& found : effects)
    if (!found.measure_again.empty()) say_once(sentences, "measure " + found.measure_again);
  for (const FoundEffect& found : effects)
    if (const EffectFamily* family = find_family(found.id);
        family && !family->causes_told_by.empty())
      say_once(sentences, found.id + ": " + family->causes_told_by);
  if (std::any_of(effects.begin(), effects.end(),
                  [](const FoundEffect& found) { return found.by_process.size() > 1; }))
    say_once(sentences,
             "how the part was made decides between the causes: say it ([made] process in the "
             "design, or a "
             "line \"# process = grinding\" in the data)");
  const bool one_part = std::any_of(effects.begin(), effects.end(), [](const FoundEffect& found) {
    return found.correctable && !found.repeatable;
  });
  if (one_part)
    say_once(sentences,
             "one part cannot show what repeats; measure a second part of the process before "
             "correcting it");
  say_what_is_hidden(not_observable, sentences);
  return sentences;
}

}  // namespace trueflank::loop

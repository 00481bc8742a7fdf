// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/making.h"

#include <algorithm>
#include <array>
#include <bit>

#include "trueflank/base/ascii_letters.h"
#include "trueflank/loop/measured/text_table.h"

namespace trueflank::loop {
namespace {

struct Word {
  std::string_view part_of_name;
  Makings makings;
};

/// The first that a name holds decides: "hard-skiving-grinding" is ground.
constexpr std::array kWords{
    Word{"grind", kGrinding},      Word{"ground", kGrinding},     Word{"honing", kGrinding},
    Word{"hob", kHobbing},         Word{"skiv", kShaping},        Word{"shap", kShaping},
    Word{"broach", kShaping},      Word{"wire", kWireCutting},    Word{"edm", kWireCutting},
    Word{"erosion", kWireCutting}, Word{"laser-sinter", kPowder}, Word{"laser", kBeamCutting},
    Word{"water", kBeamCutting},   Word{"plasma", kBeamCutting},  Word{"fdm", kExtrusion},
    Word{"fff", kExtrusion},       Word{"sla", kResin},           Word{"dlp", kResin},
    Word{"resin", kResin},         Word{"sls", kPowder},          Word{"slm", kPowder},
    Word{"mjf", kPowder},          Word{"powder-bed", kPowder},   Word{"print", kPrinting},
    Word{"mould", kMoulding},      Word{"mold", kMoulding},       Word{"cast", kMoulding},
    Word{"sinter", kSintering},    Word{"pressed", kSintering},   Word{"mill", kMilling},
    Word{"cnc", kMilling},
};

struct Group {
  Makings makings;
  std::string_view text;
};
constexpr std::array kGroups{
    Group{kPrinting, "printing"},
    Group{kOnPlate, "printing on a plate"},
    Group{kExtrusion, "extrusion"},
    Group{kResin, "resin printing"},
    Group{kPowder, "powder printing"},
    Group{kGearMachines, "cutting on a gear machine"},
    Group{kHobbing, "hobbing"},
    Group{kShaping, "shaping"},
    Group{kGrinding, "grinding"},
    Group{kMilling, "milling"},
    Group{kWireCutting, "wire cutting"},
    Group{kBeamCutting, "beam cutting"},
    Group{kInMould, "moulding or sintering"},
    Group{kMoulding, "moulding"},
    Group{kSintering, "sintering"},
};

}  // namespace

std::optional<Makings> making_named(std::string_view process) {
  const std::string name = lowered(process);
  for (const Word& word : kWords)
    if (name.find(word.part_of_name) != std::string::npos) return word.makings;
  return std::nullopt;
}

std::optional<Makings> making_of(const Process& process) {
  if (const auto named = making_named(process.name)) return named;
  if (process.layer_mm > 0.0) return kPrinting;
  if (process.kerf_mm > 0.0) return kWireCutting | kBeamCutting;
  return std::nullopt;
}

std::string making_text(Makings makings) {
  if ((makings & kAnyMaking) == kAnyMaking) return "any process";
  std::string text;
  for (const Group& group : kGroups) {
    if ((makings & group.makings) != group.makings) continue;
    makings &= ~group.makings;
    text += (text.empty() ? "" : ", ") + std::string(group.text);
  }
  return text;
}

std::string causes_text(const std::vector<CauseOfMaking>& causes, Makings makings) {
  std::string text;
  const bool open = std::popcount(makings) > 1;
  for (const CauseOfMaking& cause : causes) {
    const Makings both = cause.makings & makings;
    if (both == 0) continue;
    if (!text.empty()) text += "; ";
    if (open && cause.makings != kAnyMaking) text += making_text(both) + ": ";
    text += cause.cause;
  }
  return text;
}

std::string correction_text(const std::string& correction,
                            const std::vector<CauseOfMaking>& by_making, Makings makings) {
  const auto own = std::find_if(by_making.begin(), by_making.end(), [&](const CauseOfMaking& one) {
    return (makings & ~one.makings) == 0;
  });
  if (own == by_making.end()) return correction;
  const std::size_t first = correction.find("; ");
  const std::string others = first == std::string::npos ? "" : correction.substr(first + 2);
  return others.empty() || others == own->cause ? own->cause : own->cause + "; " + others;
}

}  // namespace trueflank::loop

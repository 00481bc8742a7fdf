// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/train/gearbox_design.h"

#include <algorithm>

namespace trueflank {

const std::vector<std::string>& gear_names(TrainKind kind) {
  static const std::vector<std::string> k3k{"sun", "planet1", "ring1", "planet2", "ring2"};
  static const std::vector<std::string> kSimple{"sun", "planet", "ring"};
  static const std::vector<std::string> kPair{"pinion", "wheel"};
  static const std::vector<std::string> kGear{"gear"};
  switch (kind) {
    case TrainKind::k3k: return k3k;
    case TrainKind::kSimple: return kSimple;
    case TrainKind::kPair: return kPair;
    case TrainKind::kGear: return kGear;
  }
  return kGear;
}

const char* to_text(TrainKind kind) {
  switch (kind) {
    case TrainKind::k3k: return "3k";
    case TrainKind::kSimple: return "simple";
    case TrainKind::kPair: return "pair";
    case TrainKind::kGear: return "gear";
  }
  return "";
}

const char* to_text(OutputMember output) {
  switch (output) {
    case OutputMember::kRing2: return "ring2";
    case OutputMember::kRing1: return "ring1";
    case OutputMember::kCarrier: return "carrier";
    case OutputMember::kRing: return "ring";
    case OutputMember::kWheel: return "wheel";
    case OutputMember::kNone: return "none";
  }
  return "";
}

const GearDesign* find_gear(const GearboxDesign& design, const std::string& name) {
  const auto it = std::find_if(design.gears.begin(), design.gears.end(),
                               [&](const GearDesign& gear) { return gear.name == name; });
  return it == design.gears.end() ? nullptr : &*it;
}

double module_of(const GearboxDesign& design, const GearDesign& gear) {
  return gear.module_mm.value_or(design.module_mm);
}

}  // namespace trueflank

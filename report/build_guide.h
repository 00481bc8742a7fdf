// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "trueflank/solid/measure/assembly_order.h"

// What a person does to put a gearbox with its housing together.
namespace trueflank::io {

/// What is taken for a step: a part's file name or what to order.
struct GuideNeed {
  std::string name;
  int count = 0;
  bool made = true;
};

struct GuideStep {
  std::string title;                    ///< "Press 6 inserts M3x5.7 into the housing"
  std::vector<std::string> lines = {};  ///< how, and what to look out for
  std::vector<GuideNeed> needs = {};
  std::string tool = {};                            ///< empty: hands
  std::vector<std::size_t> there = {}, added = {};  ///< indices into PartShapes::assembly
  double from = 1.0;  ///< +1: the added bodies come down along -z; -1: up
};

/// Steps of what is put together by itself.
struct GuideSection {
  std::string title;  ///< "Carrier", "Planet (make 3)", "Gearbox"
  int copies = 1;
  std::vector<GuideStep> steps;
};

struct BuildGuide {
  std::vector<GuideSection> sections;
  std::vector<std::string> tools;  ///< of all steps, each once
};

/// Requires: a design with [housing] and an order that exists.
[[nodiscard]] BuildGuide build_guide(const GearTrain& train, const PartShapes& shapes,
                                     const AssemblyOrder& order);

}  // namespace trueflank::io

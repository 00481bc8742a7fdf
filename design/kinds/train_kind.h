// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "trueflank/train/topology.h"

// The kinds of train a design file can name. A kind is a row of one table: everything that depends on
// the kind is in its source here, everything else reads the topology it gives.
namespace trueflank {

struct TrainKind {
  const char* name;
  const char* meaning;            ///< what it is made of, for the reference
  const char* output_meaning;     ///< which outputs there are and what is held then; "none"
  std::vector<std::string> outputs;  ///< members that may drive out, the usual one first
  bool output_required = false;
  std::vector<std::string> inputs;   ///< members that may drive in, the usual one first
  const char* input_meaning = "";    ///< empty where there is no choice
  Topology (*topology)(std::string_view output, std::string_view input);
  const char* new_design;         ///< tables of a design to start from, [rack] aside
};

/// In the order in which documents name them.
[[nodiscard]] const std::vector<TrainKind>& train_kinds();
/// nullptr where there is none of this name.
[[nodiscard]] const TrainKind* find_train_kind(std::string_view name);
/// "3k, simple, pair or gear".
[[nodiscard]] std::string train_kind_names();

/// The topology of a kind; an empty output or input is the usual one.
/// Requires: the kind is in the table and has this output and input.
[[nodiscard]] Topology train_topology(std::string_view kind, std::string_view output = {},
                                      std::string_view input = {});

// One source each.
[[nodiscard]] TrainKind kind_3k();
[[nodiscard]] TrainKind kind_stepped();
[[nodiscard]] TrainKind kind_simple();
[[nodiscard]] TrainKind kind_two_stage();
[[nodiscard]] TrainKind kind_pair();
[[nodiscard]] TrainKind kind_gear();

}  // namespace trueflank

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "tests/loop/hidden_bench.h"
#include "trueflank/design/design_file.h"
#include "trueflank/loop/drive/close_drive_loop.h"

namespace trueflank::test {

/// The prototype's train, laid out once.
inline const GearTrain& bench_train() {
  static const GearTrain train =
      *lay_out(*read_design(TRUEFLANK_SOURCE_DIR "/examples/bilateral_drive/design.toml"));
  return train;
}
inline const PaperTrain& paper_train() {
  static const PaperTrain train(bench_train());
  return train;
}
inline const loop::DriveModel& bench_model() {
  static const loop::DriveModel model = *loop::drive_model(bench_train());
  return model;
}

inline ResultAll<loop::DriveLoop> close_bench_text(const std::string& text) {
  loop::BenchData data;
  if (Errors errors = loop::read_bench_text("bench.csv", text, data); !errors.empty())
    return fail_all(std::move(errors));
  return loop::close_drive_loop(bench_model(), data);
}
inline ResultAll<loop::DriveLoop> close_hidden(const HiddenDrive& drive, const BenchPlan& plan = {}) {
  return close_bench_text(bench_file(paper_train(), drive, plan));
}

inline std::string told(const loop::LoopResult& result) {
  std::string text;
  for (const loop::FoundEffect& effect : result.effects)
    text += effect.id + ": " + effect.description + "\n";
  return text + result.structure_left;
}
inline const loop::FoundEffect* found(const loop::LoopResult& result, const std::string& id) {
  for (const loop::FoundEffect& effect : result.effects)
    if (effect.id == id) return &effect;
  return nullptr;
}
inline const loop::Parameter* parameter(const loop::FoundEffect& effect, const std::string& name) {
  for (const loop::Parameter& p : effect.parameters)
    if (p.name == name) return &p;
  return nullptr;
}
inline bool cannot_tell(const loop::FoundEffect& effect, const std::string& id) {
  for (const std::string& other : effect.confounded_with)
    if (other == id) return true;
  return false;
}

}  // namespace trueflank::test

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "trueflank/base/result.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/gear_train.h"

namespace trueflank {

struct DesignFile;

/// How the parts are made, said beside the design and over it.
struct MadeOptions {
  std::string process;            ///< name of a process; empty: the design's
  std::optional<double> kerf_mm;  ///< nothing: the design's
};
/// What is wrong with these options whatever the design. kUsage.
[[nodiscard]] Errors errors_of(const MadeOptions& options);

/// A design read and laid out, with its parts: what checking, making, measuring and correcting begin
/// with. Never changes. A copy is cheap and shares everything; what is handed out as a shared pointer,
/// and parts(), stay valid for as long as their holder keeps them.
class Gearbox {
 public:
  /// Reads a design file (a pipe will do) and lays it out. Errors: all of the file, with file and line;
  /// no such process.
  [[nodiscard]] static ResultAll<Gearbox> read(const std::string& path, const MadeOptions& made = {});
  /// The same of a text; `file` names it in errors.
  [[nodiscard]] static ResultAll<Gearbox> read_text(std::string_view text, const std::string& file,
                                                    const MadeOptions& made = {});
  /// The same of a design made in a program.
  [[nodiscard]] static ResultAll<Gearbox> of(GearboxDesign design);

  [[nodiscard]] const GearboxDesign& design() const { return train_->design; }
  [[nodiscard]] const GearTrain& train() const { return *train_; }
  [[nodiscard]] std::shared_ptr<const GearTrain> shared_train() const { return train_; }
  /// The gear of this name; the only gear for an empty one. Errors: kUsage, with the names there are.
  [[nodiscard]] Result<const TrainGear*> gear(const std::string& name) const;
  /// The parts, made when first asked for; they keep what they refer to. Errors: part_shapes()'s, with
  /// file and line.
  [[nodiscard]] const ResultAll<PartShapes>& parts() const;
  /// The file has lengths in inches, or a diametral pitch.
  [[nodiscard]] bool speaks_inches() const;
  /// Errors of later stations with file and line of their keys.
  [[nodiscard]] Errors located(Errors errors) const;

 private:
  struct Parts;
  Gearbox(DesignFile file, GearTrain train);
  [[nodiscard]] static ResultAll<Gearbox> of_file(ResultAll<DesignFile> file, const MadeOptions& made);

  std::shared_ptr<const DesignFile> file_;
  std::shared_ptr<const GearTrain> train_;
  std::shared_ptr<Parts> parts_;
};

}  // namespace trueflank

// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "trueflank/base/result.h"
#include "trueflank/export/reported_file.h"
#include "trueflank/report/render/render.h"
#include "trueflank/solid/shape/part_shape.h"
#include "trueflank/train/gear_train.h"

// The pictures of a gearbox: its assembly with a quarter cut away, its parts, the steps of its
// assembly.
namespace trueflank::io {

/// Meshes of all parts, fine enough for pictures of this width. Refers to train and shapes.
class GearboxPictures {
 public:
  GearboxPictures(const GearTrain& train, const PartShapes& shapes, int width_px);

  /// All bodies. Rings, carrier, housing and what lies round the axis are cut open between the
  /// first two planets; sun, planets and their pins stay whole, as drawings have it.
  [[nodiscard]] Image assembly(int width_px, int height_px) const;
  /// The same from all round, the cut always to the viewer: a row of pictures that loops.
  [[nodiscard]] std::vector<Image> turning(int width_px, int height_px, int count) const;
  [[nodiscard]] Image part(std::size_t part, int width_px, int height_px) const;
  /// A step of putting it together: what is there already, grey, and what comes, lifted out of its
  /// place. `from` -1: it comes from below, and everything is shown turned over.
  [[nodiscard]] Image step(const std::vector<std::size_t>& there,
                           const std::vector<std::size_t>& added, double from, int width_px,
                           int height_px) const;

 private:
  [[nodiscard]] RenderedBody body(std::size_t number) const;
  [[nodiscard]] double opening_rad() const;
  [[nodiscard]] bool is_cut(const Placement& placement) const;
  [[nodiscard]] Image cut_open(double towards_rad, const std::vector<Eigen::Vector3d>& framed,
                               int width_px, int height_px, bool quick) const;

  const GearTrain& train_;
  const PartShapes& shapes_;
  std::vector<PicturedMesh> meshes_, shadows_;  ///< fine and coarse
};

struct PictureOptions {
  std::filesystem::path folder;
  std::string part;  ///< this one alone; empty: all, and the assembly
  int width_px = 1200;
  std::function<void(const std::string& file_name)> on_written = {};
};
/// PART.png of every made part, and assembly.png. Errors: kDisk, kPermission and their like.
[[nodiscard]] Result<std::vector<ReportedFile>> write_pictures(const GearTrain& train,
                                                               const PartShapes& shapes,
                                                               const PictureOptions& options);

/// assembly.apng: the assembly turning; nothing of a part alone. Errors: as write_pictures().
[[nodiscard]] Result<std::vector<ReportedFile>> write_turning_picture(
    const GearTrain& train, const PartShapes& shapes, const PictureOptions& options);

}  // namespace trueflank::io

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/flank_fields.h"

namespace trueflank::loop {

FlankField field_of(const FlankGeometry& geometry, const PointFit& fit, std::size_t effect) {
  const Effect& one = fit.effects()[effect];
  const int first = fit.first_column(static_cast<int>(effect));
  const double low = geometry.root_form_roll_mm(), high = geometry.tip_form_roll_mm();
  FlankField field(2 * kGridSide * kGridSide, geometry.teeth());
  double columns[8];
  for (int tooth = 1; tooth <= geometry.teeth(); ++tooth) {
    Eigen::Index at = 0;
    for (const int side : {1, -1})
      for (int v = 0; v < kGridSide; ++v)
        for (int u = 0; u < kGridSide; ++u, ++at) {
          const double roll = low + (u + 0.5) / kGridSide * (high - low);
          const double z = (v + 0.5) / kGridSide * geometry.face_width_mm();
          one.evaluate(geometry, geometry.on_flank(tooth, side, roll, z), columns);
          double sum = 0.0;
          for (int k = 0; k < one.columns(); ++k) sum += fit.coefficients()[first + k] * columns[k];
          field(at, tooth - 1) = sum;
        }
  }
  return field;
}

void take_off_heights(Eigen::Ref<FlankField> field) {
  for (const Eigen::Index flank : {0, 1}) {
    auto own = field.middleRows(flank * kGridSide * kGridSide, kGridSide * kGridSide);
    const Eigen::RowVectorXd height = own.colwise().mean();
    own.rowwise() -= height;
  }
}

std::array<MeanOfFlank, 2> mean_of_flanks(const FlankField& field) {
  const Eigen::VectorXd mean = field.rowwise().mean();
  std::array<MeanOfFlank, 2> flanks;
  for (const std::size_t flank : {0, 1})
    for (int v = 0; v < kGridSide; ++v)
      for (int u = 0; u < kGridSide; ++u)
        flanks[flank](v, u) =
            mean[static_cast<Eigen::Index>(flank) * kGridSide * kGridSide + v * kGridSide + u];
  return flanks;
}

bool is_mean_across(const std::array<MeanOfFlank, 2>& name,
                    const std::array<MeanOfFlank, 2>& forms) {
  constexpr double kAlike = 1e-6, kLevel = 0.75, kChanges = 0.5, kStands = 0.25;
  double square = 0.0, level = 0.0;
  for (const MeanOfFlank& flank : name) {
    square += flank.squaredNorm();
    level += flank.mean() * flank.mean() * kGridSide * kGridSide;
  }
  if (!(square > 0.0)) return false;
  for (const bool face : {true, false}) {
    Eigen::Matrix<double, 2 * kGridSide, 1> course;
    Eigen::Matrix<double, 2 * kGridSide, kGridSide> changed;
    double off = 0.0;
    for (const int flank : {0, 1}) {
      const auto at = static_cast<std::size_t>(flank);
      const MeanOfFlank own = face ? MeanOfFlank(name[at].transpose()) : name[at],
                        others = face ? MeanOfFlank(forms[at].transpose()) : forms[at];
      const Eigen::Matrix<double, kGridSide, 1> mean = own.rowwise().mean();
      off += (own.colwise() - mean).squaredNorm();
      course.segment<kGridSide>(flank * kGridSide) = mean;
      if (level < kLevel * square)  // of what leans or bends its height says nothing
        course.segment<kGridSide>(flank * kGridSide).array() -= mean.mean();
      changed.middleRows<kGridSide>(flank * kGridSide) = others;
    }
    if (off > kAlike * square || !(course.squaredNorm() > kAlike * square)) continue;
    const Eigen::Matrix<double, kGridSide, 1> share =
        changed.transpose() * course / course.squaredNorm();
    if (share.maxCoeff() - share.minCoeff() < kChanges) continue;
    if (2 * (share.array().abs() < kStands).count() < kGridSide) return true;
  }
  return false;
}

}  // namespace trueflank::loop

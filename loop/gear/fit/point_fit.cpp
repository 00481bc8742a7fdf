// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/gear/fit/point_fit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <memory_resource>
#include <optional>
#include <utility>

#include "trueflank/base/widest_registers.h"
#include "trueflank/export/parallel_jobs.h"
#include "trueflank/geometry/linear_equations.h"

namespace trueflank::loop {

bool counts_as_error(ObservationKind kind) {
  return kind == ObservationKind::kScanFlank || kind == ObservationKind::kProfile ||
         kind == ObservationKind::kHelix || kind == ObservationKind::kIndex ||
         kind == ObservationKind::kRadial || kind == ObservationKind::kSize;
}

PointFit::PointFit(const FlankGeometry& geometry, const Observations& table, const Patches& patches,
                   std::vector<Effect> effects, std::size_t stride, DeviationsOf what, Known known)
    : geometry_(geometry),
      table_(table),
      patches_(patches),
      stride_(stride),
      what_(table.is_displaced ? what : DeviationsOf::kTable),
      nuisance_(geometry, table),
      effects_(std::move(effects)) {
  columns_ = nuisance_.count();
  for (const Effect& effect : effects_) {
    first_column_.push_back(columns_);
    columns_ += effect.columns();
    prepared_.emplace_back(geometry, effect);
  }
  keep_features(known);
  average_zeros();
  accumulate();
  // (a fit is kept beside others: the features of few rows only)
  constexpr std::size_t kMostKept = 500'000;
  if (kept_.size() > kMostKept) kept_ = {};
  solve();
}

/// Nuisance and effect columns of a row, the value last; of a scan's those of the first effects
/// alone.
void PointFit::features(std::size_t i, double* values, std::size_t effects) const {
  if (!kept_.empty()) {
    const auto width = static_cast<std::size_t>(columns_) + 1;
    std::copy_n(kept_.data() + i * width, width, values);
    return;
  }
  const Observation& row = table_.rows[i];
  if (i < table_.points_mm.size()) {  // of a scan: one place, with a weight of 1
    if (!as_it_was(i)) {
      features_at(table_.place(row), row, values, effects);
      values[columns_] = row.deviation_um;
      return;
    }
    features_of(as_designed(geometry_, table_, i), row, values, effects);
    return;
  }
  std::fill_n(values, columns_ + 1, 0.0);
  for (std::uint32_t k = 0; k < row.places; ++k) {
    const Place& place = table_.places[row.first_place + k];
    nuisance_.add(place, row.kind, row.source, row.weight, values);
    double one[8];
    for (std::size_t e = 0; e < effects_.size(); ++e) {
      prepared_[e].evaluate(place, one);
      for (int c = 0; c < prepared_[e].columns(); ++c)
        values[first_column_[e] + c] += row.weight * one[c];
    }
  }
  values[columns_] = row.deviation_um;
}

/// True for rows whose deviations as designed are asked for.
bool PointFit::as_it_was(std::size_t i) const {
  return what_ == DeviationsOf::kDesign && kept_.empty() && i < table_.points_mm.size() &&
         table_.rows[i].kind == ObservationKind::kScanFlank;
}

void PointFit::features_of(const PlacedPoint& placed, const Observation& row, double* values,
                           std::size_t effects) const {
  features_at(placed.place, row, values, effects);
  values[columns_] = um_from_mm(placed.distance_mm);
}

void PointFit::features_at(const Place& place, const Observation& row, double* values,
                           std::size_t effects) const {
  nuisance_.set(place, row.kind, row.source, values);
  for (std::size_t e = 0; e < effects; ++e) prepared_[e].evaluate(place, values + first_column_[e]);
}

/// Means of all columns over every trace: what its unknown zero takes out of them. The hold-out has
/// its own, so that nothing is learnt from it.
void PointFit::average_zeros() {
  zero_means_.assign(2 * table_.traces, Eigen::VectorXd::Zero(columns_ + 1));
  whole_zero_means_.assign(table_.traces, Eigen::VectorXd::Zero(columns_ + 1));
  if (table_.traces == 0) return;
  std::vector<double> weights(2 * table_.traces, 0.0);
  Eigen::VectorXd row(columns_ + 1);
  for (std::size_t i = 0; i < table_.rows.size(); i += stride_) {
    const int trace = table_.rows[i].trace;
    if (trace < 0 || patches_.patch_of_row[i] < 0) continue;
    const auto& patch = patches_.patches[patches_.patch_of_row[i]];
    const double w = patch.weight / patch.count;
    features(i, row.data(), effects_.size());
    const int slot = 2 * trace + (patch.fold == 0 ? 1 : 0);
    zero_means_[slot] += w * row;
    weights[slot] += w;
  }
  for (int t = 0; t < table_.traces; ++t) {
    const double both = weights[2 * t] + weights[2 * t + 1];
    if (both > 0.0) whole_zero_means_[t] = (zero_means_[2 * t] + zero_means_[2 * t + 1]) / both;
    zeros_ += both > 0.0 ? 1 : 0;
  }
  for (std::size_t s = 0; s < weights.size(); ++s)
    if (weights[s] > 0.0) zero_means_[s] /= weights[s];
}

namespace {

/// Rows that are worked on at once.
constexpr std::size_t kPanel = 32;
static_assert(kPanel % 8 == 0);
/// Rows of one piece of work, and most pieces: they depend on the data alone, so sums are the same
/// on any number of processors.
constexpr std::size_t kRowsOfWork = 16384, kMostPieces = 8;

/// Sums of squares and products of rows, gathered in panels; the lower triangle. The columns of a
/// row are followed by a 1, whose products are the sums of the columns.
class Gram {
 public:
  /// `room` gives the memory.
  Gram(std::size_t columns, std::pmr::memory_resource& room)
      : width_(columns + 1),
        sum_(width_ * (width_ + 1) / 2, &room),
        panel_(kPanel * width_, &room) {}
  /// Adds the columns of a row times a factor.
  void add(const double* row, double factor) {
    double* to = panel_.data() + filled_;
    const double* const end = row + (width_ - 1);
    for (; row != end; ++row, to += kPanel) *to = factor * *row;
    *to = factor;
    if (++filled_ == kPanel) flush();
  }
  /// Of the columns and the 1.
  [[nodiscard]] Eigen::MatrixXd sum() {
    flush();
    const auto n = static_cast<Eigen::Index>(width_);
    Eigen::MatrixXd result = Eigen::MatrixXd::Zero(n, n);
    auto next = sum_.begin();
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j <= i; ++j) result(i, j) = *next++;
    return result;
  }

 private:
  void flush() {
    if (filled_ == 0) return;
    for (std::size_t k = 0; filled_ < kPanel && k < width_; ++k)
      std::fill_n(panel_.data() + k * kPanel + filled_, kPanel - filled_, 0.0);
    filled_ = 0;
    in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
      double* sum = sum_.data();
      const double* const columns = panel_.data();
      const std::size_t width = width_;
      for (std::size_t i = 0; i < width; ++i)
        for (std::size_t j = 0; j <= i; ++j) {
          // Four parts of a sum (left to itself, the compiler divides the sums otherwise and
          // shuffles).
          FourDoubles even{}, odd{};
          for (std::size_t r = 0; r < kPanel; r += 8) {
            FourDoubles a, b, c, d;
            load(a, columns + i * kPanel + r);
            load(b, columns + j * kPanel + r);
            load(c, columns + i * kPanel + r + 4);
            load(d, columns + j * kPanel + r + 4);
            even += a * b;
            odd += c * d;
          }
          even += odd;
          *sum++ += (even[0] + even[1]) + (even[2] + even[3]);
        }
    });
  }
  std::size_t width_;
  std::pmr::vector<double> sum_, panel_;  ///< in the panel the rows of a column stand together
  std::size_t filled_ = 0;
};

/// sums += weight * row * row', the lower triangle.
void add_square(Eigen::MatrixXd& sums, const Eigen::VectorXd& row, double weight) {
  const auto n = static_cast<std::size_t>(row.size());
  const double* const x = row.data();
  double* const all = sums.data();
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    for (std::size_t c = 0; c < n; ++c) {
      const double factor = weight * x[c];
      double* const column = all + c * n;
      for (std::size_t r = c; r < n; ++r) column[r] += factor * x[r];
    }
  });
}

void fill_upper(Eigen::MatrixXd& m) {
  if (m.size() > 0) m.triangularView<Eigen::StrictlyUpper>() = m.transpose();
}

/// The first row of each piece of work, and the end.
std::vector<std::size_t> pieces_of(std::size_t rows) {
  const std::size_t pieces = std::clamp<std::size_t>(rows / kRowsOfWork, 1, kMostPieces);
  std::vector<std::size_t> starts;
  for (std::size_t k = 0; k <= pieces; ++k) starts.push_back(rows * k / pieces);
  return starts;
}

void run_pieces(const std::vector<std::size_t>& starts,
                const std::function<void(std::size_t, std::size_t, std::size_t)>& work) {
  std::vector<io::QueuedJob> jobs;
  for (std::size_t k = 0; k + 1 < starts.size(); ++k)
    jobs.push_back({[&work, &starts, k] {
                      work(k, starts[k], starts[k + 1]);
                      return true;
                    },
                    {}});
  io::run_jobs(jobs);
}

}  // namespace

/// Of a patch, what each of its rows asks for: patches are met in any order.
struct PointFit::PatchOfRow {
  double weight = 0.0, root = 0.0;  ///< of a row
  int unit = 0;
  bool held = false;
};

/// Sums over some of the rows.
struct PointFit::Sums {
  Eigen::MatrixXd train, plain_held, plain_all;
  std::vector<Eigen::MatrixXd> unit_grams;
  std::vector<Eigen::VectorXd> unit_sums;
  int observations = 0, held_out = 0;
};

/// Nuisance and effect columns, the value last, of some rows at a time.
struct PointFit::RowPanel {
  /// Of the first effects; the columns of the others are 0 in rows of scans.
  RowPanel(const PointFit& fit, std::size_t first_effects)
      : one(static_cast<std::size_t>(fit.columns_) + 1), effects(first_effects) {}

  std::vector<double> one;
  std::size_t effects;
  std::vector<std::size_t> anew;  ///< rows whose places as designed are found together
  std::array<PlacedPoint, kPanel> placed;

  /// `visit(r, columns)` for every one of the rows, kPanel at most; the columns may be written to.
  template <class Visit>
  void for_each(const PointFit& fit, const std::vector<std::size_t>& rows, const Visit& visit) {
    if (fit.what_ != DeviationsOf::kDesign) {
      for (std::size_t r = 0; r < rows.size(); ++r) {
        fit.features(rows[r], one.data(), effects);
        visit(r, one.data());
      }
      return;
    }
    anew.clear();
    for (const std::size_t row : rows)
      if (fit.as_it_was(row)) anew.push_back(row);
    as_designed(fit.geometry_, fit.table_, anew, placed.data());
    std::size_t next = 0;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      if (next < anew.size() && anew[next] == rows[r])
        fit.features_of(placed[next++], fit.table_.rows[rows[r]], one.data(), effects);
      else
        fit.features(rows[r], one.data(), effects);
      visit(r, one.data());
    }
  }
  void subtract(const Eigen::VectorXd& mean) {
    for (std::size_t k = 0; k < one.size(); ++k) one[k] -= mean[static_cast<Eigen::Index>(k)];
  }
};

PointFit::Sums PointFit::sums_of(const std::vector<PatchOfRow>& patches, std::size_t begin,
                                 std::size_t end) const {
  const Eigen::Index n = columns_ + 1;
  const auto columns = static_cast<std::size_t>(n);
  Sums sums;
  sums.train = sums.plain_held = Eigen::MatrixXd::Zero(n, n);
  sums.unit_grams.resize(patches_.units);
  sums.unit_sums.resize(patches_.units);
  // Rows of scans are the same for all sums. Those of traces, few, have the hold-out's own zeros in
  // what is learnt and what is held out.
  // (few large pieces of memory: threads that ask for many wait for each other)
  std::pmr::monotonic_buffer_resource room;
  std::vector<std::optional<Gram>> learnt(patches_.units), other(patches_.units);
  Gram plain_held(columns, room), plain_other(columns, room);
  RowPanel panel(*this, effects_.size());
  std::vector<std::size_t> rows;
  Eigen::VectorXd apart(n);
  const auto add_row = [&](std::size_t r, const double* values) {
    const Observation& observation = table_.rows[rows[r]];
    const PatchOfRow& patch = patches[static_cast<std::size_t>(patches_.patch_of_row[rows[r]])];
    const bool held = patch.held, in_trace = observation.trace >= 0;
    const bool counts = counts_as_error(observation.kind);
    if (in_trace) {
      apart = Eigen::Map<const Eigen::VectorXd>(values, n) -
              zero_means_[2 * observation.trace + (held ? 1 : 0)];
      if (!held) add_square(sums.train, apart, patch.weight);
      if (held && counts) add_square(sums.plain_held, apart, 1.0);
      panel.subtract(whole_zero_means_[observation.trace]);
    }
    auto& unit = (held || in_trace ? other : learnt)[patch.unit];
    if (!unit) unit.emplace(columns, room);
    unit->add(values, patch.root);
    if (!counts) return;
    (held && !in_trace ? plain_held : plain_other).add(values, 1.0);
    ++sums.observations;
    sums.held_out += held ? 1 : 0;
  };
  const auto add_panel = [&] {
    panel.for_each(*this, rows, add_row);
    rows.clear();
  };
  for (std::size_t i = begin; i < end; ++i) {
    if (patches_.patch_of_row[i * stride_] < 0) continue;
    rows.push_back(i * stride_);
    if (rows.size() == kPanel) add_panel();
  }
  add_panel();
  for (int u = 0; u < patches_.units; ++u) {
    if (!learnt[u] && !other[u]) continue;
    Eigen::MatrixXd with_one = Eigen::MatrixXd::Zero(n + 1, n + 1);
    if (other[u]) with_one += other[u]->sum();
    if (learnt[u]) {
      const Eigen::MatrixXd of_training = learnt[u]->sum();
      with_one += of_training;
      sums.train += of_training.topLeftCorner(n, n);
    }
    sums.unit_grams[u] = with_one.topLeftCorner(n, n);
    sums.unit_sums[u] = with_one.row(n).transpose();
  }
  const Eigen::MatrixXd held = plain_held.sum().topLeftCorner(n, n);
  sums.plain_all = held + plain_other.sum().topLeftCorner(n, n);
  sums.plain_held += held;
  return sums;
}

void PointFit::accumulate() {
  const int n = columns_ + 1;
  unit_grams_.assign(patches_.units, Eigen::MatrixXd());
  unit_kind_.assign(patches_.units, -1);
  unit_zero_.assign(patches_.units, -1);
  unit_sums_.assign(patches_.units, Eigen::VectorXd::Zero(n + 1));
  train_ = all_ = plain_held_ = plain_all_ = Eigen::MatrixXd::Zero(n, n);
  std::vector<PatchOfRow> patches;
  for (const auto& patch : patches_.patches) {
    const double weight = patch.weight / patch.count;
    patches.push_back({weight, std::sqrt(weight), patch.unit, patch.fold == 0});
    unit_kind_[patch.unit] = static_cast<int>(patch.kind);
    unit_zero_[patch.unit] = patch.zero;
  }
  const std::vector<std::size_t> starts = pieces_of((table_.rows.size() + stride_ - 1) / stride_);
  std::vector<Sums> sums(starts.size() - 1);
  run_pieces(starts, [&](std::size_t k, std::size_t begin, std::size_t end) {
    sums[k] = sums_of(patches, begin, end);
  });
  for (Sums& part : sums) {
    train_ += part.train;
    plain_held_ += part.plain_held;
    plain_all_ += part.plain_all;
    observations_ += part.observations;
    held_out_ += part.held_out;
    for (int u = 0; u < patches_.units; ++u) {
      if (part.unit_grams[u].size() == 0) continue;
      unit_sums_[u] += part.unit_sums[u];
      if (unit_grams_[u].size() == 0)
        unit_grams_[u] = std::move(part.unit_grams[u]);
      else
        unit_grams_[u] += part.unit_grams[u];
    }
  }
  for (int u = 0; u < patches_.units; ++u) {
    fill_upper(unit_grams_[u]);
    if (unit_grams_[u].size() > 0)
      all_ += unit_grams_[u];
    else
      unit_kind_[u] = -1;
  }
  for (Eigen::MatrixXd* m : {&train_, &plain_held_, &plain_all_}) fill_upper(*m);
}

Eigen::VectorXd PointFit::solution(const Eigen::MatrixXd& gram,
                                   const std::vector<int>& columns) const {
  Eigen::VectorXd result = Eigen::VectorXd::Zero(columns_);
  if (columns.empty()) return result;
  Eigen::MatrixXd normal = gram(columns, columns);
  normal.diagonal() *= 1.0 + 1e-12;
  normal.diagonal().array() += 1e-30;
  const Eigen::VectorXd right = gram(columns, columns_);
  const Eigen::VectorXd solved = symmetric_solution(normal, right);
  for (std::size_t i = 0; i < columns.size(); ++i)
    result[columns[i]] = solved[static_cast<Eigen::Index>(i)];
  return result;
}

std::vector<int> PointFit::columns_with(const std::vector<bool>& with_effect) const {
  std::vector<int> columns;
  for (int i = 0; i < nuisance_.count(); ++i) columns.push_back(i);
  for (std::size_t e = 0; e < effects_.size(); ++e)
    for (int k = 0; with_effect[e] && k < effects_[e].columns(); ++k)
      columns.push_back(first_column_[e] + k);
  return columns;
}

namespace {
double square_error(const Eigen::MatrixXd& gram, const Eigen::VectorXd& b) {
  const auto n = b.size();
  return gram(n, n) - 2.0 * b.dot(gram.col(n).head(n)) + b.dot(gram.topLeftCorner(n, n) * b);
}
}  // namespace

/// True where the training data can hardly tell any of an effect's columns: a tooth that is held
/// out is in them by its share of a size alone.
bool PointFit::is_hardly_learnt(std::size_t effect) const {
  constexpr double kHardly = 0.1;
  const int first = first_column_[effect], end = first + effects_[effect].columns();
  for (int k = first; k < end; ++k)
    if (train_(k, k) > kHardly * all_(k, k)) return false;
  return true;
}

/// Of these columns, those that the training data can tell.
std::vector<int> PointFit::learnt(std::vector<int> columns) const {
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    if (!is_hardly_learnt(e)) continue;
    const int first = first_column_[e], end = first + effects_[e].columns();
    std::erase_if(columns, [&](int k) { return k >= first && k < end; });
  }
  return columns;
}

PointFit::Errors PointFit::errors(const std::vector<bool>& with_effect) const {
  const std::vector<int> columns = columns_with(with_effect);
  Errors result;
  const double all = square_error(plain_all_, solution(all_, columns));
  const double held = square_error(plain_held_, solution(train_, learnt(columns)));
  if (observations_ > 0) result.rms_um = std::sqrt(std::max(0.0, all) / observations_);
  result.held_out_rms_um = held_out_ > 0 ? std::sqrt(std::max(0.0, held) / held_out_) : kNaN;
  return result;
}

PointFit::HeldOutBesideLocal PointFit::held_out_beside_local() const {
  HeldOutBesideLocal result;
  std::vector<int> learnt, there;
  for (int i = 0; i < nuisance_.count(); ++i) learnt.push_back(i);
  for (std::size_t e = 0; e < effects_.size(); ++e) {
    const bool hardly = is_hardly_learnt(e);
    if (hardly) result.fitted_there.push_back(e);
    for (int k = 0; k < effects_[e].columns(); ++k)
      (hardly ? there : learnt).push_back(first_column_[e] + k);
  }
  Eigen::VectorXd b = solution(train_, learnt);
  if (!there.empty()) {
    Eigen::MatrixXd held = plain_held_;
    held.col(columns_).head(columns_) -= plain_held_.topLeftCorner(columns_, columns_) * b;
    b += solution(held, there);
  }
  const double square = square_error(plain_held_, b);
  const double values = held_out_ - static_cast<double>(there.size());
  if (values > 0.0) result.rms_um = std::sqrt(std::max(0.0, square) / values);
  return result;
}

double PointFit::residual_square(const std::vector<bool>& with_effect) const {
  return square_error(all_, solution(all_, columns_with(with_effect)));
}

/// The pose that these values leave: their products with all columns, and what stands for the pose.
void PointFit::fit_pose(const Eigen::VectorXd& values, Eigen::VectorXd& b) const {
  const int pose = nuisance_.count();
  if (pose == 0) return;
  Eigen::MatrixXd normal = all_.topLeftCorner(pose, pose);
  normal.diagonal() *= 1.0 + 1e-12;
  normal.diagonal().array() += 1e-30;
  b.head(pose) = symmetric_solution(normal, values.head(pose));
}

double PointFit::rms_with_um(const Eigen::VectorXd& effect_coefficients) const {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(columns_);
  b.tail(columns_ - nuisance_.count()) = effect_coefficients;
  fit_pose(all_.col(columns_).head(columns_) - all_.topLeftCorner(columns_, columns_) * b, b);
  return observations_ > 0 ? std::sqrt(std::max(0.0, square_error(plain_all_, b)) / observations_)
                           : kNaN;
}

double PointFit::size_beside_pose_um(const std::vector<int>& effects) const {
  Eigen::VectorXd b = Eigen::VectorXd::Zero(columns_);
  for (const int e : effects)
    b.segment(first_column_[e], effects_[e].columns()) =
        coefficients_.segment(first_column_[e], effects_[e].columns());
  fit_pose(-all_.topLeftCorner(columns_, columns_) * b, b);
  const double square = b.dot(plain_all_.topLeftCorner(columns_, columns_) * b);
  return observations_ > 0 ? std::sqrt(std::max(0.0, square) / observations_) : 0.0;
}

double PointFit::column_size(int column) const {
  return observations_ > 0 ? std::sqrt(plain_all_(column, column) / observations_) : 0.0;
}

double PointFit::effect_size_um(int effect) const {
  const int first = first_column_[effect], columns = effects_[effect].columns();
  const Eigen::VectorXd b = coefficients_.segment(first, columns);
  const double square = b.dot(plain_all_.block(first, first, columns, columns) * b);
  return observations_ > 0 ? std::sqrt(std::max(0.0, square) / observations_) : 0.0;
}

void PointFit::solve() {
  const int p = columns_;
  const std::vector<int> columns = columns_with(std::vector<bool>(effects_.size(), true));
  coefficients_ = solution(all_, columns);
  residual_square_ = square_error(all_, coefficients_);
  const double plain = square_error(plain_all_, coefficients_);
  const double free = std::max(1.0, observations_ - p - zeros_ * 1.0);
  noise_um_ = std::sqrt(std::max(0.0, plain) / free);
  covariance_ = Eigen::MatrixXd::Zero(p, p);
  degrees_.assign(p, 2.0);
  retained_.assign(p, 0.0);
  if (p == 0) return;
  Eigen::MatrixXd normal = all_.topLeftCorner(p, p);
  normal.diagonal() *= 1.0 + 1e-12;
  normal.diagonal().array() += 1e-30;
  const Eigen::MatrixXd inverse =
      SymmetricSolver(normal).solve_columns(Eigen::MatrixXd::Identity(p, p));
  for (int k = 0; k < p; ++k)
    if (normal(k, k) > 1e-20) retained_[k] = 1.0 / (inverse(k, k) * normal(k, k));
  std::vector<int> of_few;
  for (int k = 0; k < p; ++k)
    if (few_units_bear(k)) of_few.push_back(k);
  spread_between_units(normal);
  for (const int k : of_few) spread_beside(k, normal(k, k), inverse(k, k));
}

std::shared_ptr<const std::vector<float>> PointFit::residuals_um() const {
  auto known = residuals_um_.lock();
  if (!known) {
    known = std::make_shared<const std::vector<float>>(residuals_with(coefficients_));
    residuals_um_ = known;
  }
  kept_residuals_um_ = known;
  return known;
}

std::vector<float> PointFit::residuals_without_effects_um() const {
  if (effects_.empty()) return *residuals_um();
  return residuals_with(solution(all_, columns_with(std::vector<bool>(effects_.size(), false))));
}

std::vector<float> PointFit::residuals_with(const Eigen::VectorXd& coefficients) const {
  std::vector<float> left_um(table_.rows.size(), 0.0f);
  // Effects after the last one with an amount add nothing.
  std::size_t asked = effects_.size();
  while (asked > 0 &&
         coefficients.segment(first_column_[asked - 1], effects_[asked - 1].columns()).isZero(0.0))
    --asked;
  run_pieces(pieces_of(table_.rows.size()), [&](std::size_t, std::size_t begin, std::size_t end) {
    RowPanel panel(*this, asked);
    std::vector<std::size_t> rows;
    const double* const times = coefficients.data();
    const int columns = columns_;
    const auto tell_row = [&](std::size_t r, const double* values) {
      if (const int trace = table_.rows[rows[r]].trace; trace >= 0)
        panel.subtract(whole_zero_means_[trace]);
      double left = values[columns];
      for (int k = 0; k < columns; ++k) left -= times[k] * values[k];
      left_um[rows[r]] = static_cast<float>(left);
    };
    const auto tell_panel = [&] {
      panel.for_each(*this, rows, tell_row);
      rows.clear();
    };
    for (std::size_t i = begin; i < end; ++i) {
      if (patches_.patch_of_row[i] < 0) continue;
      rows.push_back(i);
      if (rows.size() == kPanel) tell_panel();
    }
    tell_panel();
  });
  return left_um;
}

}  // namespace trueflank::loop

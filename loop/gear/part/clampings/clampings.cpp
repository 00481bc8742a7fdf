// SPDX-License-Identifier: GPL-3.0-or-later
// A gear that was clamped anew between two files of records.
#include "trueflank/loop/gear/part/clampings/clampings.h"

#include <Eigen/Core>
#include <Eigen/QR>
#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "trueflank/loop/discovery/distributions.h"
#include "trueflank/loop/gear/part/bans.h"
#include "trueflank/loop/gear/part/clampings/two_clampings.h"
#include "trueflank/loop/gear/part/one_form.h"

namespace trueflank::loop {
namespace {

constexpr int kFewestTeethOfFile = 5, kMostFiles = 8;
constexpr double kFarLikelier = 10.0;

/// A row with one value a tooth, its file and the two columns of a displacement there.
struct RowOfFile {
  int file = 0;
  std::size_t row = 0;
  std::array<double, 2> moves{};
};

/// Rows with one value a tooth of the files that have them on enough teeth.
std::vector<RowOfFile> rows_of_files(const PartModel& model) {
  const Effect displaced = eccentric();
  const Observations& table = *model.table.operator->();
  std::map<int, std::set<int>> teeth;
  std::vector<RowOfFile> rows;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const Observation& row = table.rows[i];
    const Place& place = table.place(row);
    if ((row.kind != ObservationKind::kIndex && row.kind != ObservationKind::kRadial) ||
        place.file == 0)
      continue;
    RowOfFile one{place.file, i, {}};
    for (std::uint32_t p = row.first_place; p < row.first_place + row.places; ++p) {
      double columns[2];
      displaced.evaluate(model.geometry, table.places[p], columns);
      for (std::size_t k : {0, 1}) one.moves[k] += row.weight * columns[k];
    }
    rows.push_back(one);
    teeth[place.file].insert(place.tooth);
  }
  std::erase_if(rows, [&](const RowOfFile& one) {
    return static_cast<int>(teeth[one.file].size()) < kFewestTeethOfFile;
  });
  return rows;
}

std::vector<int> files_of(const std::vector<RowOfFile>& rows) {
  std::set<int> files;
  for (const RowOfFile& row : rows) files.insert(row.file);
  return {files.begin(), files.end()};
}

/// What two files and more say of the same places, less the mean of each place: values, and columns
/// of a displacement of each file.
class DifferencesOfFiles {
 public:
  DifferencesOfFiles(const PartModel& model, const std::vector<RowOfFile>& rows)
      : files_(files_of(rows)) {
    const Observations& table = *model.table.operator->();
    std::map<std::array<int, 5>, std::vector<std::size_t>> of_place;
    std::map<int, std::size_t> zeros;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      const Observation& row = table.rows[rows[k].row];
      const Place& place = table.place(row);
      of_place[{static_cast<int>(row.kind), place.tooth, place.side, um(place.roll_mm),
                um(place.z_mm)}]
          .push_back(k);
      if (row.trace >= 0) zeros.try_emplace(row.trace, zeros.size());
    }
    std::erase_if(of_place, [&](const auto& place) {
      std::set<int> files;
      for (const std::size_t k : place.second) files.insert(rows[k].file);
      return files.size() < 2;
    });
    std::size_t count = 0;
    for (const auto& [place, these] : of_place) count += these.size();
    const Eigen::Index moves = 2 * std::ssize(files_);
    columns_ = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(count), moves + std::ssize(zeros));
    values_ = Eigen::VectorXd::Zero(columns_.rows());
    Eigen::Index first = 0;
    for (const auto& [place, these] : of_place) {
      const Eigen::Index n = std::ssize(these);
      for (Eigen::Index i = 0; i < n; ++i) {
        const RowOfFile& of = rows[these[static_cast<std::size_t>(i)]];
        const Observation& row = table.rows[of.row];
        const auto file = std::lower_bound(files_.begin(), files_.end(), of.file) - files_.begin();
        values_[first + i] = row.deviation_um;
        columns_.row(first + i).segment<2>(2 * file) << of.moves[0], of.moves[1];
        if (row.trace >= 0)
          columns_(first + i, moves + static_cast<Eigen::Index>(zeros.at(row.trace))) = 1.0;
      }
      values_.segment(first, n).array() -= values_.segment(first, n).mean();
      const Eigen::RowVectorXd mean = columns_.middleRows(first, n).colwise().mean();
      columns_.middleRows(first, n).rowwise() -= mean;
      first += n;
    }
    places_ = std::ssize(of_place);
  }

  [[nodiscard]] const std::vector<int>& files() const { return files_; }
  /// How likely chance alone makes files differ so from those that are `alike`.
  [[nodiscard]] double p_of_displacements(const std::vector<int>& alike) const {
    const Fit apart = left_with({}), together = left_with(alike);
    const double degrees = static_cast<double>(values_.size() - places_ - apart.rank);
    const double own = static_cast<double>(apart.rank - together.rank);
    if (degrees < 1.0 || own < 1.0) return 1.0;
    const double least = std::max(apart.left / degrees, kNearlyNothing_um2);
    return f_tail((together.left - apart.left) / own / least, own, degrees);
  }

 private:
  static constexpr double kNearlyNothing_um2 = 1e-6;
  struct Fit {
    double left = 0.0;
    Eigen::Index rank = 0;
  };
  static int um(double mm) { return static_cast<int>(std::lround(1000.0 * mm)); }

  /// What zeros and displacements leave; files that are alike have one together, all others one
  /// each.
  [[nodiscard]] Fit left_with(const std::vector<int>& alike) const {
    if (values_.size() == 0) return {};
    Eigen::MatrixXd columns = columns_;
    Eigen::Index first = -1;
    for (std::size_t f = 0; f < files_.size(); ++f) {
      if (std::find(alike.begin(), alike.end(), files_[f]) == alike.end()) continue;
      const Eigen::Index at = 2 * static_cast<Eigen::Index>(f);
      if (first < 0) {
        first = at;
        continue;
      }
      columns.middleCols<2>(first) += columns.middleCols<2>(at);
      columns.middleCols<2>(at).setZero();
    }
    Eigen::ColPivHouseholderQR<Eigen::MatrixXd> solver(columns.rows(), columns.cols());
    solver.setThreshold(1e-9);
    solver.compute(columns);
    return {(values_ - columns * solver.solve(values_)).squaredNorm(), solver.rank()};
  }

  std::vector<int> files_;
  Eigen::MatrixXd columns_;
  Eigen::VectorXd values_;
  Eigen::Index places_ = 0;
};

Effect clamping_of_file(int file) {
  return {find_family("unnamed_clamping"), FlankChoice::kBoth, {static_cast<double>(file)}};
}

bool asks_for_clampings(const PartModel& model) {
  return model.options.tables == 1 && !model.options.joined && !model.options.names_only;
}

/// Effects of both flanks that come once per turn and run along none.
std::vector<std::size_t> once_per_turn(const PartModel& model) {
  std::vector<std::size_t> these;
  for (std::size_t e = first_told_here(model); e < model.effects.size(); ++e) {
    const Effect& effect = model.effects[e];
    const NeedsToBeSeen needs = effect.needs();
    const bool term = effect.family == find_family("unnamed") && effect.order() == 1.0 &&
                      !needs.along_profile && !needs.along_face;
    if (effect.flank == FlankChoice::kBoth &&
        (term || effect.family == eccentric().family ||
         (effect.family == wave_of_pitch().family && effect.order() == 1.0)))
      these.push_back(e);
  }
  return these;
}

/// How many times likelier an answer that ends with two effects of two columns is than another with
/// others that say the same, before any data: all sizes and phases of an effect are as likely
/// (log-uniform), so two large ones that take each other back are not.
double how_likelier(const PartModel& model, const std::vector<Effect>& one,
                    const std::vector<Effect>& other) {
  // Of both the last four columns, as far as they move flanks: p of the other = map * b of the one.
  const auto sizes = [&](const std::vector<Effect>& effects) {
    const auto fit = fit_of(model, effects);
    const auto first = fit->first_column(static_cast<int>(effects.size()) - 2);
    return Eigen::Vector4d(fit->coefficients().segment<4>(first));
  };
  const Eigen::Vector4d b = sizes(one), p = sizes(other);
  Eigen::Matrix4d map;
  Eigen::MatrixXd columns[2];
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < model.table->rows.size(); ++i)
    if (model.table->rows[i].kind == ObservationKind::kIndex) rows.push_back(i);
  for (const std::size_t which : {0, 1}) {
    const std::vector<Effect>& effects = which == 0 ? one : other;
    columns[which].resize(std::ssize(rows), 4);
    for (Eigen::Index i = 0; i < std::ssize(rows); ++i)
      for (const Eigen::Index k : {0, 1}) {
        double c[8];
        const Place& place =
            model.table->place(model.table->rows[rows[static_cast<std::size_t>(i)]]);
        effects[effects.size() - 2 + static_cast<std::size_t>(k)].evaluate(model.geometry, place,
                                                                           c);
        columns[which].row(i).segment<2>(2 * k) << c[0], c[1];
      }
  }
  map = columns[1].colPivHouseholderQr().solve(columns[0]);
  const auto density = [](const Eigen::Vector4d& of) {
    return 1.0 / (of.head<2>().squaredNorm() * of.tail<2>().squaredNorm());
  };
  return density(b) / (density(p) * map.colPivHouseholderQr().absDeterminant());
}

}  // namespace

std::vector<RemainderFinding> clampings_of_files(const PartModel& model) {
  constexpr double kLevel = 1e-4, kSmallBeside = 0.1;
  if (!asks_for_clampings(model) || model.table->files.size() < 2) return {};
  const std::vector<RowOfFile> rows = rows_of_files(model);
  const DifferencesOfFiles differences(model, rows);
  std::vector<int> alike = differences.files(), own;
  if (alike.size() < 2 || alike.size() > kMostFiles) return {};
  const double p_value = differences.p_of_displacements(alike);
  // One file after the other is set apart, until the others are alike.
  for (double p = p_value; p < kLevel && alike.size() > 1;
       p = differences.p_of_displacements(alike)) {
    std::size_t odd = 0;
    double most = -1.0;
    for (std::size_t k = 0; k < alike.size() && alike.size() > 2; ++k) {
      std::vector<int> others = alike;
      others.erase(others.begin() + static_cast<std::ptrdiff_t>(k));
      if (const double left = differences.p_of_displacements(others); left > most) {
        most = left;
        odd = k;
      }
    }
    own.push_back(alike[odd]);
    alike.erase(alike.begin() + static_cast<std::ptrdiff_t>(odd));
  }
  if (own.empty()) return {};
  std::vector<Effect> each = model.options.given;
  const std::size_t first = each.size();
  for (const int file : differences.files()) each.push_back(clamping_of_file(file));
  // One that is left alone is no better than the others: each has its own. But what all have alike,
  // and is far larger, is the gear's.
  if (alike.size() == 1) {
    const auto fit = fit_of(model, each);
    Eigen::Vector2d mean = Eigen::Vector2d::Zero();
    double apart = 0.0;
    std::vector<Eigen::Vector2d> sizes;
    for (std::size_t e = first; e < each.size(); ++e)
      sizes.push_back(fit->coefficients().segment<2>(fit->first_column(static_cast<int>(e))));
    for (const Eigen::Vector2d& size : sizes) mean += size / static_cast<double>(sizes.size());
    for (const Eigen::Vector2d& size : sizes) apart = std::max(apart, (size - mean).norm());
    if (apart > kSmallBeside * mean.norm()) own.push_back(alike.front());
  }
  std::sort(own.begin(), own.end());
  std::vector<RemainderFinding> found;
  for (const int file : own) {
    found.emplace_back();
    found.back().p_value = p_value;
    found.back().effect = clamping_of_file(file);
  }
  return found;
}

void tell_clampings_of_flanks(PartModel& model) {
  if (!asks_for_clampings(model) || !is_index_alone(model.table)) return;
  const std::vector<std::size_t> these = once_per_turn(model);
  if (these.size() != 2) return;
  std::map<int, std::set<int>> sides;
  for (const Observation& row : model.table->rows)
    if (row.kind == ObservationKind::kIndex)
      sides[model.table->place(row).file].insert(model.table->place(row).side);
  const bool of_one_side =
      std::all_of(sides.begin(), sides.end(), [](const auto& of) { return of.second.size() == 1; });
  if (sides.empty() || (of_one_side ? sides.size() != 2 : sides.size() != 1)) return;
  const std::vector<Effect> rest = without(model.effects, these);
  std::vector<Effect> clampings = rest, names = rest;
  if (of_one_side) {
    for (const auto& [file, side] : sides) clampings.push_back(clamping_of_file(file));
  } else {
    for (const FlankChoice flank : {FlankChoice::kLeft, FlankChoice::kRight})
      clampings.push_back(clamping_of(flank));
  }
  names.push_back(eccentric());
  names.push_back(wave_of_pitch());
  const double most = cost_of(model, model.effects) + kChiSquareOfValue;
  const bool told_by_names = can_have(model.options.makings, *eccentric().family) &&
                             can_have(model.options.makings, *wave_of_pitch().family);
  if (cost_of(model, clampings) <= most &&
      (of_one_side || !told_by_names || how_likelier(model, clampings, names) > kFarLikelier))
    put_in_place_of(model, these, clampings);
  else if (told_by_names && cost_of(model, names) <= most)
    put_in_place_of(model, these, names);
}

}  // namespace trueflank::loop

// SPDX-License-Identifier: GPL-3.0-or-later
#include "trueflank/loop/discovery/column_panels.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "trueflank/base/contract.h"
#include "trueflank/base/widest_registers.h"

namespace trueflank::loop {
namespace {

/// Does `add(sum, k)` for every k to what stands in a row, which stays in registers meanwhile.
template <class Add>
void sum_up(PanelRow& row, std::size_t count, const Add& add) {
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    for (std::size_t from = 0; from < kPanelColumns; from += kPanelStep) {
      double sum[kPanelStep];
      for (std::size_t j = 0; j < kPanelStep; ++j) sum[j] = row[from + j];
      for (std::size_t k = 0; k < count; ++k) add(sum, k, from);
      for (std::size_t j = 0; j < kPanelStep; ++j) row[from + j] = sum[j];
    }
  });
}

}  // namespace

void subtract_rows(PanelRow& row, const double* factors, const PanelRow* others, std::size_t count) {
  sum_up(row, count, [&](double* sum, std::size_t k, std::size_t from) TRUEFLANK_ALWAYS_INLINE {
    for (std::size_t j = 0; j < kPanelStep; ++j) sum[j] -= factors[k] * others[k][from + j];
  });
}

void add_rows(PanelRow& row, const double* factors, PanelRow& other_row, const double* other_factors,
              const PanelRow* const* others, std::size_t count) {
  constexpr std::size_t kHalf = kPanelColumns / 2;  // of two rows in registers
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    for (std::size_t from = 0; from < kPanelColumns; from += kHalf) {
      double sum[kHalf], other_sum[kHalf];
      for (std::size_t j = 0; j < kHalf; ++j) sum[j] = row[from + j];
      for (std::size_t j = 0; j < kHalf; ++j) other_sum[j] = other_row[from + j];
      for (std::size_t k = 0; k < count; ++k) {
        const double* const x = others[k]->data() + from;
        for (std::size_t j = 0; j < kHalf; ++j) sum[j] += factors[k] * x[j];
        for (std::size_t j = 0; j < kHalf; ++j) other_sum[j] += other_factors[k] * x[j];
      }
      for (std::size_t j = 0; j < kHalf; ++j) row[from + j] = sum[j];
      for (std::size_t j = 0; j < kHalf; ++j) other_row[from + j] = other_sum[j];
    }
  });
}

void add_products(std::vector<PanelRow>& sums, double factor, const PanelRow& row) {
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    PanelRow weighted;
    for (std::size_t j = 0; j < kPanelColumns; ++j) weighted[j] = factor * row[j];
    for (std::size_t apart = 0; apart < sums.size(); ++apart) {
      double* const sum = sums[apart].data();
      const double* const other = row.data() + apart;
      for (std::size_t j = 0; j < kPanelColumns - apart; ++j) sum[j] += other[j] * weighted[j];
    }
  });
}

void subtract_products(std::vector<PanelRow>& sums, const PanelRow& row, const PanelRow& other) {
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    for (std::size_t apart = 0; apart < sums.size(); ++apart) {
      double* const sum = sums[apart].data();
      const double* const beside = other.data() + apart;
      for (std::size_t j = 0; j < kPanelColumns - apart; ++j) sum[j] -= row[j] * beside[j];
    }
  });
}

void add_mixed_products(PanelRow* sums, std::size_t count, const PanelRow& row, const PanelRow& other,
                        double square) {
  in_widest_registers([&]() TRUEFLANK_ALWAYS_INLINE {
    for (std::size_t apart = 0; apart < count; ++apart) {
      double* const sum = sums[apart].data();
      const double* const row_beside = row.data() + apart;
      const double* const other_beside = other.data() + apart;
      for (std::size_t j = 0; j < kPanelColumns - apart; ++j)
        sum[j] += row[j] * (other_beside[j] + square * row_beside[j]) + other[j] * row_beside[j];
    }
  });
}

std::vector<PanelColumns> panels_of(const std::vector<CandidateGroup>& groups) {
  std::vector<PanelColumns> panels;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    TRUEFLANK_EXPECTS(groups[g].columns <= kPanelColumns);
    const bool is_local = groups[g].local_family >= 0;
    if (panels.empty() || panels.back().columns + groups[g].columns > kPanelColumns ||
        is_local != (groups[g - 1].local_family >= 0))
      panels.push_back({static_cast<int>(g), 0, groups[g].first_column, 0});
    ++panels.back().groups;
    panels.back().columns += groups[g].columns;
  }
  return panels;
}

PanelSolver::PanelSolver(const SymmetricSolver& solver)
    : rows_(static_cast<std::size_t>(solver.factors().rows())),
      lower_(solver.factors().transpose()),
      upper_(solver.factors()) {
  std::iota(rows_.begin(), rows_.end(), std::size_t{0});
  const auto& swaps = solver.swaps();
  for (Eigen::Index i = 0; i < solver.factors().rows(); ++i) {
    std::swap(rows_[static_cast<std::size_t>(i)], rows_[static_cast<std::size_t>(swaps[i])]);
    // as in Eigen's own solver
    const double pivot = solver.factors()(i, i);
    inverse_pivots_.push_back(std::abs(pivot) > std::numeric_limits<double>::min() ? 1.0 / pivot
                                                                                   : 0.0);
  }
}

void PanelSolver::solve_lower(Panel& panel) const {
  for (std::size_t i = 1; i < size(); ++i)
    subtract_rows(panel[i], lower_.col(static_cast<Eigen::Index>(i)).data(), panel.data(), i);
}

void PanelSolver::solve_upper(Panel& panel) const {
  for (std::size_t i = size(); i-- > 0;) {
    for (double& value : panel[i]) value *= inverse_pivots_[i];
    subtract_rows(panel[i], upper_.col(static_cast<Eigen::Index>(i)).data() + i + 1,
                  panel.data() + i + 1, size() - i - 1);
  }
}

}  // namespace trueflank::loop

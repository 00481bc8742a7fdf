// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "trueflank/session/search_session.h"

// The files of a finished search as text; the same bytes for the same report.
namespace trueflank {

/// "design-001" of the rank 0; both the file's stem and, behind the search's name, the design's.
[[nodiscard]] std::string design_stem(std::size_t rank);

/// "12/39/90/32/81", in the order of the design file's gears.
[[nodiscard]] std::string teeth_text(const ToothSet& set);

/// What files say of a train's tooth numbers; of one of several stages, of all of them together.
struct TrainTeeth {
  ToothNumbers columns{};  ///< of search.csv; a second stage's planet and ring are planet2 and ring2
  std::string text;        ///< teeth_text()
  int planets = 0;         ///< of the first stage
  double ratio = 0.0;      ///< signed
  double module_ratio = 1.0;
  bool hunting = false;
  std::string phasing = {};  ///< "sequential", "together"; "" without planets
};
[[nodiscard]] TrainTeeth teeth_of(const ToothSet& set);
[[nodiscard]] TrainTeeth teeth_of(const StagePair& pair);
[[nodiscard]] TrainTeeth teeth_of(const FoundDesign& found);

/// One line a candidate, best first; the designs that were written have their file's name.
[[nodiscard]] std::string search_csv(const SearchTask& task, const SearchReport& report);
/// Counts of every class, and the designs: format "trueflank-search", version 1.
[[nodiscard]] std::string search_json(const SearchTask& task, const SearchReport& report);
/// All candidates and the designs: first objective over the ratio, or over the second objective.
[[nodiscard]] std::string search_svg(const SearchTask& task, const SearchReport& report);
/// One offline page: plot with hover and links to the design files, sortable table, what fell and why.
/// It holds search_json() whole and the first 4000 rows of search_csv().
[[nodiscard]] std::string search_html(const SearchTask& task, const SearchReport& report);
/// What the program prints.
[[nodiscard]] std::string search_summary(const SearchTask& task, const SearchReport& report);

}  // namespace trueflank

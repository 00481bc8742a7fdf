// SPDX-License-Identifier: GPL-3.0-or-later
//
// `mpirun -n N trueflank-search-mpi REQUIREMENTS -o DIR`: every rank optimises its part, rank 0 puts
// them together and writes what `trueflank search` writes, byte for byte.
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <iostream>

#include "trueflank/app/command_search.h"
#include "trueflank/app/error_text.h"
#include "trueflank/app/terminal.h"

namespace trueflank::app {
namespace {

/// All ranks' texts, one after the other, on rank 0; empty elsewhere.
std::string gathered(const std::string& own, int rank, int ranks) {
  const int length = static_cast<int>(own.size());
  std::vector<int> lengths(static_cast<std::size_t>(ranks)), offsets(lengths.size(), 0);
  MPI_Gather(&length, 1, MPI_INT, lengths.data(), 1, MPI_INT, 0, MPI_COMM_WORLD);
  for (std::size_t i = 1; i < lengths.size(); ++i) offsets[i] = offsets[i - 1] + lengths[i - 1];
  std::string all;
  if (rank == 0) all.resize(static_cast<std::size_t>(offsets.back() + lengths.back()));
  MPI_Gatherv(own.data(), length, MPI_CHAR, all.data(), lengths.data(), offsets.data(), MPI_CHAR, 0,
              MPI_COMM_WORLD);
  return all;
}

/// The worst exit code of all ranks, on every rank: no rank waits for one that has failed.
int agreed(int code) {
  int worst = code;
  MPI_Allreduce(&code, &worst, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return worst;
}

int run_rank(SearchOptions options, int rank, int ranks) {
  auto task = prepare_search(options.requirements, options.materials);
  int code = 0;
  // wrong input is wrong on every rank: one tells
  if (!task) code = rank == 0 ? report_errors(task.error()) : 2;
  if (!code && rank == 0)
    if (auto ok = create_output_folder(options.folder); !ok) code = report_errors({ok.error()});
  if ((code = agreed(code))) return code;

  if (options.threads == 0) options.threads = 1;  // a rank is a core
  const bool quiet = options.quiet;
  options.quiet = quiet || rank != 0;
  const SearchPart part{rank + 1, ranks};
  const auto records = run_part(*task, part, options);
  if (!records) code = report_errors(records.error());
  if ((code = agreed(code))) return code;

  std::string lines;
  for (const SearchRecord& record : records->optimised) lines += journal_line(record) + "\n";
  for (const SearchRecord& stage : records->stages) lines += journal_stage_line(stage) + "\n";
  if (is_complete(*task, *records, part)) lines += journal_end(part) + "\n";
  const std::string all = gathered(lines, rank, ranks);
  if (rank == 0) {
    auto read = read_journal(journal_header(task->requirements, task->enumeration) + "\n" + all,
                             task->requirements, task->enumeration);
    if (!read) {
      code = report_errors({read.error()});
    } else {
      code = conclude(*task, gathered_records(*task, std::move(*read)), options);
    }
  }
  return agreed(code);
}

int run(int argc, char** argv) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  SearchOptions options;
  CLI::App program("trueflank search on several machines: mpirun -n N trueflank-search-mpi ...",
                   "trueflank-search-mpi");
  program.add_option("REQUIREMENTS", options.requirements, "requirements file (TOML)")->required();
  program.add_option("--output,-o", options.folder, "folder for the files, seen by all ranks")
      ->required();
  program.add_option("--threads", options.threads, "of each rank; 1 unless given")
      ->check(CLI::Range(0, 1024));
  program.add_option("--materials", options.materials, "file with more [material.NAME] tables");
  program.add_flag("--resume", options.resume, "go on where the journals end (as many ranks)");
  program.add_flag("--quiet,-q", options.quiet, "no summary, no progress");
  try {
    program.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return rank == 0 ? (program.exit(error) ? 2 : 0) : (error.get_exit_code() ? 2 : 0);
  }
  return run_rank(options, rank, ranks);
}

}  // namespace
}  // namespace trueflank::app

int main(int argc, char** argv) {
  trueflank::app::install_interrupt_handlers();
  MPI_Init(&argc, &argv);
  int code = 3;
  try {
    code = trueflank::app::run(argc, argv);
  } catch (const std::exception& error) {
    std::cerr << "trueflank-search-mpi: internal error, please report it: " << error.what() << "\n";
    MPI_Abort(MPI_COMM_WORLD, 3);
  }
  MPI_Finalize();
  return code;
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <atomic>
#include <chrono>

#include "bindings.h"
#include "trueflank/base/threads.h"
#include "trueflank/design/design_file_writer.h"
#include "trueflank/design/requirements_file.h"
#include "trueflank/session/search_files.h"
#include "trueflank/session/search_session.h"

namespace trueflank::python {
namespace {

struct SearchResult {
  std::string json, csv;
  std::vector<Gearbox> designs;
};

/// Waits for a search; Ctrl-C in Python stops it.
template <class T>
T wait_for(std::future<T>& running, std::atomic<bool>& stop) {
  // without a thread it is done, unstoppable, when the result is asked for
  while (running.wait_for(std::chrono::milliseconds(50)) == std::future_status::timeout) {
    py::gil_scoped_acquire locked;
    if (PyErr_CheckSignals() == 0) continue;
    stop = true;
    py::gil_scoped_release unlocked;
    running.wait();
    break;
  }
  return running.get();
}

SearchResult search_of(SearchRequirements requirements, int threads) {
  if (threads < 0)
    throw Failure({.code = ErrorCode::kUsage, .message = "no number of threads", .key = "threads",
                   .value = std::to_string(threads), .remedy = "0: one per processor"});
  const SearchTask task{.requirements = requirements, .enumeration = enumerate_sets(requirements)};
  std::atomic<bool> stop = false;
  auto running = begun_beside([&] {
    return run_search(task.requirements, task.enumeration, {.threads = threads, .stop = &stop});
  });
  const SearchRecords records = wait_for(running, stop);
  if (stop) return {};  // the caller raises KeyboardInterrupt
  const SearchReport report = finish_search(task, records);
  SearchResult result{.json = search_json(task, report), .csv = search_csv(task, report), .designs = {}};
  for (std::size_t i = 0; i < report.designs.size(); ++i) {
    const std::string name = design_stem(i);
    GearboxDesign design = report.designs[i].design;
    design.name = task.requirements.name + "-" + name.substr(7);
    result.designs.push_back(value_or_throw(Gearbox::read_text(design_file_text(design), name + ".toml")));
  }
  return result;
}

SearchResult search(ResultAll<SearchRequirements> requirements, int threads) {
  SearchResult result;
  {
    py::gil_scoped_release unlocked;
    result = search_of(value_or_throw(std::move(requirements)), threads);
  }
  if (PyErr_Occurred()) throw py::error_already_set();
  return result;
}

}  // namespace

void bind_search(py::module_& module) {
  py::class_<SearchResult>(module, "SearchResult", "What a search found. From search() or search_text().")
      .def_property_readonly(
          "summary", [](const SearchResult& self) { return json_loads(self.json); },
          "search.json as a dict: what was considered, what fell and why, the designs' figures.")
      .def_readonly("designs", &SearchResult::designs, "The designs that passed every check, best first.")
      .def("csv_text", [](const SearchResult& self) { return self.csv; },
           "search.csv as text: every candidate, best first.");
  module.def(
      "search",
      [](const py::object& path, int threads) { return search(read_requirements(path_text(path)), threads); },
      py::arg("requirements"), py::arg("threads") = 0,
      "Searches tooth numbers and shifts of 3K gearboxes for a requirements file (docs/search.md).\n"
      "Ctrl-C stops it; nothing is written.");
  module.def(
      "search_text",
      [](const std::string& text, int threads, const std::string& name) {
        return search(read_requirements_text(text, name), threads);
      },
      py::arg("text"), py::arg("threads") = 0, py::arg("name") = "search.toml",
      "The same for the text of a requirements file.");
}

}  // namespace trueflank::python

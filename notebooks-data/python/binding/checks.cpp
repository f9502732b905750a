// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <memory>

#include "interruptible.hpp"
#include "report.hpp"
#include "runs.hpp"
#include "validation/reports/verify_report.hpp"
#include "validation/verify/check.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::Check;
using validation::CheckResult;

Report verify(bool quick, const std::vector<std::string>& only, const py::object& progress) {
  const validation::CheckSelection selection = validation::select_checks(quick, only);
  const auto work = [&](const Watch& watch) {
    validation::CaseRuns case_runs;
    case_runs.goes_on = watch;
    const auto tell = [&](std::size_t done, std::size_t of, const std::string&) { return watch.tell(done, of); };
    auto checked = validation::verify_checks(selection.checks, case_runs, tell);
    watch.tell(checked.size(), selection.checks.size());
    return checked;
  };
  auto results = run_interruptible(work, progress);
  const auto run = std::make_shared<const std::vector<CheckResult>>(std::move(results));
  const std::string words = selection.words;
  return {[run, words] { return validation::verify_report(*run, words); }};
}

}  // namespace

void add_verify_function(py::module_& module) {
  module.def("verify", &verify, py::arg("quick"), py::arg("only"), py::arg("progress"),
             "Every claim of the paper, checked.");
}

}  // namespace clatter::python

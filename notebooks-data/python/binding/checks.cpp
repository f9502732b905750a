#include <pybind11/stl.h>

#include <memory>

#include "interruptible.hpp"
#include "report.hpp"
#include "runs.hpp"
#include "validation/reports/verify_report.hpp"
#include "validation/verify/selection.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::Check;
using validation::CheckResult;

Report verify(bool quick, const std::vector<std::string>& only) {
  const validation::CheckSelection selection = validation::select_checks(quick, only);
  auto results = run_interruptible([&](const std::function<bool()>& goes_on) {
    validation::CaseRuns case_runs;
    case_runs.goes_on = goes_on;
    return validation::verify(selection.checks, case_runs,
                              [&](std::size_t, std::size_t, const std::string&) { return goes_on(); });
  });
  const auto run = std::make_shared<const std::vector<CheckResult>>(std::move(results));
  const std::string words = selection.words;
  return {[run, words] { return validation::verify_report(*run, words); }};
}

}  // namespace

void add_verify_function(py::module_& module) {
  module.def("verify", &verify, py::arg("quick"), py::arg("only"), "Every claim of the paper, checked.");
}

}  // namespace clatter::python

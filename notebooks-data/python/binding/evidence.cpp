// SPDX-License-Identifier: GPL-3.0-or-later
// What judges the models and others' programs: measured drops, the benchmark, the map of extremes, figures.
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>

#include "binding.hpp"
#include "validation/benchmark/benchmark_report.hpp"
#include "validation/evidence/check.hpp"
#include "validation/evidence/extremes.hpp"
#include "validation/evidence/figure.hpp"
#include "validation/measured/measured_report.hpp"
#include "validation/output/bad_input.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::NamedTexts;

Report verify(bool quick, const std::vector<std::string>& only, const py::object& progress) {
  const auto work = [selection = validation::select_checks(quick, only)](const Watch& watch) -> Report {
    validation::CaseRuns case_runs;
    case_runs.goes_on = watch;
    const auto tell = [&](std::size_t done, std::size_t of, const std::string&) { return watch.tell(done, of); };
    auto checked = validation::verify_checks(selection.checks, case_runs, tell);
    watch.tell(checked.size(), selection.checks.size());
    return kept(validation::verify_report(checked, selection.words));
  };
  return run_interruptible(work, progress);
}

/// @param action  fit, predict or score
Report measured(const std::string& action, const std::string& file, const NamedTexts& options) {
  validation::MeasuredRequest request;
  request.file = file;
  take(measured_arguments(request), options);
  return run_interruptible([request, action](const Watch&) {
    const validation::MeasuredRun run = validation::read_measured_run(request);
    if (action == "fit") return kept(validation::measured_fit_report(run));
    const validation::Scores scores = score_measured(run.file, run.fit, run.split.scored, true);
    return kept(action == "predict" ? measured_predict_report(run, scores) : measured_score_report(run, scores));
  });
}

Report benchmark_list() {
  return kept(run_interruptible([](const Watch&) { return validation::benchmark_list_report(); }));
}

Report benchmark_show(const std::string& id) {
  return kept(run_interruptible(
      [id](const Watch&) { return validation::benchmark_statement(validation::problem_named("problem", id)); }));
}

Report benchmark_truth(const std::string& id, const std::optional<std::string>& law) {
  return kept(run_interruptible([id, law](const Watch&) {
    const validation::Problem& problem = validation::problem_named("problem", id);
    const std::string only = validation::truth_laws(problem).front();
    const std::string asked = law ? validation::read_law("law", *law) : only;
    return benchmark_truth_report(problem, only == "any" ? only : asked);
  }));
}

using Submissions = std::vector<validation::Submission>;
using Judge = std::function<validation::Submission(const std::string& file, const validation::ColumnNames& names)>;
using Tell = std::function<validation::Report(const Submissions& all)>;

/// `judge` of each file.  @returns (report, whether all do what `require` asks)
std::pair<Report, bool> judged(const std::vector<std::string>& files, const NamedTexts& options, const Watch& watch,
                               const Judge& judge, const Tell& report_of) {
  const auto require = given(options, "require"), columns = given(options, "columns");
  const validation::Requirement requirement =
      require ? validation::read_requirement("--require", *require) : validation::Requirement{};
  const validation::ColumnNames names =
      columns ? validation::read_column_names("columns", *columns) : validation::ColumnNames{};
  Submissions submissions;
  for (const std::string& file : files) {
    if (!watch.tell(submissions.size(), files.size())) break;
    submissions.push_back(judge(file, names));
  }
  watch.tell(submissions.size(), files.size());
  const bool is_met =
      std::all_of(submissions.begin(), submissions.end(), [&](const auto& one) { return requirement.is_met(one); });
  return {kept(report_of(submissions)), is_met};
}

py::tuple benchmark_score(const std::vector<std::string>& files, const NamedTexts& options,
                          const py::object& progress) {
  const auto work = [files, options](const Watch& watch) {
    const std::string problem = given(options, "problem").value_or("");
    return judged(
        files, options, watch,
        [&](const std::string& file, const auto& names) { return validation::judge_file(file, problem, names); },
        [](const Submissions& all) { return validation::score_report("benchmark", all, false); });
  };
  return py::cast(run_interruptible(work, progress));
}

py::tuple compare_against(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
                          const std::vector<std::string>& files, const NamedTexts& options,
                          const py::object& progress) {
  const auto work = [source = SceneSource{name, text, changes}, files, options](const Watch& watch) {
    const validation::Scene scene = source.read(validation::Model::discrete);
    if (scene.sweep) throw validation::BadInput("sweep: runs of others are judged by a scene that sweeps nothing");
    const validation::Reference reference = reference_of(scene);
    return judged(
        files, options, watch,
        [&](const std::string& file, const auto& names) { return judge_file(file, reference, names); },
        [&](const Submissions& all) { return against_report(scene, reference, all, true); });
  };
  return py::cast(run_interruptible(work, progress));
}

Report extremes(const std::vector<std::string>& only, bool quick, std::uint64_t seed, double seconds,
                const py::object& progress) {
  std::vector<std::string> names;
  for (const validation::MapAxis& axis : validation::map_axes()) names.push_back(axis.name);
  for (const std::string& name : only) static_cast<void>(validation::read_name_option("only", name, names));
  validation::ExtremesOptions options;
  options.axes = only;
  options.long_runs = !quick;
  options.runs.seed = seed;
  options.cell_seconds = seconds;
  const auto work = [options](const Watch& watch) {
    validation::ExtremesOptions watched = options;
    watched.progress = [&](std::size_t done, std::size_t of) { return watch.tell(done, of); };
    return extremes_report(measure_extremes(watched));
  };
  return kept(run_interruptible(work, progress));
}

Report figure(int number, const validation::FigureParameters& parameters, const NamedTexts& changes) {
  const std::vector<int>& known = validation::figure_numbers();
  if (std::find(known.begin(), known.end(), number) == known.end()) {
    throw validation::BadInput(fmt::format("figure {}: there is none; there are {}", number, fmt::join(known, ", ")));
  }
  return run_interruptible([number, parameters, changes](const Watch& watch) {
    validation::CaseRuns case_runs;
    case_runs.goes_on = watch;
    case_runs.changes = validation::scene_overrides(changes);
    return kept(figure_report(validation::make_figure(number, case_runs, parameters)));
  });
}

}  // namespace

void add_evidence_functions(py::module_& module) {
  module.def("verify", &verify, py::arg("quick"), py::arg("only"), py::arg("progress"),
             "Every claim of the paper, checked.");
  module.def("measured", &measured, py::arg("action"), py::arg("file"), py::arg("options"),
             "Impact laws against tracked drops.");
  module.def("benchmark_list", &benchmark_list, "The problems with certified answers.");
  module.def("benchmark_show", &benchmark_show, py::arg("id"), "The statement of a problem.");
  module.def("benchmark_truth", &benchmark_truth, py::arg("id"), py::arg("law"), "The certified answer of a problem.");
  module.def("benchmark_score", &benchmark_score, py::arg("files"), py::arg("options"), py::arg("progress"),
             "Others' answers, scored.");
  module.def("compare_against", &compare_against, py::arg("name"), py::arg("text"), py::arg("changes"),
             py::arg("files"), py::arg("options"), py::arg("progress"), "Others' runs of a scene, scored.");
  module.def("extremes", &extremes, py::arg("only"), py::arg("quick"), py::arg("seed"), py::arg("seconds"),
             py::arg("progress"), "The map of what holds.");
  module.def(
      "figure",
      [](int number, const std::vector<double>& angles, const std::vector<double>& gravity_numbers,
         const NamedTexts& changes) {
        return figure(number, {angles, gravity_numbers}, changes);
      },
      py::arg("number"), py::arg("angles"), py::arg("gravity_numbers"), py::arg("changes"),
      "The data of a figure of the paper, or of one like it.");
}

}  // namespace clatter::python

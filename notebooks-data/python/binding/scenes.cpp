// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <map>
#include <memory>

#include "history.hpp"
#include "interruptible.hpp"
#include "report.hpp"
#include "runs.hpp"
#include "scene_source.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/record/history_file.hpp"
#include "validation/reports/simulation_report.hpp"
#include "validation/reports/swept_comparison_report.hpp"
#include "validation/scene/named_texts.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::NamedTexts;
using validation::PlannedRun;
using validation::Scene;

Scene read_scene(const SceneSource& source, const NamedTexts& given) {
  return read_scene(source.values(), validation::scene_overrides(given), validation::Model::continuous);
}

/// @param seen  is told the number of impacts that are done, and says whether to go on.
PlannedRun run_scene(const Scene& scene, const std::function<bool(int)>& seen, numeric::HistoryRecorder* history) {
  const numeric::Body body = scene.make_body();
  const numeric::Observer observer{.history = history, .progress = [&](int impacts, long) { return seen(impacts); }};
  const numeric::MotionState start = scene.start(body);
  if (history && scene.height) validation::record_fall(*history, start, body.mass(), scene.world.gravity, 20);
  return validation::run_to_digits(body, scene.world, start, scene.request, scene.accuracy, observer);
}

struct ContinuousRun {
  Scene scene;
  PlannedRun planned;
};

struct SweptRuns {
  Scene scene;
  std::vector<validation::SweptRun> runs;
};

Report single_report(Scene scene, PlannedRun planned) {
  const auto run = std::make_shared<const ContinuousRun>(ContinuousRun{std::move(scene), std::move(planned)});
  return {[run] { return validation::simulation_report(run->scene, run->planned); }};
}

Report swept_report(const Scene& scene, const Watch& watch) {
  SweptRuns swept{scene, {}};
  const std::vector<double> values = scene.sweep->values();
  for (const double value : values) {
    if (!watch.tell(swept.runs.size(), values.size())) break;
    const Scene one = scene.at(value);
    swept.runs.push_back({value, one,
                          run_scene(
                              one, [&](int) { return watch(); }, nullptr)});
  }
  watch.tell(swept.runs.size(), values.size());
  const auto run = std::make_shared<const SweptRuns>(std::move(swept));
  return {[run] { return validation::sweep_report(run->scene, run->runs); }};
}

/// (report, history or None)
py::tuple simulate(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
                   bool with_history, const py::object& progress) {
  const Scene scene = read_scene({name, text}, changes);
  History history;
  const auto work = [&](const Watch& watch) {
    if (scene.sweep) return swept_report(scene, watch);
    const auto asked = static_cast<std::size_t>(scene.request.impacts);
    const auto seen = [&](int impacts) { return watch.tell(static_cast<std::size_t>(impacts), asked); };
    PlannedRun planned = run_scene(scene, seen, with_history ? &history : nullptr);
    watch.tell(planned.run.impacts.size(), asked);
    return single_report(scene, std::move(planned));
  };
  Report report = run_interruptible(work, progress);
  return py::make_tuple(std::move(report), with_history && !scene.sweep ? py::object(history.arrays()) : py::none());
}

struct ComparedScene {
  Scene scene;
  std::vector<validation::SweptComparison> values;  ///< one, or one per swept value
};

Report compare(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
               const py::object& progress) {
  const Scene scene = read_scene({name, text}, changes);
  ComparedScene compared{scene, {}};
  const auto work = [&](const Watch& watch) {
    const numeric::Body body = scene.make_body();
    const std::vector<double> values = scene.sweep ? scene.sweep->values() : std::vector<double>{0};
    for (const double value : values) {
      if (!watch.tell(compared.values.size(), values.size())) break;
      compared.values.push_back({value, compare_models(scene.sweep ? scene.at(value) : scene, body)});
    }
    return watch.tell(compared.values.size(), values.size());
  };
  run_interruptible(work, progress);
  const auto run = std::make_shared<const ComparedScene>(std::move(compared));
  return {[run] {
    return run->scene.sweep ? validation::swept_comparison_report(run->scene, run->values)
                            : validation::comparison_report(run->scene, run->values[0].comparison);
  }};
}

/// Name to text of the scene files that the program carries.
std::map<std::string, std::string> cases() {
  std::map<std::string, std::string> texts;
  for (const std::string& name : validation::case_names()) texts.emplace(name, validation::case_text(name));
  return texts;
}

}  // namespace

void add_scene_functions(py::module_& module) {
  module.def("simulate", &simulate, py::arg("name"), py::arg("text"), py::arg("changes"), py::arg("history"),
             py::arg("progress"), "Drop of any body, continuous contact.");
  module.def("compare", &compare, py::arg("name"), py::arg("text"), py::arg("changes"), py::arg("progress"),
             "Both models over the same scene.");
  module.def("cases", &cases, "Texts of the scene files that the program carries, by name.");
}

}  // namespace clatter::python

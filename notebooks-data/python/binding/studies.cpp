// SPDX-License-Identifier: GPL-3.0-or-later
#include <pybind11/stl.h>

#include <memory>
#include <thread>

#include "interruptible.hpp"
#include "report.hpp"
#include "runs.hpp"
#include "scene_source.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/reports/plan_report.hpp"
#include "validation/reports/tradeoff_report.hpp"
#include "validation/scene/named_texts.hpp"
#include "validation/sweep/rows.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::NamedTexts;
using validation::Scene;

using GoesOn = std::function<bool()>;

Scene read_scene(const SceneSource& source, const NamedTexts& given) {
  return read_scene(source.values(), validation::scene_overrides(given), validation::Model::continuous);
}

struct PlannedScene {
  Scene scene;
  validation::Plan plan;
};

/// (report, why it does not give what was asked, or "")
py::tuple plan(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
               const std::optional<std::string>& within) {
  const Scene scene = read_scene({name, text}, changes);
  const auto is_given = [&](const char* argument) { return changes.contains(argument); };
  const validation::PlanTarget target = validation::plan_target(scene, {within, is_given});
  const auto planned = run_interruptible([&](const GoesOn& goes_on) {
    validation::Plan made = make_plan(scene, target, {.progress = [&](int, long) { return goes_on(); }});
    return std::make_shared<const PlannedScene>(PlannedScene{scene, std::move(made)});
  });
  return py::make_tuple(Report{[planned] { return plan_report(planned->scene, planned->plan); }},
                        plan_shortfall(planned->plan));
}

struct MeasuredScene {
  Scene scene;
  validation::Tradeoff tradeoff;
};

/// (report, why the reference falls short, or "")
py::tuple tradeoff(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
                   const py::object& progress) {
  const Scene scene = read_scene({name, text}, changes);
  if (scene.sweep) throw validation::BadInput("sweep: a sweep has no tradeoff; leave out [sweep]");
  const auto work = [&](const Watch& watch) {
    validation::TradeoffOptions options;
    std::size_t all = 0;
    options.progress = [&](std::size_t done, std::size_t of) { return watch.tell(done, all = of); };
    MeasuredScene made{scene, measure_tradeoff(scene, options)};
    watch.tell(all, all);
    return std::make_shared<const MeasuredScene>(std::move(made));
  };
  const auto measured = run_interruptible(work, progress);
  return py::make_tuple(Report{[measured] { return tradeoff_report(measured->scene, measured->tradeoff); }},
                        measured->tradeoff.shortfall);
}

/// All rows on all cores.
std::string rows_of(const validation::SweepPlan& plan, const Watch& watch) {
  const validation::SweepBody body =
      plan.body_values.empty() ? make_sweep_body(plan, plan.scene) : validation::SweepBody{};
  validation::RangeQueue queue({0, plan.points.count()}, range_size(plan));
  std::string rows;
  std::size_t done = 0;
  const auto count = static_cast<std::size_t>(plan.points.count());
  validation::SweepHooks hooks;
  hooks.write = [&](const validation::RangeRows& some) {
    rows += some.text;
    done += static_cast<std::size_t>(some.scenes);
    watch.tell(done, count);
  };
  hooks.tick = [] {};
  hooks.stop = [&] { return !watch(); };
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  run_on_threads(queue, threads, runners_of(plan, body), hooks);
  return rows;
}

/// (report, how many scenes fall short and why the first, or "")
py::tuple sweep(const std::string& name, const std::optional<std::string>& text, const std::vector<std::string>& sets,
                const NamedTexts& options, const py::object& progress) {
  const auto option = [&](const char* word) -> std::optional<std::string> {
    const auto found = options.find(word);
    return found == options.end() ? std::nullopt : std::optional(found->second);
  };
  const validation::SweepPlan plan = validation::read_sweep_plan({.file = name,
                                                                  .text = text,
                                                                  .sets = sets,
                                                                  .random = option("random"),
                                                                  .seed = option("seed"),
                                                                  .model = option("model"),
                                                                  .rows = option("rows"),
                                                                  .columns = option("columns")});
  const std::string rows = run_interruptible([&](const Watch& watch) { return rows_of(plan, watch); }, progress);
  validation::ShortfallCount shortfalls(plan.layout);
  shortfalls.add(rows);
  const auto report = std::make_shared<validation::Report>(plan.report());
  report->grid.rows = validation::read_csv_rows(rows);
  report->fields["rows"] = row_objects(report->grid);
  return py::make_tuple(Report{[report] { return *report; }}, shortfalls.found().first());
}

}  // namespace

void add_study_functions(py::module_& module) {
  module.def("plan", &plan, py::arg("name"), py::arg("text"), py::arg("changes"), py::arg("within"),
             "The smallest model that serves.");
  module.def("tradeoff", &tradeoff, py::arg("name"), py::arg("text"), py::arg("changes"), py::arg("progress"),
             "Cost against error.");
  module.def("sweep", &sweep, py::arg("name"), py::arg("text"), py::arg("sets"), py::arg("options"),
             py::arg("progress"), "Many scenes, a row each.");
}

}  // namespace clatter::python

// SPDX-License-Identifier: GPL-3.0-or-later
// The continuous model, both models together, and studies of scenes.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <thread>

#include "binding.hpp"
#include "numeric/drop/history.hpp"
#include "validation/compare/comparison.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/plan/plan.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/plan/tradeoff_report.hpp"
#include "validation/run/history_file.hpp"
#include "validation/scene/probes.hpp"
#include "validation/simulate/simulation_report.hpp"
#include "validation/sweep/rows.hpp"
#include "validation/sweep/summary.hpp"
#include "validation/sweep/sweep_run.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using numeric::HistorySample;
using validation::Model;
using validation::NamedTexts;
using validation::PlannedRun;
using validation::Scene;
using Samples = std::vector<HistorySample>;

template <class Number, class Get>
py::array_t<Number> column(const Samples& samples, const Get& get) {
  py::array_t<Number> array(static_cast<py::ssize_t>(samples.size()));
  auto values = array.template mutable_unchecked<1>();
  for (std::size_t i = 0; i < samples.size(); ++i) values(static_cast<py::ssize_t>(i)) = get(samples[i]);
  return array;
}

/// `get` gives a vector with operator[].
template <int Size, class Get>
py::array_t<double> columns(const Samples& samples, const Get& get) {
  py::array_t<double> array({static_cast<py::ssize_t>(samples.size()), static_cast<py::ssize_t>(Size)});
  auto values = array.mutable_unchecked<2>();
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto vector = get(samples[i]);
    for (int k = 0; k < Size; ++k) values(static_cast<py::ssize_t>(i), k) = vector[k];
  }
  return array;
}

Eigen::Vector4d euler_parameters(const HistorySample& sample) {
  const Eigen::Quaterniond& beta = sample.state.attitude;
  return {beta.w(), beta.x(), beta.y(), beta.z()};
}

numeric::Vector3 world_angular_velocity(const HistorySample& sample) {
  return sample.state.attitude * sample.state.angular_velocity;
}

/// One array a quantity, (n) or (n, 3) or (n, 4); SI, world frame.
py::dict arrays_of(const Samples& s) {
  py::dict arrays;
  arrays["time"] = column<double>(s, [](const HistorySample& at) { return at.time; });
  arrays["centre"] = columns<3>(s, [](const HistorySample& at) { return at.state.centre; });
  arrays["attitude"] = columns<4>(s, euler_parameters);
  arrays["velocity"] = columns<3>(s, [](const HistorySample& at) { return at.state.velocity; });
  arrays["angular_velocity"] = columns<3>(s, world_angular_velocity);
  arrays["force"] = columns<3>(s, [](const HistorySample& at) { return at.force; });
  arrays["point_velocity"] = columns<3>(s, [](const HistorySample& at) { return at.point_velocity; });
  arrays["energy_translation"] = column<double>(s, [](const HistorySample& at) { return at.energy_translation; });
  arrays["energy_rotation"] = column<double>(s, [](const HistorySample& at) { return at.energy_rotation; });
  arrays["energy_potential"] = column<double>(s, [](const HistorySample& at) { return at.energy_potential; });
  arrays["energy_ground"] = column<double>(s, [](const HistorySample& at) { return at.energy_ground; });
  arrays["energy_total"] = column<double>(s, [](const HistorySample& at) { return at.energy_total(); });
  arrays["in_contact"] = column<bool>(s, [](const HistorySample& at) { return at.in_contact; });
  return arrays;
}

/// @param seen  is told the number of impacts that are done, and says whether to go on.
PlannedRun run_scene(const Scene& scene, const std::function<bool(int)>& seen,
                     const numeric::HistoryRecorder& history) {
  const numeric::Body body = scene.make_body();
  const numeric::Observer observer{.history = history, .progress = [&](int impacts, long) { return seen(impacts); }};
  double fall = 0;
  const numeric::MotionState start = scene.start(body, &fall);
  if (history) validation::record_fall(history, body, scene.world, start, fall, 20);
  return validation::run_to_digits(scene, body, observer);
}

/// A report, and what its runs warn of, each once.  That it goes deep stands in the report: soft grounds, as those of
/// the cases, are asked for by whoever looks at how a contact goes.
struct Told {
  Report report;
  std::vector<std::string> warnings;

  void add(const PlannedRun& run) {
    for (const std::string& warning : run.warnings)
      if (warning != run.deep && std::ranges::find(warnings, warning) == warnings.end()) warnings.push_back(warning);
  }
};

Told single_report(const Scene& scene, const Watch& watch, const numeric::HistoryRecorder& history) {
  const auto asked = static_cast<std::size_t>(scene.request.impacts);
  const auto seen = [&](int impacts) { return watch.tell(static_cast<std::size_t>(impacts), asked); };
  const auto run = std::make_shared<const PlannedRun>(run_scene(scene, seen, history));
  watch.tell(run->run.impacts.size(), asked);
  Told told{{[scene, run] { return validation::simulation_report(scene, *run); }}, {}};
  told.add(*run);
  return told;
}

Told swept_report(const Scene& scene, const Watch& watch) {
  std::vector<validation::SweptRun> runs;
  const std::vector<double> values = scene.sweep->values();
  for (const double value : values) {
    if (!watch.tell(runs.size(), values.size())) break;
    const Scene one = scene.at(value);
    const auto seen = [&](int) { return watch(); };
    runs.push_back({value, one, run_scene(one, seen, nullptr)});
  }
  watch.tell(runs.size(), values.size());
  const auto done = std::make_shared<const std::vector<validation::SweptRun>>(std::move(runs));
  Told told{{[scene, done] { return validation::sweep_report(scene, *done); }}, {}};
  for (const validation::SweptRun& run : *done) told.add(run.planned);
  return told;
}

/// (report, history or None, what is doubted of the scene and what its runs warn of)
py::tuple simulate(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
                   bool with_history, const py::object& progress) {
  const auto history = with_history ? std::make_shared<Samples>() : nullptr;
  numeric::HistoryRecorder recorder;
  if (history) recorder = [history](const HistorySample& sample) { history->push_back(sample); };
  const auto work = [source = SceneSource{name, text, changes}, recorder](const Watch& watch) {
    const Scene scene = source.read(Model::continuous);
    const bool sweeps = scene.sweep.has_value();
    Told told = sweeps ? swept_report(scene, watch) : single_report(scene, watch, recorder);
    std::vector<std::string> said = doubts_of(scene, Model::continuous, {});
    said.insert(said.end(), told.warnings.begin(), told.warnings.end());
    return std::tuple(std::move(told.report), sweeps, std::move(said));
  };
  const auto [report, sweeps, doubts] = run_interruptible(work, progress);
  return py::make_tuple(report, history && !sweeps ? py::object(arrays_of(*history)) : py::none(), doubts);
}

Report compare(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
               const py::object& progress) {
  const auto work = [source = SceneSource{name, text, changes}](const Watch& watch) -> Report {
    const Scene scene = source.read(Model::continuous);
    const numeric::Body body = scene.make_body();
    const std::vector<double> values = scene.sweep ? scene.sweep->values() : std::vector<double>{0};
    std::vector<validation::SweptComparison> compared;
    for (const double value : values) {
      if (!watch.tell(compared.size(), values.size())) break;
      compared.push_back({value, compare_models(scene.sweep ? scene.at(value) : scene, body)});
    }
    watch.tell(compared.size(), values.size());
    const auto run = std::make_shared<const std::vector<validation::SweptComparison>>(std::move(compared));
    return {[scene, run] {
      return scene.sweep ? validation::swept_comparison_report(scene, *run)
                         : validation::comparison_report(scene, run->at(0).comparison);
    }};
  };
  return run_interruptible(work, progress);
}

/// (report, why it does not give what was asked, or "")
py::tuple plan(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
               const std::optional<std::string>& given_within) {
  std::optional<double> within;
  if (given_within) validation::take({validation::within_argument(within)}, {{"within", *given_within}});
  const auto work = [source = SceneSource{name, text, changes}, within](const Watch& watch) {
    const Scene scene = source.read(Model::continuous);
    const auto is_given = [&](const char* argument) { return source.changes.contains(argument); };
    const validation::PlanTarget target = validation::plan_target(scene, {within, is_given});
    validation::Plan made = make_plan(scene, target, {.progress = [&](int, long) { return watch(); }});
    made.given = validation::scene_overrides(source.changes);
    return std::pair(kept(plan_report(scene, made)), plan_shortfall(made));
  };
  return py::cast(run_interruptible(work));
}

/// (report, why the reference falls short, or "")
py::tuple tradeoff(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
                   const py::object& progress) {
  const auto work = [source = SceneSource{name, text, changes}](const Watch& watch) {
    const Scene scene = source.read(Model::continuous);
    if (scene.sweep) throw validation::BadInput("sweep: a sweep has no tradeoff; leave out [sweep]");
    validation::TradeoffOptions options;
    std::size_t all = 0;
    options.progress = [&](std::size_t done, std::size_t of) { return watch.tell(done, all = of); };
    const validation::Tradeoff measured = measure_tradeoff(scene, options);
    watch.tell(all, all);
    return std::pair(kept(tradeoff_report(scene, measured)), measured.shortfall);
  };
  return py::cast(run_interruptible(work, progress));
}

/// All rows on all cores, some at a time.
void sweep_rows(const validation::SweepPlan& plan, const Watch& watch,
                const std::function<void(const std::string&)>& take) {
  const validation::SweepBody body =
      plan.body_values.empty() ? make_sweep_body(plan, plan.scene) : validation::SweepBody{};
  validation::RangeQueue queue({0, plan.points.count()}, range_size(plan));
  std::size_t done = 0;
  const auto count = static_cast<std::size_t>(plan.points.count());
  validation::SweepHooks hooks;
  hooks.write = [&](const validation::RangeRows& some) {
    take(some.text);
    done += static_cast<std::size_t>(some.scenes);
    watch.tell(done, count);
  };
  hooks.tick = [] {};
  hooks.stop = [&] { return !watch(); };
  const int threads = static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  run_on_threads(queue, threads, runners_of(plan, body), hooks);
}

/// The rows of a sweep, or with `summary` what they are together.
/// @param commands  whether a command can show a scene: not of a dict, nor of keys alone
validation::Report swept(const validation::SweepPlan& plan, bool summary, bool commands, const Watch& watch,
                         validation::ShortfallCount& shortfalls) {
  validation::Report report = plan.report();
  std::string rows;
  std::optional<validation::Summary> together;
  if (summary) together.emplace(plan.layout, plan.points);
  sweep_rows(plan, watch, [&](const std::string& some) {
    shortfalls.add(some);
    if (together) together->add(some);
    else rows += some;
  });
  if (together) {
    together->fill(
        report,
        [&](long long index, const std::string& column) { return commands ? plan.command_of(index, column) : ""; },
        [&](long long place) { return plan.attitude_name(place); });
    if (!commands) report.commands.clear();
  } else {
    report.grid.rows = validation::read_csv_rows(rows);
  }
  report.fields["rows"] = row_objects(report.grid);
  return report;
}

/// (report, how many scenes fall short and why the first, or "", what else is to be said)
py::tuple sweep(const std::string& name, const std::optional<std::string>& text, const std::vector<std::string>& sets,
                const std::vector<std::string>& probes, const NamedTexts& options, bool summary,
                const py::object& progress) {
  validation::SweepRequest request;
  request.probes = probes;
  request.summary = summary;
  request.file = name;
  request.text = text;
  request.sets = sets;
  take(sweep_arguments(request), options);
  const auto work = [request](const Watch& watch) {
    validation::SweepPlan plan = validation::read_sweep_plan(request);
    plan.packed = request.summary;
    validation::ShortfallCount shortfalls(plan.layout, plan.packed);
    const bool is_named = !request.file.empty() && !(request.text && request.file == "scene");
    validation::Report report = swept(plan, request.summary, is_named, watch, shortfalls);
    std::vector<std::string> said = doubts_of(plan.scene, plan.layout.model, plan.layout.probes);
    for (std::string& remark : plan.remarks(request.summary ? 0 : shortfalls.cut())) said.push_back(std::move(remark));
    const std::string aside = shortfalls.told(plan.points.count()).set_aside;
    if (!aside.empty()) said.push_back(aside);
    return std::tuple(kept(std::move(report)), shortfalls.found().first(), said);
  };
  return py::cast(run_interruptible(work, progress));
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
  module.def("plan", &plan, py::arg("name"), py::arg("text"), py::arg("changes"), py::arg("within"),
             "The smallest model that serves.");
  module.def("tradeoff", &tradeoff, py::arg("name"), py::arg("text"), py::arg("changes"), py::arg("progress"),
             "Cost against error.");
  module.def("sweep", &sweep, py::arg("name"), py::arg("text"), py::arg("sets"), py::arg("probes"), py::arg("options"),
             py::arg("summary"), py::arg("progress"), "Many scenes, a row each, or what they are together.");
  module.def("cases", &cases, "Texts of the scene files that the program carries, by name.");
}

}  // namespace clatter::python

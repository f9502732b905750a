// SPDX-License-Identifier: GPL-3.0-or-later
// The discrete model: drops of any body, and the thin rod.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <span>

#include "analytic/batch/rod_batch.hpp"
#include "analytic/plane/sequence.hpp"
#include "binding.hpp"
#include "validation/explain/explanation_report.hpp"
#include "validation/gradient/gradient_report.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/rod/rod.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/probes.hpp"
#include "validation/sequence/sequence_report.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::AnglesRequest;
using validation::NamedTexts;
using validation::PreparedScene;

PreparedScene read_discrete(const SceneSource& source) {
  return validation::read_discrete_scene(source.values(), validation::scene_overrides(source.changes));
}

/// (report, why it falls short, its outcome, number of impacts, warnings and doubts): what a call looks at without the
/// report.
py::tuple sequence(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes,
                   const std::string& method) {
  const auto [scene, run] = run_interruptible([source = SceneSource{name, text, changes}, method](const Watch&) {
    const auto prepared = std::make_shared<const PreparedScene>(read_discrete(source));
    validation::read_sequence_method("--method", method);
    return std::pair(prepared, std::make_shared<const validation::DiscreteRun>(validation::run_discrete(*prepared)));
  });
  const validation::Run& told = run->run;
  std::vector<std::string> said = validation::doubts_of(scene->scene, validation::Model::discrete, {});
  said.insert(said.end(), told.warnings.begin(), told.warnings.end());
  return py::make_tuple(Report{[scene = scene, run = run] { return validation::sequence_report(*scene, *run); }},
                        shortfall(scene->scene, told), told.outcome, told.impacts.size(), said);
}

/// (report, warnings)
py::tuple explain(int impact, const std::string& name, const std::optional<std::string>& text,
                  const NamedTexts& changes) {
  if (impact < 1) throw validation::BadInput(fmt::format("impact {}: must be at least 1", impact));
  const auto found = run_interruptible([impact, source = SceneSource{name, text, changes}](const Watch&) {
    return std::make_shared<const validation::Explanation>(validation::explain_impact(read_discrete(source), impact));
  });
  return py::make_tuple(Report{[found] { return validation::explanation_report(*found); },
                               [found](const validation::TextStyle& style) { return explanation_text(*found, style); }},
                        found->warnings);
}

/// (report, what it lacks)
py::tuple gradient(const std::string& name, const std::optional<std::string>& text, const NamedTexts& changes) {
  const auto made = run_interruptible([source = SceneSource{name, text, changes}](const Watch&) {
    return validation::gradient_report(read_discrete(source));
  });
  return py::make_tuple(kept(made.report), made.shortfall);
}

Report regimes(const NamedTexts& options) {
  validation::RegimesRequest request;
  take(regimes_arguments(request), options);
  return kept(run_interruptible([request](const Watch&) { return find_regimes(request).report; }));
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// @throws BadInput unless the angle lies from 0 to 90 degrees.
void check_angle(double theta) {
  if (theta >= 0 && theta <= 90) return;
  throw validation::BadInput(fmt::format("theta {}: must be from 0 to 90 degrees", theta));
}

/// The range of `given`, or these angles.
AnglesRequest request_of(const std::optional<Numbers>& theta, const NamedTexts& given) {
  validation::AnglesOptions options;
  take(angles_arguments(options), given);
  AnglesRequest request = angles_request(options);
  if (!theta) return request;
  for (const char* const name : {"from", "to", "step", "count"}) {
    if (given.contains(name)) throw validation::BadInput("theta: excludes start, stop, step and count");
  }
  std::vector<double> values(theta->data(), theta->data() + theta->size());
  for (const double value : values) check_angle(value);
  request.count = static_cast<long long>(values.size());
  request.theta = [values = std::move(values)](long long i) { return values[static_cast<std::size_t>(i)]; };
  return request;
}

/// Row after row.
std::vector<double> rows_of(const AnglesRequest& request, std::size_t width, const py::object& progress) {
  const auto work = [request, width](const Watch& watch) {
    const auto count = static_cast<std::size_t>(request.count);
    std::vector<double> rows(count * width);
    for (std::size_t i = 0; i < count && watch.tell(i, count); ++i) {
      const validation::AnglesRow row = validation::angles_row(request, static_cast<long long>(i));
      std::copy_n(row.begin(), width, rows.begin() + static_cast<std::ptrdiff_t>(i * width));
    }
    watch.tell(count, count);
    return rows;
  };
  return run_interruptible(work, progress);
}

/// (report, column name to array)
py::tuple angles(const std::optional<Numbers>& theta, const NamedTexts& given, const py::object& progress) {
  const AnglesRequest request = request_of(theta, given);
  const std::vector<validation::Column> columns = validation::angles_columns(request);
  const std::vector<double> rows = rows_of(request, columns.size(), progress);
  py::dict arrays;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    py::array_t<double> array(request.count);
    double* const values = array.mutable_data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(request.count); ++i) values[i] = rows[i * columns.size() + k];
    arrays[py::str(columns[k].name)] = columns[k].name == "impacts" ? py::object(array.attr("astype")("int64")) : array;
  }
  return py::make_tuple(Report{[request] { return validation::angles_report(request); }}, arrays);
}

constexpr std::array batch_columns{"beta_deg", "gamma_deg", "P1", "P2", "P3", "T1", "T2", "impacts"};
using BatchColumns = std::array<std::vector<double>, batch_columns.size()>;

/// Column after column.
std::shared_ptr<BatchColumns> rod_columns(const Numbers& theta, const AnglesRequest& request,
                                          const py::object& progress) {
  using analytic::degrees_per_radian;
  const std::vector<double> angles(theta.data(), theta.data() + theta.size());
  return run_interruptible(
      [angles, rod = request.rod](const Watch& watch) {
        const std::size_t all = angles.size();
        auto columns = std::make_shared<BatchColumns>();
        for (std::vector<double>& column : *columns) column.resize(all);
        std::vector<analytic::RodContacts> rows(std::min<std::size_t>(4096, all));
        for (std::size_t first = 0; first < all && watch.tell(first, all); first += rows.size()) {
          const std::size_t some = std::min(rows.size(), all - first);
          analytic::batch_contact_angles(std::span(angles).subspan(first, some), rod, std::span(rows).first(some));
          for (std::size_t i = 0; i < some; ++i) {
            const analytic::RodContacts& row = rows[i];
            const double numbers[] = {row.angle[0] * degrees_per_radian,
                                      row.angle[1] * degrees_per_radian,
                                      row.impulse[0],
                                      row.impulse[1],
                                      row.impulse[2],
                                      row.time[0],
                                      row.time[1],
                                      static_cast<double>(row.impacts)};
            for (std::size_t k = 0; k < columns->size(); ++k) (*columns)[k][first + i] = numbers[k];
          }
        }
        watch.tell(all, all);
        return columns;
      },
      progress);
}

/// (report, column name to array), by the batch
py::tuple angle_arrays(const Numbers& theta, const NamedTexts& given, const py::object& progress) {
  const AnglesRequest request = request_of(theta, given);
  const auto columns = rod_columns(theta, request, progress);
  const py::capsule owner(new std::shared_ptr(columns),
                          [](void* held) { delete static_cast<std::shared_ptr<BatchColumns>*>(held); });
  py::dict arrays;
  for (std::size_t k = 0; k < columns->size(); ++k) {
    const std::vector<double>& column = (*columns)[k];
    py::array_t<double> array(static_cast<py::ssize_t>(column.size()), column.data(), owner);
    arrays[batch_columns[k]] = k + 1 == columns->size() ? py::object(array.attr("astype")("int64")) : array;
  }
  return py::make_tuple(Report{[request] { return validation::angles_report(request); }}, arrays);
}

}  // namespace

void add_discrete_functions(py::module_& module) {
  module.def("sequence", &sequence, py::arg("name"), py::arg("text"), py::arg("changes"), py::arg("method"),
             "Impact sequence of a drop, in the plane or in space.");
  module.def("explain", &explain, py::arg("impact"), py::arg("name"), py::arg("text"), py::arg("changes"),
             "How an impact came about.");
  module.def("gradient", &gradient, py::arg("name"), py::arg("text"), py::arg("changes"),
             "Derivatives of the state after each impact.");
  module.def("regimes", &regimes, py::arg("options"), "Number of impacts of the thin rod, and its fold angles.");
  module.def("angles", &angles, py::arg("theta"), py::arg("options"), py::arg("progress"),
             "Contact angles of the thin rod.");
  module.def("angle_arrays", &angle_arrays, py::arg("theta"), py::arg("options"), py::arg("progress"),
             "Contact angles of the thin rod for many angles, by the batch.");
}

}  // namespace clatter::python

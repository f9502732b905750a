#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <memory>

#include "analytic/sequence.hpp"
#include "interruptible.hpp"
#include "report.hpp"
#include "runs.hpp"
#include "validation/cli/angles_report.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/rod_options.hpp"
#include "validation/cli/sequence_report.hpp"
#include "validation/plan/sequence_method.hpp"
#include "validation/scene/bad_input.hpp"
#include "validation/scene/named_texts.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::AnglesRequest;
using validation::RodTexts;
using validation::Scene;
using validation::SweepTexts;

using Given = validation::NamedTexts;
template <class Texts>
using Members = std::map<std::string, std::optional<std::string> Texts::*>;

// By the names of the flags, with "_" for "-".
const Members<SweepTexts> range_members{
    {"from", &SweepTexts::from}, {"to", &SweepTexts::to}, {"step", &SweepTexts::step}, {"count", &SweepTexts::count}};
const Members<RodTexts> rod_members{{"gravity_number", &RodTexts::gravity_number},
                                    {"gravity", &RodTexts::gravity},
                                    {"length", &RodTexts::length},
                                    {"speed", &RodTexts::speed},
                                    {"restitution", &RodTexts::restitution},
                                    {"impulse_ratio", &RodTexts::impulse_ratio}};

template <class Texts>
Texts texts_of(const Given& given, const Members<Texts>& members) {
  Texts texts;
  for (const auto& [name, text] : given) texts.*members.at(name) = text;
  return texts;
}

struct DiscreteRun {
  Scene scene;
  analytic::Sequence sequence;
};

Report sequence(const Given& given, const std::string& method) {
  const Scene scene = validation::read_scene(validation::scene_texts(given));
  const py::gil_scoped_release release;
  const auto run = std::make_shared<const DiscreteRun>(
      DiscreteRun{scene, validation::sequence_by_method(scene, validation::read_sequence_method(method))});
  return {.json = [run] { return validation::sequence_json(run->scene, run->sequence); },
          .table = [run] { return validation::sequence_table(run->scene, run->sequence); },
          .records = [run] { return validation::sequence_records(run->scene, run->sequence); }};
}

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// @throws BadInput unless the angle lies from 0 to 90 degrees.
void check_angle(double theta) {
  if (theta >= 0 && theta <= 90) return;
  throw validation::BadInput(fmt::format("theta {}: must be from 0 to 90 degrees", theta));
}

AnglesRequest request_of(const std::optional<Numbers>& theta, const Given& range, Given rod, bool as_printed) {
  AnglesRequest request;
  request.as_printed = as_printed;
  if (const auto digits = rod.extract("digits")) {
    request.digits = validation::read_integer_option("--digits", digits.mapped(), 1, 17);
  }
  request.rod = validation::read_rod(texts_of(rod, rod_members));
  if (!theta) {
    const validation::Sweep sweep =
        validation::read_sweep(texts_of(range, range_members), {0, 90, 5}, {0, 90, false, "from 0 to 90 degrees"});
    request.count = sweep.count;
    request.theta = [sweep](long long i) { return sweep.value(i); };
    return request;
  }
  if (!range.empty()) throw validation::BadInput("theta: excludes start, stop, step and count");
  std::vector<double> values(theta->data(), theta->data() + theta->size());
  for (const double value : values) check_angle(value);
  request.count = static_cast<long long>(values.size());
  request.theta = [values = std::move(values)](long long i) { return values[static_cast<std::size_t>(i)]; };
  return request;
}

/// Row after row.
std::vector<double> rows_of(const AnglesRequest& request, std::size_t width) {
  return run_interruptible([&](const std::function<bool()>& goes_on) {
    std::vector<double> rows(static_cast<std::size_t>(request.count) * width);
    for (long long i = 0; i < request.count && goes_on(); ++i) {
      const validation::AnglesRow row = validation::angles_row(request, i);
      std::copy_n(row.begin(), width, rows.begin() + i * static_cast<long long>(width));
    }
    return rows;
  });
}

/// (report, column name to array)
py::tuple angles(const std::optional<Numbers>& theta, const Given& range, const Given& rod, bool as_printed) {
  const AnglesRequest request = request_of(theta, range, rod, as_printed);
  const std::vector<validation::Column> columns = validation::angles_columns(request);
  const std::vector<double> rows = rows_of(request, columns.size());
  py::dict arrays;
  for (std::size_t k = 0; k < columns.size(); ++k) {
    py::array_t<double> array(request.count);
    double* const values = array.mutable_data();
    for (std::size_t i = 0; i < static_cast<std::size_t>(request.count); ++i) values[i] = rows[i * columns.size() + k];
    arrays[py::str(columns[k].name)] = columns[k].name == "impacts" ? py::object(array.attr("astype")("int64")) : array;
  }
  return py::make_tuple(Report{.json = [request] { return validation::angles_json(request); },
                               .table = [request] { return validation::angles_table(request); },
                               .records = [request] { return validation::angles_table(request); }},
                        arrays);
}

}  // namespace

void add_discrete_functions(py::module_& module) {
  module.def("sequence", &sequence, py::arg("options"), py::arg("method"), "Impact sequence of a rod or box.");
  module.def("angles", &angles, py::arg("theta"), py::arg("range"), py::arg("rod"), py::arg("as_printed"),
             "Contact angles of the thin rod.");
}

}  // namespace clatter::python

// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/plan/cost_table.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "validation/embedded/embedded.hpp"
#include "validation/output/number.hpp"
#include "validation/output/numeric_table.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {
namespace {

using numeric::Method;

constexpr double least_error = 1e-14;  // below it an error is rounding

/// One row of the table, as far as it is used.
struct CostEntry {
  std::string scene, model;
  Method method = Method::rkck;
  double tolerance = 0, evaluations = 0, error = 0;
};

std::size_t column(const Row& names, const std::string& name) {
  const auto found = std::ranges::find(names, name, [](const Cell& cell) { return cell.value.text(); });
  if (found == names.end()) throw std::runtime_error("the table of costs has no column " + name);
  return static_cast<std::size_t>(found - names.begin());
}

bool read_method(const std::string& name, Method& method) {
  for (const Method one : {Method::rk4, Method::rkf45, Method::rkck, Method::rk8pd}) {
    if (name == method_name(one)) {
      method = one;
      return true;
    }
  }
  return false;
}

/// The rows of adaptive methods on each scene's own mesh that have an error.
std::vector<CostEntry> read_entries(const std::string& csv) {
  const std::vector<Row> rows = read_csv_rows(csv);
  const Row names = rows.empty() ? Row{} : rows.front();
  const std::size_t scene = column(names, "scene"), model = column(names, "model"), method = column(names, "method"),
                    tolerance = column(names, "tolerance"), mesh = column(names, "mesh"),
                    evaluations = column(names, "force_evaluations"), error = column(names, "error");
  std::vector<CostEntry> entries;
  for (const Row& row : rows) {
    CostEntry entry;
    const double* const of_error = row.size() > error ? row[error].value.number() : nullptr;
    if (!of_error || !read_method(row[method].value.text(), entry.method) || !row[mesh].value.is_nothing()) continue;
    entries.push_back({.scene = row[scene].value.text(),
                       .model = row[model].value.text(),
                       .method = entry.method,
                       .tolerance = *row[tolerance].value.number(),
                       .evaluations = *row[evaluations].value.number(),
                       .error = std::max(*of_error, least_error)});
  }
  return entries;
}

/// What a scene's entries are relative to.
struct Base {
  double evaluations = 0, loose = 0, pilot = 0;
};

bool at_tolerance(const CostEntry& entry, double tolerance) {
  return std::fabs(std::log(entry.tolerance / tolerance)) < 0.01;
}

std::map<std::string, Base> bases_of(const std::vector<CostEntry>& entries) {
  std::map<std::string, Base> bases;
  for (const CostEntry& entry : entries) {
    if (entry.method != Method::rkck) continue;
    Base& base = bases[entry.scene + entry.model];
    if (at_tolerance(entry, CostTable::loose_tolerance)) base.loose = entry.error;
    if (!at_tolerance(entry, CostTable::pilot_tolerance)) continue;
    base.pilot = entry.error;
    base.evaluations = entry.evaluations;
  }
  return bases;
}

}  // namespace

double CostTable::error_constant(double error_at_loose, double error_at_pilot) {
  const double loose = std::max(error_at_loose, least_error) / loose_tolerance;
  const double pilot = std::max(error_at_pilot, least_error) / pilot_tolerance;
  return std::sqrt(loose * pilot);
}

CostTable::CostTable(const std::string& csv) {
  const std::vector<CostEntry> entries = read_entries(csv);
  const std::map<std::string, Base> bases = bases_of(entries);
  std::map<Method, std::map<double, std::vector<double>>> evaluations, errors;
  for (const CostEntry& entry : entries) {
    const auto found = bases.find(entry.scene + entry.model);
    if (found == bases.end() || !(found->second.pilot > 0 && found->second.loose > 0)) continue;
    const Base& base = found->second;
    const double key = -std::log(entry.tolerance);
    evaluations[entry.method][key].push_back(std::log(entry.evaluations / base.evaluations));
    if (entry.error <= 10 * least_error) continue;
    errors[entry.method][key].push_back(
        std::log(entry.error / (error_constant(base.loose, base.pilot) * entry.tolerance)));
  }
  for (const auto& [method, by_tolerance] : evaluations) {
    Curve& curve = curves_[method];
    for (const auto& [key, values] : by_tolerance) {
      const std::vector<double>& seen = errors[method][key];
      if (seen.empty() && curve.log_error.empty()) continue;
      curve.log_tolerance.push_back(-key);
      curve.log_evaluations.push_back(upper_median(values));
      curve.log_error.push_back(seen.empty() ? curve.log_error.back() : upper_median(seen));
    }
  }
  if (!curves_.count(Method::rkck) || !curves_.count(Method::rk8pd))
    throw std::runtime_error("the table of costs has no rows of rkck and rk8pd");
}

const CostTable& CostTable::measured() {
  static const CostTable table{std::string(embedded_text("notebooks-data/tradeoff.csv"))};
  return table;
}

double CostTable::at(Method method, double tolerance, std::vector<double> Curve::*values) const {
  const Curve& curve = curves_.at(method);
  const std::vector<double>& x = curve.log_tolerance;
  const std::vector<double>& y = curve.*values;
  const double at = std::clamp(std::log(tolerance), x.back(), x.front());
  const auto after = std::lower_bound(x.begin(), x.end(), at, std::greater<>());
  if (after == x.begin()) return std::exp(y.front());
  const auto i = static_cast<std::size_t>(after - x.begin());
  const double part = (at - x[i - 1]) / (x[i] - x[i - 1]);
  return std::exp(y[i - 1] + part * (y[i] - y[i - 1]));
}

double CostTable::evaluations(Method method, double tolerance) const {
  return at(method, tolerance, &Curve::log_evaluations);
}

double CostTable::error(Method method, double tolerance) const { return at(method, tolerance, &Curve::log_error); }

}  // namespace clatter::validation

// SPDX-License-Identifier: GPL-3.0-or-later
// The map of extremes: the quantities that it sweeps, up to both ends, its cells, each a model at one value of one, and
// its report and picture.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "validation/output/report.hpp"
#include "validation/plan/model_hierarchy.hpp"

namespace clatter::validation {

inline constexpr double eps = std::numeric_limits<double>::epsilon();
inline constexpr double infinite = std::numeric_limits<double>::infinity();

struct AxisValue {
  double value = 0;
  std::string label;  ///< for a reader, at most eight characters
};

struct MapAxis {
  std::string name;    ///< of --only, csv and json
  std::string symbol;  ///< in the table, at most six characters
  std::string what;    ///< one line, with the unit
  std::vector<AxisValue> values;
};

/// angle, stiffness, damping, restitution, ratio, friction, speed, gravity, size, mass, turns, impacts, disc,
/// needle, slenderness, bounces, hops, squares, cubes; long has no values of its own.
[[nodiscard]] const std::vector<MapAxis>& map_axes();
/// @throws std::out_of_range if there is none of that name.
[[nodiscard]] const MapAxis& map_axis(const std::string& name);

/// What became of a cell.
enum class CellVerdict {
  number,         ///< there is a number, and its error
  bad_input,      ///< the model refuses the value: outside its domain
  outside_model,  ///< the value is possible, but the model does not represent what happens, such as jamming
  not_computed,   ///< a number could not be had to the accuracy promised
  ended_early,    ///< the run's own outcome says why: step-too-small, evaluation-limit, …
  time_limit,     ///< the run was stopped, so that the cell ends within its second
  broken,         ///< none of these: a number that is none, or an error without a type
};
[[nodiscard]] const char* verdict_name(CellVerdict verdict);

/// The numbers that a cell came to.
struct CellMeasure {
  double error = 0;       ///< worst relative error against the oracle
  double bound = 0;       ///< what it may be at most
  std::string oracle{};   ///< what the number was held against
  std::string outcome{};  ///< how the run ended
  long evaluations = 0;   ///< of contact forces, of height functions; 0: none to count
  double seconds = 0;     ///< wall time of the model alone [s]
};

/// A model at one value of a quantity.
struct CellPlace {
  std::string axis;
  double value = 0;
  std::string label;  ///< the value for a reader
  ModelLevel model = ModelLevel::discrete;
  bool long_run = false;  ///< many scenes in one cell: no limit of a second
};

struct ExtremeCell : CellPlace {
  CellVerdict verdict = CellVerdict::broken;
  CellMeasure measure{};  ///< if there is a number; the outcome also if the run ended early
  std::string reason{};   ///< of a refusal, one line
  double seconds = 0;     ///< wall time of all of it, the oracle included [s]

  [[nodiscard]] bool has_number() const { return verdict == CellVerdict::number; }
  /// Whether the error says something of digits: not where faults are counted and none is allowed.
  [[nodiscard]] bool has_digits() const { return has_number() && measure.bound > 0; }
  /// Digits that are right: −log₁₀ of the error, from 0 to 16.
  [[nodiscard]] double digits() const;
};

/// The time that a cell has.
class CellClock {
 public:
  using Clock = std::chrono::steady_clock;
  explicit CellClock(double limit) : limit_(limit) {}
  [[nodiscard]] double elapsed() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }
  /// Whether less than this share of the limit has gone.
  [[nodiscard]] bool within(double share) const { return elapsed() < share * limit_; }

 private:
  Clock::time_point begin_ = Clock::now();
  double limit_;
};

/// A run that ended before it had the numbers asked for.
class EndedEarly : public std::runtime_error {
 public:
  EndedEarly(CellVerdict as, std::string ending, const std::string& reason)
      : std::runtime_error(reason), verdict(as), outcome(std::move(ending)) {}
  CellVerdict verdict;
  std::string outcome;
};

/// What a cell does.  `work` returns a number or throws: the models' own errors, or EndedEarly.
struct ExtremeCase : CellPlace {
  std::function<CellMeasure(const CellClock&)> work;
};

/// Adds one case of `model` at each value of the axis; `work` is given the value.
void add_cases(std::vector<ExtremeCase>& cases, const MapAxis& axis, ModelLevel model,
               const std::function<CellMeasure(double, const CellClock&)>& work);

/// Runs an extreme case and puts whatever comes of it into a cell; throws nothing that `work` throws.
[[nodiscard]] ExtremeCell fill_cell(const ExtremeCase& extreme, double seconds);

/// Why a cell does not hold what the map promises: no number and no typed refusal, an error beyond its bound (or NaN),
/// more than `seconds`.  Empty: it holds.
[[nodiscard]] std::string cell_failure(const ExtremeCell& cell, double seconds);

/// Wall time of `work` [s].
[[nodiscard]] double timed(const auto& work) {
  const auto begin = CellClock::Clock::now();
  work();
  return std::chrono::duration<double>(CellClock::Clock::now() - begin).count();
}

/// Runs longer than a second, one cell each.
struct LongRuns {
  int impacts = 10'000;           ///< of the elastic phone, planar and spatial
  int discrete_scenes = 100'000;  ///< random ones
  int continuous_scenes = 1'000;
  std::uint64_t seed = 1;  ///< of the random scenes
};

// The map of what holds: every model over every quantity up to its ends.

/// Neighbouring values of one quantity for which one model does the same, with digits within one of each other.
struct MapRegion {
  std::size_t first = 0, last = 0;  ///< cells
  double fewest_digits = 0, most_digits = 0;
  double slowest = 0;  ///< cost of the model in the slowest cell [s]
};

struct ExtremesMap {
  std::vector<ExtremeCell> cells{};  ///< axis by axis, model by model, in the order of the values
  std::vector<MapRegion> regions{};
  double cell_seconds = 1;  ///< that a cell may take
  std::uint64_t seed = 1;
  bool complete = true;  ///< false: interrupted
};

struct ExtremesOptions {
  std::vector<std::string> axes;  ///< names; empty: all
  bool long_runs = true;
  LongRuns runs = {};
  double cell_seconds = 1;
  /// Called with (done, of); return false to end early with the cells so far.
  std::function<bool(std::size_t, std::size_t)> progress = nullptr;
};

[[nodiscard]] ExtremesMap measure_extremes(const ExtremesOptions& options);

/// The regions of the cells in their order.
[[nodiscard]] std::vector<MapRegion> regions_of(const std::vector<ExtremeCell>& cells);

/// "angle = F2, discrete: error 1, at most 1e-13 allowed" for each cell that breaks a promise.
[[nodiscard]] std::vector<std::string> map_failures(const ExtremesMap& map);

/// 0; 1 if a cell breaks a promise; 130 if the map is not complete.
[[nodiscard]] int map_status(const ExtremesMap& map);

/// The cell that took longest, long runs left out; null if there is none.
[[nodiscard]] const ExtremeCell* slowest_cell(const ExtremesMap& map);

[[nodiscard]] std::vector<Column> extremes_columns();
/// A row for each cell; tables have one for each region, and the reasons of refusals as notes.
[[nodiscard]] Report extremes_report(const ExtremesMap& map);
/// SVG: a strip for each quantity and model, its values side by side, coloured by digits, refusals hatched.
[[nodiscard]] std::string extremes_picture(const ExtremesMap& map);

}  // namespace clatter::validation

// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/extremes/cell.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "analytic/base/errors.hpp"
#include "numeric/errors.hpp"
#include "validation/output/number.hpp"

namespace clatter::validation::inline extremes {
namespace {

void refuse(ExtremeCell& cell, CellVerdict verdict, const std::string& reason) {
  cell.verdict = verdict;
  cell.reason = reason;
  std::replace(cell.reason.begin(), cell.reason.end(), '\n', ' ');
}

void run(const ExtremeCase& extreme, const CellClock& clock, ExtremeCell& cell) {
  try {
    cell.measure = extreme.work(clock);
    cell.verdict = CellVerdict::number;
    if (!std::isfinite(cell.measure.error)) refuse(cell, CellVerdict::broken, "a number that is none");
  } catch (const EndedEarly& ended) {
    refuse(cell, ended.verdict, ended.what());
    cell.measure.outcome = ended.outcome;
  } catch (const analytic::OutsideModelError& error) {
    refuse(cell, CellVerdict::outside_model, error.what());
  } catch (const analytic::NumericalError& error) {
    refuse(cell, CellVerdict::not_computed, error.what());
  } catch (const numeric::NumericalError& error) {
    refuse(cell, CellVerdict::not_computed, error.what());
  } catch (const numeric::MeshError& error) {
    refuse(cell, CellVerdict::bad_input, error.what());
  } catch (const std::domain_error& error) {
    refuse(cell, CellVerdict::bad_input, error.what());
  } catch (const std::invalid_argument& error) {
    refuse(cell, CellVerdict::bad_input, error.what());
  } catch (const std::exception& error) {
    refuse(cell, CellVerdict::broken, std::string("an error without a type: ") + error.what());
  }
}

}  // namespace

const char* verdict_name(CellVerdict verdict) {
  switch (verdict) {
    case CellVerdict::number: return "number";
    case CellVerdict::bad_input: return "bad-input";
    case CellVerdict::outside_model: return "outside-model";
    case CellVerdict::not_computed: return "not-computed";
    case CellVerdict::ended_early: return "ended-early";
    case CellVerdict::time_limit: return "time-limit";
    case CellVerdict::broken: return "BROKEN";
  }
  return "";
}

double ExtremeCell::digits() const {
  if (!has_number()) return 0;
  constexpr double most = 16;
  return measure.error > 0 ? std::fmax(0.0, std::fmin(-std::log10(measure.error), most)) + 0.0 : most;
}

ExtremeCell fill_cell(const ExtremeCase& extreme, double seconds) {
  ExtremeCell cell{.axis = extreme.axis,
                   .value = extreme.value,
                   .label = extreme.label,
                   .model = extreme.model,
                   .measure = {},
                   .reason = {},
                   .long_run = extreme.long_run};
  const CellClock clock(seconds);
  run(extreme, clock, cell);
  cell.seconds = clock.elapsed();
  return cell;
}

std::string cell_failure(const ExtremeCell& cell, double seconds) {
  if (cell.verdict == CellVerdict::broken) return cell.reason;
  if (!cell.has_number() && cell.reason.empty()) return "refused without a reason";
  if (cell.has_number() && !(cell.measure.error <= cell.measure.bound)) {
    return fmt::format("error {}, at most {} allowed", significant(cell.measure.error, 2),
                       significant(cell.measure.bound, 2));
  }
  if (!cell.long_run && !(cell.seconds <= seconds)) return fmt::format("took {} s", significant(cell.seconds, 3));
  return "";
}

}  // namespace clatter::validation::inline extremes

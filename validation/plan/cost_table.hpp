// SPDX-License-Identifier: GPL-3.0-or-later
// What methods cost and deliver, from the measured table of scenes in notebooks-data/tradeoff.csv.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "numeric/stepping/stepper.hpp"

namespace clatter::validation {

/// The adaptive methods on the eight scenes of the table, each scene taken relative to its own run with rkck, and the
/// median taken over the scenes.  Counts of evaluations and errors are used, no times, so that what follows from the
/// table is the same on every machine.
class CostTable {
 public:
  /// @throws std::runtime_error if the text is not that table.
  explicit CostTable(const std::string& csv);
  /// The table that the program carries.
  [[nodiscard]] static const CostTable& measured();

  /// Evaluations of the contact force over those of rkck at tolerance `pilot_tolerance`.
  [[nodiscard]] double evaluations(numeric::Method method, double tolerance) const;
  /// True error over (error constant × tolerance).
  [[nodiscard]] double error(numeric::Method method, double tolerance) const;

  /// Error per tolerance of rkck at the two pilot tolerances, geometric mean: the error constant of a scene.
  [[nodiscard]] static double error_constant(double error_at_loose, double error_at_pilot);
  /// The tolerances of pilot runs, not of checks.  Above 1e-4 a run costs no less, since events take the most; the
  /// second lies two decades below, so that the mean does not hang on where one step happens to end.
  static constexpr double loose_tolerance = 1e-4, pilot_tolerance = 1e-6;

 private:
  struct Curve {
    std::vector<double> log_tolerance, log_evaluations, log_error;  ///< log_tolerance falling
  };
  [[nodiscard]] double at(numeric::Method method, double tolerance, std::vector<double> Curve::*values) const;
  std::map<numeric::Method, Curve> curves_;
};

}  // namespace clatter::validation

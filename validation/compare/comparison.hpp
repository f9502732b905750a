// SPDX-License-Identifier: GPL-3.0-or-later
// The same scene through both models, aligned by impact.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "numeric/simulate.hpp"
#include "validation/compare/discrete_side.hpp"
#include "validation/compare/stiff_limit.hpp"
#include "validation/output/estimated.hpp"
#include "validation/output/report.hpp"
#include "validation/run/motion_numbers.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// One impact of both models.  Deviations are continuous − discrete.
struct ComparedImpact {
  int n = 1;
  std::string reason;  ///< why the numbers at the scene's own stiffness cannot be compared; empty: they can
  std::optional<MotionNumbers> discrete, continuous;
  std::optional<MotionNumbers> as_given;  ///< of the body as given, where the mesh has other corners
  MotionNumbers as_given_error{};
  MotionNumbers discrete_error{}, continuous_error{};  ///< of these; not finite: not known
  std::string discrete_end, continuous_end;            ///< in space the corner
  std::string as_given_end;                            ///< the same of `as_given`
  double contact_time = 0;                             ///< of the continuous model [s]
  PredictedSize predicted;
  std::optional<LimitRow> limit;  ///< of the continuous model for k_G → ∞, if it has the impact apart from others
  /// |limit − discrete| may be this: five error bars of the limit, rounding of both, and what tips a face.
  MotionNumbers allowance{};
  /// Whether the limit is to be the discrete value: the rule of a face that lands with all its area has another one
  /// where the body tips on an even bed.
  bool has_same_limit = true;
  /// Whether every number of the limit is the discrete model's, within `allowance`.  Meaningful with both.
  [[nodiscard]] bool lands() const;
  /// Largest |limit − discrete| over the limit's error bar and the discrete model's error together.  Meaningful with
  /// both.
  [[nodiscard]] double bars_off() const;
  /// In space, why there is no limit to hold against the discrete value, or the limit lies outside its error bar, one
  /// clause; empty: it lies within.
  std::string explanation;
  /// Whether there is a limit and a discrete impact of the same end.
  [[nodiscard]] bool has_limit() const { return limit && discrete; }
  /// The same, to hold against each other.
  [[nodiscard]] bool has_landing() const { return has_limit() && has_same_limit; }
};

/// How far the discrete model of the mesh's corners is from that of the body as given.
struct CornersApart {
  double largest = 0;          ///< of the numbers, relative to DiscreteSide::scales
  int impact = 0;              ///< that has it; 0: all are equal
  const char* quantity = "";   ///< its heading
  std::size_t same_count = 0;  ///< of the first impacts, in which the same end strikes; the others do not count
};

struct Comparison {
  DiscreteSide discrete;                 ///< with the corners that the continuous model has
  std::optional<DiscreteSide> as_given;  ///< `sequence`'s, where the mesh has other corners than the body as given
  double approach_speed = 0;             ///< of the first contact, of the body as given [m/s]
  numeric::Simulation run;
  StiffLimit limit;
  std::vector<ComparedImpact> impacts;
  PartedBlows parted;  ///< of the run at the scene's own stiffness
  /// Whether there is anything to compare: an impact at the scene's stiffness or a limit.
  [[nodiscard]] bool has_content() const;
  /// Why a number that could not be computed or a limit on the work left one of the models fewer impacts than asked
  /// for, or required digits are not known; empty: neither.
  std::string shortfall;
  /// By what the law that [impact] gives the discrete model is not the ground's, whose limit then differs; empty: by
  /// nothing.
  std::string other_law;
  /// @pre as_given
  [[nodiscard]] CornersApart corners_apart() const;
  /// No impact whose limit misses the discrete value.
  [[nodiscard]] bool agrees() const;
};

/// Runs the scene through both models and over ever stiffer grounds.
/// @throws analytic::OutsideModelError if the discrete model cannot represent the scene.
[[nodiscard]] Comparison compare_models(const Scene& scene, const numeric::Body& body);

/// One value of a swept scene.
struct SweptComparison {
  double value;
  Comparison comparison;
};

// One number of an impact in both models.

/// A number of an impact in both models.  Each function needs the models, or the limit, that its words name.
struct NumberPair {
  const ComparedImpact& impact;
  std::size_t quantity;

  [[nodiscard]] double discrete() const { return (*impact.discrete)[quantity]; }
  /// The number of the discrete model with the body as given, whose corners may not be the mesh's.
  [[nodiscard]] Estimated given_number() const {
    if (!impact.as_given) return discrete_number();
    return {(*impact.as_given)[quantity], impact.as_given_error[quantity]};
  }
  [[nodiscard]] double continuous() const { return (*impact.continuous)[quantity]; }
  [[nodiscard]] double deviation() const { return continuous() - discrete(); }
  [[nodiscard]] Estimated discrete_number() const { return {discrete(), impact.discrete_error[quantity]}; }
  [[nodiscard]] Estimated continuous_number() const { return {continuous(), impact.continuous_error[quantity]}; }
  [[nodiscard]] Estimated deviation_number() const { return continuous_number() - discrete_number(); }
  /// How far the limit is off the discrete value; its own error bar stands beside it.
  [[nodiscard]] Estimated miss_number() const { return {miss(), impact.discrete_error[quantity] + bar()}; }
  [[nodiscard]] double predicted() const { return impact.predicted.total()[quantity]; }
  [[nodiscard]] double miss() const { return impact.limit->value[quantity] - discrete(); }
  [[nodiscard]] double allowance() const { return impact.allowance[quantity]; }
  [[nodiscard]] double bar() const { return impact.limit->error[quantity]; }
};

// What `clatter compare` says.

[[nodiscard]] std::vector<Column> comparison_columns();
/// A row for each impact and number; tables leave out those that are zero by symmetry.
[[nodiscard]] Report comparison_report(const Scene& scene, const Comparison& comparison);

/// The number of an impact that deviates most for its size: deviation over scale, its error and what was predicted of
/// it; the number whose limit is farthest off for what it may be: distance over scale, and its error bar.
struct WorstNumber {
  double deviation = 0, deviation_error = 0, predicted = 0, miss = 0, miss_error = 0, bar = 0;
};
/// The worst number of an impact that the discrete model has.
[[nodiscard]] WorstNumber worst_number(const Comparison& comparison, const ComparedImpact& impact);

/// A row for each value, impact and number; in tables the worst number of each impact.
[[nodiscard]] Report swept_comparison_report(const Scene& scene, const std::vector<SweptComparison>& swept);

}  // namespace clatter::validation

// SPDX-License-Identifier: GPL-3.0-or-later
// The quantities of impacts as columns and rows.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "validation/output/cells.hpp"
#include "validation/output/report.hpp"
#include "validation/run/run.hpp"

namespace clatter::validation {

// What is known of an impact: one list of quantities, which tables, CSV, JSON, sweeps and comparisons take theirs from.

/// A quantity of one impact; nothing where it has none, a number that is not finite where it is not to be had.
using Entry = std::variant<std::nullptr_t, bool, int, double, std::string, EntryVector, EntryParameters>;

/// What the numbers of one kind are measured by: one against which they count as zero.
enum class Scale { none, time, angle, impulse, speed, rate, energy, ratio };
inline constexpr std::size_t scale_count = 8;
using Scales = std::array<double, scale_count>;  ///< by Scale, in the units of the quantities; 0: not known

/// What a model, or the tail of its sequence, knows of a quantity.
enum class Known {
  absent,      ///< it has no such column
  empty,       ///< a column without values
  value_only,  ///< the value without an error
  with_error,  ///< the value and its error
};

struct ImpactQuantity {
  const char* name;    ///< in JSON; in CSV, too, with _x, _y and _z for the parts of a vector
  const char* symbol;  ///< in tables; of a vector those of its parts, x y z
  const char* unit;
  const char* meaning;
  Scale scale;
  std::array<Known, 4> known;       ///< to the models, in their order, and to a tail
  Entry (*number)(const Numbers&);  ///< one of the numbers, and so of their errors; or none
  Entry (*fact)(const Impact&);     ///< anything else

  [[nodiscard]] Known known_to(RunModel model) const { return known[static_cast<std::size_t>(model)]; }
  [[nodiscard]] Entry value(const Impact& impact) const { return number ? number(impact.value) : fact(impact); }
  /// The error of a number; no other kind has one.
  [[nodiscard]] Entry error(const Impact& impact) const { return number(impact.error); }
  /// An entry of its kind, without meaning.
  [[nodiscard]] Entry kind() const;
};

/// All of them, in the order of CSV and JSON.
[[nodiscard]] std::span<const ImpactQuantity> impact_quantities();

/// Names of the columns that a table of impacts has in every scene of the model; others depend on what the scene has.
[[nodiscard]] std::vector<std::string> shown_quantities(RunModel model);
/// The columns of a model's quantities, then those of their errors as NAME_error.
/// @param shown names of the columns that tables have
[[nodiscard]] std::vector<Column> impact_columns(RunModel model, const std::vector<std::string>& shown);

/// What tables show of an impact's numbers.
struct ImpactDigits {
  int digits = 6;         ///< at most
  bool trusted = true;    ///< false: none is known
  bool estimated = true;  ///< false: errors were not asked for; two digits then
  Scales scales{};

  /// A number of this kind with its error.
  [[nodiscard]] Cell cell(double value, double error, Scale scale) const;
};
/// Sizes of the numbers of a run of the discrete model, against which a number counts as zero.
/// @param reach  largest distance of a corner from the centre of mass: a body that does not turn has a size of rates,
///               too, that of its speed over this [m]
[[nodiscard]] Scales scales_of(const Run& run, double reach);
/// The cells of an impact under the columns of its model, or of a tail, which leaves empty what no tail knows.
[[nodiscard]] Row impact_row(const Impact& impact, RunModel model, const ImpactDigits& digits);

/// An impact, or a tail, in rows that are written by the million.
struct ImpactText {
  RunModel model, columns;  ///< of the impact, and of the columns: one in the plane may stand under those of space
  bool errors = true, predictions = true;  ///< whether they and their growth were asked for; else they, or
                                           ///< `predictable`, are left empty
};
/// Appends the cells; what the impact has no value of is left empty.
void append_impact(CellWriter& out, const Impact& impact, const ImpactText& text);

}  // namespace clatter::validation

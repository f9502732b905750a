// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of an impact: one list of quantities, which tables, CSV, JSON, sweeps and comparisons take theirs from.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <variant>

#include "validation/run/run.hpp"

namespace clatter::validation {

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
  Known in_plane, in_space, continuous, tail;
  Entry (*number)(const Numbers&);  ///< one of the numbers, and so of their errors; or none
  Entry (*fact)(const Impact&);     ///< anything else

  [[nodiscard]] Known known_to(RunModel model) const;
  [[nodiscard]] Entry value(const Impact& impact) const { return number ? number(impact.value) : fact(impact); }
  /// The error of a number; no other kind has one.
  [[nodiscard]] Entry error(const Impact& impact) const { return number(impact.error); }
  /// An entry of its kind, without meaning.
  [[nodiscard]] Entry kind() const;
};

/// All of them, in the order of CSV and JSON.
[[nodiscard]] std::span<const ImpactQuantity> impact_quantities();

}  // namespace clatter::validation

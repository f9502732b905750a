// SPDX-License-Identifier: GPL-3.0-or-later
// What is known of an impact: one list of quantities, which tables, CSV, JSON, sweeps and comparisons take theirs from.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence.hpp"
#include "numeric/impact_record.hpp"

namespace clatter::validation::inline record {

/// Impact n, counted from 1, of the discrete model.
struct DiscreteRow {
  const analytic::ImpactRow& row;
  int n = 1;
  double drop_deg = 0;  ///< inclination of the drop, which came in degrees [°]
};

/// Impact n, counted from 1, of the discrete model in space.
struct SpaceRow {
  const analytic::space::ImpactRow& row;
  int n = 1;
  std::string end{}, corners{};   ///< which end of the body strikes, and which of its corners
  std::array<double, 3> place{};  ///< of the first corner, from the geometric centre (a mesh: in its file's frame) [m]
};

/// Impact n, counted from 1, of the continuous model.
struct ContinuousRow {
  const numeric::ImpactRecord& row;
  int n = 1;
};

using EntryVector = std::array<double, 3>;      ///< x, y, z
using EntryParameters = std::array<double, 4>;  ///< Euler parameters, scalar first
/// A quantity of one impact; nothing where the model has none, a number that is not finite where it is not to be had.
using Entry = std::variant<std::nullptr_t, bool, int, double, std::string, EntryVector, EntryParameters>;

/// What the numbers of one kind are measured by: one against which they count as zero.
enum class Scale { none, time, angle, impulse, speed, rate, energy, ratio };
inline constexpr std::size_t scale_count = 8;
using Scales = std::array<double, scale_count>;  ///< by Scale, in the units of the quantities; 0: not known

/// How one model, or the tail of its sequence, knows a quantity; empty: it does not.
template <class Impact>
struct Getter {
  Entry (*value)(const Impact&) = nullptr;
  Entry (*error)(const Impact&) = nullptr;  ///< bound or estimate, not finite where not known
};

struct ImpactQuantity {
  const char* name;    ///< in JSON; in CSV, too, with _x, _y and _z for the parts of a vector
  const char* symbol;  ///< in tables; of a vector those of its parts, x y z
  const char* unit;
  const char* meaning;
  Scale scale = Scale::none;
  Getter<DiscreteRow> discrete{};
  Getter<SpaceRow> space{};
  Getter<ContinuousRow> continuous{};
  Getter<analytic::Tail> tail{};               ///< the sum of all further impacts of the discrete model
  bool motion = false;                         ///< one of the MotionNumbers, which every model has
  Getter<analytic::space::Tail> space_tail{};  ///< as `tail`, in space

  template <class Impact>
  [[nodiscard]] const Getter<Impact>& of() const {
    if constexpr (std::is_same_v<Impact, DiscreteRow>) return discrete;
    else if constexpr (std::is_same_v<Impact, SpaceRow>) return space;
    else if constexpr (std::is_same_v<Impact, ContinuousRow>) return continuous;
    else if constexpr (std::is_same_v<Impact, analytic::Tail>) return tail;
    else return space_tail;
  }
};

/// All of them, in the order of CSV and JSON.
[[nodiscard]] std::span<const ImpactQuantity> impact_quantities();

/// Tangential over normal impulse.
[[nodiscard]] double impulse_ratio(const numeric::ImpactNumbers& numbers);

}  // namespace clatter::validation::inline record

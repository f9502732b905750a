// SPDX-License-Identifier: GPL-3.0-or-later
// The impacts of a foreign run: those found in its motion, or those that it lists.
#pragma once

#include <string>
#include <vector>

#include "validation/benchmark/motion.hpp"

namespace clatter::validation {

/// How a code may have booked an impact.  One that resolves the instant has the point on the ground then.  Any other
/// strikes with the pose at the begin or the end of its step, or between, and adds the step's gravity before the
/// impact, after it, on both sides of it, or lets the impact make up for it.
struct Booking {
  analytic::space::State before, after;
};

/// One impact of a foreign run.
struct FoundImpact {
  std::vector<int> points;  ///< that struck; none: no point of the body explains the jump
  std::string place;        ///< their names
  double time = 0;          ///< since the first touch [s]
  analytic::space::Vector3 impulse = analytic::space::Vector3::Zero();  ///< [N·s]
  analytic::space::State before{}, after{};                             ///< of the flights, at `time`
  /// States right before and after, as the code may have had them; the first is (before, after).
  std::vector<Booking> bookings{};
  std::size_t first_row = 0, last_row = 0;    ///< of the motion, around it
  std::size_t first_line = 0, last_line = 0;  ///< of the file, likewise; of a list both are the impact's own
  /// Where two places are struck in one step: both of them, the earlier first, and the states before and after both.
  /// How the step's impulse is shared is then a guess, and only both together can be held against the law.
  std::vector<std::vector<int>> pair{};
  std::vector<Booking> of_pair{};
  bool is_resolved = false;      ///< the points are on the ground at the instant at which the flights meet
  bool begins_in_a_row = false;  ///< the points are on the ground in the first row: whether its code resolves the
                                 ///< instant or strikes at the begin of a step cannot be told
};

/// What is looked for in a motion.
struct ImpactSearch {
  double least_impulse = 0;  ///< smaller impacts are none: rounding, drift [N·s]
  double spread_time = 0;    ///< over which a code may spread an impact: shorter steps have their share of it [s]
  double rounding = 0;       ///< smaller jumps of a step are none [N·s]
  std::size_t most = 0;      ///< impacts to find
};

/// Impacts of a motion, by velocity jumps that free flight does not explain.  Jumps of the same
/// points in neighbouring steps are one impact, unless these points left the ground and came down in between.
[[nodiscard]] std::vector<FoundImpact> find_impacts(const Motion& motion, const Reference& reference,
                                                    const ImpactSearch& search);

/// Impacts of a list t,place,Pn,Pt,V,Omega, or in space t,place,Px,Py,Pz,Vx,Vy,Vz,Wx,Wy,Wz; Omega and W as in the
/// program's own tables, positive clockwise on the page, unless is_counter_clockwise().  States follow from the
/// reference's start by free flight.
/// @throws BadInput for a place that the body does not have, and times that decrease
[[nodiscard]] std::vector<FoundImpact> listed_impacts(const NumericTable& table, const Reference& reference,
                                                      bool is_counter_clockwise = false);
[[nodiscard]] TableRequest impact_list_request(bool in_space, const ColumnNames& names);

}  // namespace clatter::validation

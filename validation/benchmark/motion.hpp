// SPDX-License-Identifier: GPL-3.0-or-later
// A motion that another program sampled: rows of time, place and velocity, and its impacts.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "validation/benchmark/reference.hpp"
#include "validation/output/numeric_table.hpp"

namespace clatter::validation {

/// "FILE:LINE:1: KEY": where a line "# KEY: …" stands.
[[nodiscard]] std::string place_of(const NumericTable& table, const std::string& key);
/// The step of the line "# step: 0.001" or "1/60", with or without "s" [s].  @throws BadInput
[[nodiscard]] std::optional<double> stated_step(const NumericTable& table);

/// In the plane  t,x,z,phi,vx,vz,omega: of the centre of mass, floor z = 0, x to the right, phi and omega
/// counter-clockwise on the page, so that phi > 0 has end a low.  In space  t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz:
/// y into the page, Euler parameters body → world with the scalar first, angular velocity in world components.
class Motion {
 public:
  /// What a header must have for the file to be one of a motion.
  [[nodiscard]] static bool is_in_space(const std::vector<std::string>& header, const ColumnNames& names);
  [[nodiscard]] static TableRequest request(bool in_space, const ColumnNames& names);

  /// @param reference must outlive the motion
  /// @throws BadInput "FILE:LINE:COLUMN: …" for times that do not grow, Euler parameters that are none, fewer than two
  ///         rows, or a file in the plane where the reference is in space.
  Motion(NumericTable table, const Reference& reference);

  [[nodiscard]] std::size_t size() const { return table_.rows() + (lead_ ? 1 : 0); }
  [[nodiscard]] double time(std::size_t row) const;
  [[nodiscard]] analytic::space::State state(std::size_t row) const;
  /// Translational, rotational and potential energy [J].
  [[nodiscard]] double energy(std::size_t row) const;

  /// What free flight does not explain of the step from a row to the next.
  struct Jump {
    analytic::space::Vector3 impulse;  ///< m (ΔV + g Δt z) [N·s]
    analytic::space::Vector3 moment;   ///< change of the angular momentum about the centre of mass [N·m·s]
  };
  [[nodiscard]] Jump jump(std::size_t row) const;

  /// Time of the first touch in a flight from the first row [s].
  [[nodiscard]] double first_touch() const { return first_touch_; }
  /// How far the state then is from the reference's: the largest of |ΔV|, |ΔΩ| × reach (relative to the speed) and the
  /// distance of a point (relative to the reach).
  [[nodiscard]] double start_error() const { return start_error_; }
  /// Whether the file's first row is the state after the first impact, so that no row shows the start.
  [[nodiscard]] bool begins_after_touch() const { return lead_.has_value(); }
  /// The step of the code: as its file says, otherwise, or where that is longer, the median from row to row [s].
  [[nodiscard]] double step() const { return step_; }
  [[nodiscard]] const NumericTable& table() const { return table_; }
  /// Row of the table that a row of the motion is.
  [[nodiscard]] std::size_t table_row(std::size_t row) const { return row - (lead_ && row > 0 ? 1 : 0); }
  /// Line of the file that a row of the motion is.
  [[nodiscard]] std::size_t line(std::size_t row) const { return table_.line(table_row(row)); }

 private:
  void check_rows() const;
  [[nodiscard]] analytic::space::Vector3 angular_momentum(std::size_t row) const;
  [[nodiscard]] double median_step() const;
  void find_first_touch();
  [[nodiscard]] double number(std::size_t row, std::size_t quantity) const {
    return table_.at(row - (lead_ ? 1 : 0), column_[quantity]);
  }

  NumericTable table_;
  const Reference& reference_;
  bool in_space_;
  std::vector<std::size_t> column_;  ///< of each quantity of the request
  /// The reference's start, where the file begins right after the first impact.
  std::optional<analytic::space::State> lead_;
  std::vector<analytic::space::Vector3> momenta_;  ///< angular, of each row of a file in space [N·m·s]
  double first_touch_ = 0, start_error_ = 0;
  double step_ = 0;
  double origin_ = 0;  ///< x of the first touch, where the ground slopes [m]
};

// Its impacts: those found in its motion, or those that it lists.

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

/// Impacts of a motion that are large enough to be judged, by velocity jumps that free flight does not explain.  Jumps
/// of the same points in neighbouring steps are one impact, unless these points left the ground and came down in
/// between.
[[nodiscard]] std::vector<FoundImpact> impacts_of(const Motion& motion, const Reference& reference);

/// Impacts of a list t,place,Pn,Pt,V,Omega, or in space t,place,Px,Py,Pz,Vx,Vy,Vz,Wx,Wy,Wz; Omega and W as in the
/// program's own tables, positive clockwise on the page, unless is_counter_clockwise().  States follow from the
/// reference's start by free flight.
/// @throws BadInput for a place that the body does not have, and times that decrease
[[nodiscard]] std::vector<FoundImpact> listed_impacts(const NumericTable& table, const Reference& reference,
                                                      bool is_counter_clockwise = false);
[[nodiscard]] TableRequest impact_list_request(bool in_space, const ColumnNames& names);

// Where it begins, beside the drop that is asked for.

/// Time at which the lowest point of a flight comes down to the ground, or a little later, where it rises at first; a
/// time that has passed of a point in the ground that goes down [s].
[[nodiscard]] double touch_time(const Reference& reference, const analytic::space::FreeFlight& flight);

/// By how much a planar body is turned with end a low, phi of a motion without whole turns [rad].
[[nodiscard]] double inclination_of(const analytic::space::State& state);

/// The state in which the drop that is asked for has its centre of mass at a height [m], on its way down to the touch.
[[nodiscard]] analytic::space::State asked_at_height(const Reference& reference, double height);

/// What of the first row is not as asked: "phi is 25 rad, must be 0.436332 rad", by the start that is nearest to it,
/// one of Reference::gaps or at the row's own height; empty where all of it is as there.
[[nodiscard]] std::string start_differences(const Motion& motion, const Reference& reference);

}  // namespace clatter::validation

// SPDX-License-Identifier: GPL-3.0-or-later
// The numbers of an impact that every model has, and how far two models are apart in them.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "validation/run/run.hpp"

namespace clatter::validation {

/// Time of touch-down [s], contact angle [°], impulse x, y, z [N·s], velocity
/// after x, y, z [m/s], angular velocity after x, y, z [rad/s]; world frame.  What lies out of the plane is zero in a
/// planar model.
inline constexpr std::size_t motion_number_count = 11;
using MotionNumbers = std::array<double, motion_number_count>;

/// The numbers of an impact, or of its errors, which are not finite where not known.
[[nodiscard]] MotionNumbers motion_numbers(const Numbers& numbers);
/// The numbers of each impact of a run.
[[nodiscard]] std::vector<MotionNumbers> motion_rows(const Run& run);

/// Size and mass of a body: how fast its tips are, and what speeds make of impulses.
struct BodySize {
  double reach = 0;  ///< largest distance of a corner from the centre of mass [m]
  double mass = 0;   ///< [kg]
};

/// Sizes against which errors of the impacts, at least one, count as relative: the time of the last of them or that of
/// moving by the reach, 90°, the largest speed v of the centre or the tips, m v, and v over the reach.
[[nodiscard]] MotionNumbers motion_sizes(std::span<const Impact> impacts, const BodySize& body);
[[nodiscard]] MotionNumbers motion_sizes(const numeric::Simulation& run, std::size_t count, const numeric::Body& body);

/// A number of the motion that a comparison of models shows.
struct ComparedQuantity {
  const char *name, *heading;
  std::size_t place;  ///< in MotionNumbers
};
using ComparedQuantities = std::span<const ComparedQuantity>;
/// The quantities of a motion in the plane.
inline constexpr std::array<ComparedQuantity, 7> plane_quantities{{{"start", "t", 0},
                                                                   {"contact_angle_deg", "angle", 1},
                                                                   {"impulse_normal", "Pₙ", 4},
                                                                   {"impulse_tangential", "Pₜ", 2},
                                                                   {"velocity_normal", "Vₙ", 7},
                                                                   {"velocity_tangential", "Vₜ", 5},
                                                                   {"angular_velocity", "Ω", 9}}};
/// All of them, for a motion in space.
inline constexpr std::array<ComparedQuantity, motion_number_count> space_quantities{
    {{"start", "t", 0},
     {"contact_angle_deg", "angle", 1},
     {"impulse_x", "Pₜ", 2},
     {"impulse_y", "P_y", 3},
     {"impulse_z", "Pₙ", 4},
     {"velocity_after_x", "Vₜ", 5},
     {"velocity_after_y", "V_y", 6},
     {"velocity_after_z", "Vₙ", 7},
     {"angular_velocity_after_x", "ω_x", 8},
     {"angular_velocity_after_y", "Ω", 9},
     {"angular_velocity_after_z", "ω_z", 10}}};
inline constexpr std::size_t normal_impulse_place = 4;  ///< in MotionNumbers

/// Sizes against which deviations count as relative: time, angle and velocities of the drop at large, so that a number
/// that is zero by symmetry has a scale too.
[[nodiscard]] MotionNumbers comparison_scales(std::span<const Impact> impacts, const BodySize& body);

/// Largest distance of a row's numbers, relative to `sizes`; infinite if one is no number.
[[nodiscard]] double row_distance(const MotionNumbers& row, const MotionNumbers& other, const MotionNumbers& sizes);
/// The same over the rows of `truth`; infinite if `rows` has fewer.
[[nodiscard]] double distance(const std::vector<MotionNumbers>& rows, const std::vector<MotionNumbers>& truth,
                              const MotionNumbers& sizes);

}  // namespace clatter::validation

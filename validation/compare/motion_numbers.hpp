// The numbers of an impact that every model has, and how far two models are apart in them.
#pragma once

#include <array>
#include <vector>

#include "analytic/sequence.hpp"
#include "numeric/simulate.hpp"
#include "validation/compare/quantities.hpp"

namespace clatter::validation {

/// Time of touch-down [s], contact angle [°], impulse x, y, z [N·s], velocity after x, y, z [m/s], angular velocity
/// after x, y, z [rad/s]; world frame.  What lies out of the plane is zero in a planar model.
inline constexpr std::size_t motion_number_count = 11;
using MotionNumbers = std::array<double, motion_number_count>;

[[nodiscard]] MotionNumbers motion_numbers(const analytic::ImpactRow& row);
[[nodiscard]] MotionNumbers motion_numbers(const numeric::ImpactNumbers& numbers);
[[nodiscard]] std::vector<MotionNumbers> motion_rows(const analytic::Sequence& sequence);
[[nodiscard]] std::vector<MotionNumbers> motion_rows(const numeric::Simulation& run);

/// Sizes against which errors of the first `count` >= 1 impacts count as relative: the time of the last of them, 90°,
/// the largest speed v of the centre or the tips, m v, and v over the body's radius.
[[nodiscard]] MotionNumbers motion_sizes(const numeric::Simulation& run, std::size_t count, const numeric::Body& body);
[[nodiscard]] MotionNumbers motion_sizes(const analytic::Sequence& sequence, const analytic::PlanarBody& body);

/// Those of the numbers that motion in the plane has.
[[nodiscard]] Quantities in_plane(const MotionNumbers& numbers);

/// Largest distance of a row's numbers, relative to `sizes`; infinite if one is no number.
[[nodiscard]] double row_distance(const MotionNumbers& row, const MotionNumbers& other, const MotionNumbers& sizes);
/// The same over the rows of `truth`; infinite if `rows` has fewer.
[[nodiscard]] double distance(const std::vector<MotionNumbers>& rows, const std::vector<MotionNumbers>& truth,
                              const MotionNumbers& sizes);

}  // namespace clatter::validation

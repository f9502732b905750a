// What the two models say of one impact, side by side.
#pragma once

#include <array>
#include <cstddef>

#include "analytic/sequence.hpp"
#include "numeric/impact_record.hpp"

namespace clatter::validation {

/// The numbers that both models have of an impact, in this order.
enum class QuantityId : std::size_t {
  start,
  contact_angle,
  impulse_normal,
  impulse_tangential,
  velocity_normal,
  velocity_tangential,
  angular_velocity
};
inline constexpr std::size_t quantity_count = 7;
using Quantities = std::array<double, quantity_count>;

/// Name in JSON, heading, unit.  Angles are in degrees.
struct QuantityName {
  const char *name, *heading, *unit;
};
inline constexpr std::array<QuantityName, quantity_count> quantity_names{{{"start", "t", "s"},
                                                                          {"contact_angle_deg", "angle", "°"},
                                                                          {"impulse_normal", "Pₙ", "N·s"},
                                                                          {"impulse_tangential", "Pₜ", "N·s"},
                                                                          {"velocity_normal", "Vₙ", "m/s"},
                                                                          {"velocity_tangential", "Vₜ", "m/s"},
                                                                          {"angular_velocity", "Ω", "rad/s"}}};

[[nodiscard]] Quantities quantities(const analytic::ImpactRow& row);
[[nodiscard]] Quantities quantities(const numeric::ImpactNumbers& numbers);
/// Errors of the numbers of a row.
[[nodiscard]] Quantities quantities(const analytic::RowErrors& errors);

/// Size against which a deviation counts as relative: time, angle and velocities of the drop at large, so that a
/// number that is zero by symmetry has a scale too.
[[nodiscard]] Quantities quantity_scales(const analytic::Sequence& sequence, const analytic::PlanarBody& body);

}  // namespace clatter::validation

// The numbers of an impact under the names that JSON and CSV give them.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "analytic/sequence.hpp"
#include "numeric/impact_record.hpp"
#include "validation/output/json.hpp"
#include "validation/output/names.hpp"

namespace clatter::validation {

using EntryVector = std::array<double, 3>;

/// A value as JSON: null where it is not finite or the model has none.
[[nodiscard]] inline Json entry_json(double value) { return number_or_null(value); }
[[nodiscard]] inline Json entry_json(const EntryVector& v) {
  return Json::array({number_or_null(v[0]), number_or_null(v[1]), number_or_null(v[2])});
}
template <class Value>
[[nodiscard]] Json entry_json(const Value& value) {
  return value;
}

/// An angle of impact n, counted from 1, in degrees; the first one is the drop's, which came in degrees, unless that
/// was turned beyond the upright.
[[nodiscard]] inline double degrees_of(double radians, int n, double drop_deg) {
  const bool is_drop = n == 1 && std::fabs(drop_deg) <= 90;
  return is_drop ? std::copysign(drop_deg, radians) : radians * analytic::degrees_per_radian;
}

/// Tangential over normal impulse.
[[nodiscard]] inline double impulse_ratio(const numeric::ImpactNumbers& n) { return n.impulse.x() / n.impulse.z(); }
[[nodiscard]] inline double impulse_ratio_error(const numeric::ImpactRecord& row) {
  return row.error.impulse.norm() * (1 + std::fabs(impulse_ratio(row.value))) / std::fabs(row.value.impulse.z());
}

/// Calls entry(name, value) for each number of an impact of the discrete model but its amplification.  A value is an
/// int, a double (not finite: not to be had), a text, an EntryVector, or nullptr where the model has none.
/// @param drop_deg inclination of the drop [°]
template <class Entry>
void for_each_entry(const analytic::ImpactRow& row, int n, double drop_deg, Entry&& entry) {
  const analytic::Impact& impact = row.impact;
  entry("n", n);
  entry("start", row.start);
  entry("duration", 0.0);
  entry("end", analytic::PlanarBody::vertex_set_name(row.vertices));
  entry("inclination_deg", degrees_of(row.inclination, n, drop_deg));
  entry("contact_angle_deg", degrees_of(row.contact_angle, n, drop_deg));
  entry("approach_speed", impact.approach_speed);
  entry("restitution", impact.restitution());
  entry("impulse_normal", impact.normal_impulse);
  entry("impulse_tangential", impact.tangential_impulse);
  entry("impulse_ratio", impact.impulse_ratio());
  entry("mode", mode_name(impact.mode));
  entry("peak_force", nullptr);
  entry("peak_time", nullptr);
  entry("velocity_after", EntryVector{impact.after.tangential, 0, impact.after.normal});
  entry("angular_velocity_after", EntryVector{0, impact.after.angular, 0});
  entry("energy_before", row.energy_before);
  entry("energy_after", row.energy_after);
  entry("energy_loss", impact.energy_loss);
}

/// Calls entry(name, error) for each number of an impact of the discrete model that has an error, a double or an
/// EntryVector as above.
template <class Entry>
void for_each_error(const analytic::RowErrors& errors, Entry&& entry) {
  entry("start", errors.start);
  entry("inclination_deg", errors.inclination * analytic::degrees_per_radian);
  entry("contact_angle_deg", errors.contact_angle * analytic::degrees_per_radian);
  entry("approach_speed", errors.approach_speed);
  entry("restitution", errors.restitution);
  entry("impulse_normal", errors.normal_impulse);
  entry("impulse_tangential", errors.tangential_impulse);
  entry("impulse_ratio", errors.impulse_ratio);
  entry("velocity_after", EntryVector{errors.after.tangential, 0, errors.after.normal});
  entry("angular_velocity_after", EntryVector{0, errors.after.angular, 0});
  entry("energy_before", errors.energy_before);
  entry("energy_after", errors.energy_after);
  entry("energy_loss", errors.energy_loss);
}

/// The numbers of an impact of the continuous model, or their error estimates.
template <class Entry>
void for_each_number(const numeric::ImpactNumbers& part, Entry&& entry) {
  constexpr double degrees = 180 / std::numbers::pi;
  const auto vector = [](const numeric::Vector3& v) { return EntryVector{v.x(), v.y(), v.z()}; };
  entry("start", part.start);
  entry("duration", part.duration);
  entry("inclination_deg", part.inclination * degrees);
  entry("contact_angle_deg", part.contact_angle * degrees);
  entry("approach_speed", part.approach_speed);
  entry("restitution", part.restitution);
  entry("impulse_normal", part.impulse.z());
  entry("impulse_tangential", part.impulse.x());
  entry("impulse", vector(part.impulse));
  entry("peak_force", part.peak_force);
  entry("peak_time", part.peak_time);
  entry("velocity_after", vector(part.velocity_after));
  entry("angular_velocity_after", vector(part.angular_velocity_after));
  entry("energy_before", part.energy_before);
  entry("energy_after", part.energy_after);
  entry("energy_loss", part.energy_loss);
  entry("work_damping", part.work_damping);
  entry("work_friction", part.work_friction);
  entry("work_released", part.work_released);
}

/// Calls entry(name, error) for each number of an impact of the continuous model.
template <class Entry>
void for_each_error(const numeric::ImpactRecord& row, Entry&& entry) {
  for_each_number(row.error, entry);
  entry("impulse_ratio", impulse_ratio_error(row));
}

/// Calls entry(name, value) for all that is known of an impact of the continuous model but its error estimates; values
/// as above, or bools.
template <class Entry>
void for_each_entry(const numeric::ImpactRecord& row, int n, Entry&& entry) {
  entry("n", n);
  entry("end", end_name(row.end));
  entry("touches", row.touches);
  entry("mode", mode_name(row.mode));
  entry("submerged", row.submerged);
  for_each_number(row.value, entry);
  entry("impulse_ratio", impulse_ratio(row.value));
  entry("local_slip", row.local_slip);
  entry("energy_stored", row.energy_stored);
  entry("ledger_gap", row.ledger_gap);
  entry("amplification", row.amplification);
  entry("predictable", row.predictable);
}

}  // namespace clatter::validation

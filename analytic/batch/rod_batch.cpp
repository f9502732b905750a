// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/batch/rod_batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>
#include <vector>

#include "analytic/batch/batch.hpp"

namespace clatter::analytic {
namespace {

constexpr double not_there = std::numeric_limits<double>::quiet_NaN();

RodContacts no_contacts() {
  return {.angle = {not_there, not_there},
          .time = {not_there, not_there},
          .impulse = {not_there, not_there, not_there},
          .velocity = {not_there, not_there, not_there},
          .angular = {not_there, not_there, not_there},
          .impacts = 0};
}

RodContacts contacts_of(const ContactAngles& angles) {
  RodContacts row = no_contacts();
  row.is_scalar = true;
  row.impacts = angles.impacts();
  const ContactAngle* const flights[] = {&angles.beta, &angles.gamma};
  for (std::size_t n = 0; n < static_cast<std::size_t>(row.impacts); ++n) {
    row.impulse[n] = angles.impulse[n];
    row.velocity[n] = angles.velocity[n];
    row.angular[n] = angles.angular[n];
    if (n == 0) continue;
    row.angle[n - 1] = flights[n - 1]->angle;
    row.time[n - 1] = flights[n - 1]->time;
  }
  return row;
}

/// Whether a rod that leans by `lean` over the end that left the ground, and then turns by `turned` towards the other,
/// arrives on that one at the acute angle `contact`; nothing where rounding might decide.
std::optional<bool> lands_on_other_end(double lean, double turned, double contact) {
  if (!(contact < pi / 2 - 1e-6)) return {};
  const double gap = std::fabs(lean - turned + contact);
  if (gap <= 1e-6 * contact) return true;
  return gap > 1e-3 * contact ? std::optional(false) : std::nullopt;
}

/// The batch's impacts as far as each is of the other end at an angle up to 90°; nothing where it is not certain.
std::optional<RodContacts> contacts_of(const BatchOutcome& outcome, double theta, const RodParameters& rod) {
  if (outcome.is_scalar) return {};
  RodContacts row = no_contacts();
  double lean = theta, side = 1, angular = 0, normal = -1;
  for (std::size_t n = 0;; ++n) {
    normal += row.impulse[n] = outcome.impulse[n];
    angular += side * 6 * outcome.impulse[n] * (std::cos(lean) - side * rod.impulse_ratio * std::sin(lean));
    row.velocity[n] = normal;
    row.angular[n] = angular;
    ++row.impacts;
    if (row.impacts == outcome.impacts) return row;
    const double time = outcome.start[n + 1] - outcome.start[n], contact = outcome.contact_angle[n + 1];
    const std::optional<bool> is_other = lands_on_other_end(lean, side * angular * time, contact);
    if (!is_other) return {};
    if (!*is_other) return row;
    row.angle[n] = contact;
    row.time[n] = time;
    normal -= rod.gravity_number * time;
    lean = contact;
    side = -side;
  }
}

}  // namespace

void batch_contact_angles(std::span<const double> theta, const RodParameters& rod, std::span<RodContacts> rows) {
  constexpr std::size_t part = 512;
  constexpr int impacts = 3;
  if (rows.size() != theta.size()) throw std::invalid_argument("contact angles need a row for each theta");
  rod.validate();
  const double fall = -1, still = 0;
  std::vector<double> inclination(std::min(part, theta.size()));
  std::vector<BatchOutcome> outcomes(inclination.size());
  BatchDrops drops{
      make_rod({}),           {}, {&fall, 1}, {&still, 1}, {&still, 1}, {&rod.gravity_number, 1}, {&rod.restitution, 1},
      {&rod.impulse_ratio, 1}};
  for (std::size_t first = 0; first < theta.size(); first += part) {
    const std::size_t count = std::min(part, theta.size() - first);
    for (std::size_t i = 0; i < count; ++i) inclination[i] = Angle::from_degrees(theta[first + i]).radians;
    drops.inclination = std::span(inclination).first(count);
    run_lanes(drops, {.limit = impacts}, 0, std::span(outcomes).first(count));
    for (std::size_t i = 0; i < count; ++i) {
      const auto row = contacts_of(outcomes[i], inclination[i], rod);
      rows[first + i] = row ? *row : contacts_of(contact_angles(Angle::from_degrees(theta[first + i]), rod));
    }
  }
}

}  // namespace clatter::analytic

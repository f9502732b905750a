// SPDX-License-Identifier: GPL-3.0-or-later
// What a second run of a drop says about the errors of the first.
#pragma once

#include <span>
#include <vector>

#include "numeric/drop/drop_run.hpp"

namespace clatter::numeric {

/// How the second run is computed, and how many times its distance from the main run the error of that run may be.
struct SecondRun {
  Integration integration;
  double error_per_distance = 0;
};

/// The second run is finer than the main one: a tenth of its tolerance and shorter longest steps, or half its step. The
/// distance of the two is then the main run's error but for a part: 10^(−q), q the power of the tolerance with which
/// errors fall (0.9), or 1/8 for order three.  Where a tenth of the tolerance is below least_tolerance, the second run
/// is ten times coarser.  A coarser one throughout would cost half as much, but single errors scatter so much about the
/// power that of random drops' impacts only 65 of 100 lie within bars as narrow as these.
/// @param used_step  of the main run, fixed [s]
[[nodiscard]] SecondRun second_run(const Integration& main, double used_step);

/// Whether an impact has the same end in both runs, and the same touches but for grazes: those that only one of the two
/// has, while the impulses differ by less than a hundredth.
[[nodiscard]] bool has_the_same_contacts(const ImpactRecord& row, const ImpactRecord& second);

/// Whether two runs of a drop have parted in this impact, so that what follows says nothing about errors: it has other
/// contacts in the second run, or an impulse that is a tenth of its size off.
[[nodiscard]] bool goes_another_way(const ImpactRecord& row, const ImpactRecord& second);

/// Tolerance that the second run's contacts may have after an impact, or 0: a tenth of the relative distance of the
/// runs' speeds there, so that the distance grows on as it does and the second run costs less.  Only where it has grown
/// from errors of the size of `tolerance`, that of the main run, beyond a hundredth of its root: where a contact has
/// made it, the next one may err as much in both runs.  Never near that tolerance, for the same reason.
[[nodiscard]] double tolerance_beside(const Body& body, double tolerance, const ImpactRecord& row,
                                      const ImpactRecord& second);

/// Fills in `error` of each row: error_per_distance × |row − second's row|, and rounding_errors().  A vector's
/// component takes at least a tenth of the vector's distance, duration, restitution and peak force of the impulse's
/// relative one, and energies and works that relative one of the energy before: two runs may agree by chance.  A row
/// that has other contacts in the second run, and all rows after one that goes another way there, get NaN, not known,
/// and are not predictable.
void estimate_errors(const Body& body, double error_per_distance, std::vector<ImpactRecord>& rows,
                     const std::vector<ImpactRecord>& second);

/// What rounding leaves uncertain, grown by the row's amplification: 4 ε (1 + amplification) × the size of what the
/// number is computed from; of a time, also the body's radius over the speed at which the ground is reached or left;
/// and the rocking that a row leaves out.
[[nodiscard]] ImpactNumbers rounding_errors(const Body& body, const ImpactRecord& row);

/// How many of the states, from the first on, a second run can tell the errors of: those that are known and
/// predictable, before or in the contact after the first `rows` of `impacts`.
[[nodiscard]] std::size_t states_with_errors(std::span<const StateRecord> states, std::size_t rows,
                                             std::size_t impacts);

/// Fills in `error` of each state: 1.5 error_per_distance × |state − second's state|, what rounding leaves uncertain,
/// grown by the amplification, and, within the error of its time beside the beginning or end of an impact, the change
/// that this impact makes in that time; in a contact also the local error of a step, which both runs may have alike
/// where they have taken few.  Not known from an impact on whose errors are not known, and where the second
/// run has no state.
/// @param impacts  of the main run, with their errors.
/// @param tolerance  of its steps, relative; 0: they are fixed
void estimate_state_errors(const Body& body, double error_per_distance, double tolerance,
                           std::span<const ImpactRecord> impacts, std::vector<StateRecord>& states,
                           std::span<const StateRecord> second);

/// Errors of all rows: not known (NaN).
void forget_errors(std::vector<ImpactRecord>& rows);
void forget_errors(std::vector<StateRecord>& states);

}  // namespace clatter::numeric

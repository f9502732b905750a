// SPDX-License-Identifier: GPL-3.0-or-later
// The figures one by one; make_figure() chooses.
#pragma once

#include "validation/figures/figure.hpp"

namespace clatter::validation::inline figures {

/// Positions of the rod in its first flight (Fig. 8).
[[nodiscard]] Figure figure_rod_positions();

/// β(θ) (Fig. 7); P₁, P₂ (Fig. 9); β, γ (Fig. 10); the same with gravity (Figs. 11, 12).
[[nodiscard]] Figure figure_second_angle();
[[nodiscard]] Figure figure_two_impulses();
[[nodiscard]] Figure figure_both_angles();
[[nodiscard]] Figure figure_angles_with_gravity();
[[nodiscard]] Figure figure_impulses_with_gravity();

/// The rod over the angle (Fig. 14) and over friction (Fig. 15), the course of its first contact (Fig. 16), several
/// impacts (Fig. 17).
[[nodiscard]] Figure figure_rod_over_angle(CaseRuns& case_runs);
[[nodiscard]] Figure figure_rod_over_friction(CaseRuns& case_runs);
[[nodiscard]] Figure figure_rod_contact(CaseRuns& case_runs);
[[nodiscard]] Figure figure_rod_sequence(CaseRuns& case_runs);

/// The elastic phone (Figs. 19, 20), the damped one (Figs. 21 to 23), the damped one over the angle (Fig. 24).
[[nodiscard]] Figure figure_phone_history(CaseRuns& case_runs, bool damped);
[[nodiscard]] Figure figure_phone_impacts(CaseRuns& case_runs, bool damped);
[[nodiscard]] Figure figure_phone_energies(CaseRuns& case_runs);
[[nodiscard]] Figure figure_phone_over_angle(CaseRuns& case_runs);

}  // namespace clatter::validation::inline figures

// SPDX-License-Identifier: GPL-3.0-or-later
// Friction of a patch whose point of no slip is far away or nowhere, but whose slip varies.
#pragma once

#include "numeric/contact/slip_survey.hpp"

namespace clatter::numeric {

/// slip_integrals as sums over the strips between the polygon's edges and a line across the steepest direction of the
/// slip: along that direction in closed form, across it by Gauss's rule, on parts that are halved until the
/// singularities are far from them.
[[nodiscard]] SlipIntegrals add_up_strips(const SlipPatch& patch, const SlipSurvey& survey);

}  // namespace clatter::numeric

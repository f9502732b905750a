// SPDX-License-Identifier: GPL-3.0-or-later
// Contact angles and impulses over θ as a picture.
#pragma once

#include "validation/figures/picture.hpp"
#include "validation/reports/angles_report.hpp"

namespace clatter::validation::inline reports {

/// β and γ (or β beside its printed forms) and the impulses over θ.  Of more than 4000 rows every n-th is drawn, and
/// both rows between which an impact begins or ceases to happen, so that the branches end where they do.
[[nodiscard]] Picture angles_picture(const AnglesRequest& request);

}  // namespace clatter::validation::inline reports

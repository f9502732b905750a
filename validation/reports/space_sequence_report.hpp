// SPDX-License-Identifier: GPL-3.0-or-later
// What `clatter sequence` says of a drop in space.
#pragma once

#include "analytic/space/sequence.hpp"
#include "validation/output/report.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline reports {

/// A row for each impact.
[[nodiscard]] Report sequence_report(const Scene& scene, const analytic::space::Drop& drop,
                                     const analytic::space::Sequence& sequence);

}  // namespace clatter::validation::inline reports

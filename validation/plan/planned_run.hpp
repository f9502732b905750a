// SPDX-License-Identifier: GPL-3.0-or-later
// A run of the continuous model whose method and tolerance follow from the digits asked for.
#pragma once

#include <string>
#include <vector>

#include "validation/run/motion_numbers.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

struct PlannedRun {
  numeric::Simulation run;
  bool planned = false;  ///< method and tolerance were chosen here
  double asked = 0;      ///< relative error, 10^−digits
  /// Largest estimated error of the motion's numbers (MotionNumbers) over `known_impacts`, relative to the sequence's
  /// sizes; NaN: there is no estimate, infinite: a second run goes another way.
  double achieved = 0;
  /// The first impacts, before rounding errors have grown beyond what is asked, or a second run goes another way;
  /// without amplification, before estimated errors are more than asked.
  int known_impacts = 0;
  std::vector<std::string>
      warnings;           ///< of what the run leaves out although the scene has it, and of bodies that go deep
  MotionNumbers sizes{};  ///< of all impacts, against which a number counts as zero; 0 without impacts
};

/// A warning if the motion is kept in its plane although nothing but that keeps it there; empty: none.
[[nodiscard]] std::string planar_warning(const numeric::Body& body, const numeric::World& world,
                                         const numeric::MotionState& start);

/// Runs the scene.  With `run.method = "auto"`, no step and no tolerance, two pilot runs with rkck (at 1e-4 and 1e-6)
/// give the scene's error constant, the measured table (CostTable) the cheapest method and tolerance for the digits;
/// if the estimated errors are then larger than asked, and a tolerance is allowed that would serve, the run is repeated
/// with a tighter one, at most thrice.
/// The count of evaluations includes all of these.  Otherwise as numeric::simulate, with what facets may add to the
/// errors (add_facet_errors()).
/// `observer.history` takes the last run only, by a repetition that does not count.
/// @param body  scene.make_body()
/// @throws as numeric::simulate.
[[nodiscard]] PlannedRun run_to_digits(const Scene& scene, const numeric::Body& body,
                                       const numeric::Observer& observer = {});

/// As shortfall() of a sequence.
[[nodiscard]] std::string shortfall(const Scene& scene, const PlannedRun& planned);

}  // namespace clatter::validation

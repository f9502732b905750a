// SPDX-License-Identifier: GPL-3.0-or-later
// The limit of the continuous model as the ground becomes stiff, by extrapolation over ever stiffer grounds.
#pragma once

#include <string>
#include <vector>

#include "numeric/body/body.hpp"
#include "numeric/simulate.hpp"
#include "validation/run/motion_numbers.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// Whether two places of touch-down (body frame) are the same corner, or end of a smooth shape, on which the place
/// moves with the attitude.
[[nodiscard]] bool is_same_place(const numeric::Body& body, const numeric::Vector3& one, const numeric::Vector3& other);

/// One impact in the limit.
struct LimitRow {
  MotionNumbers value{};
  MotionNumbers error{};      ///< error bars: twice the estimated error of the extrapolation, plus that of the runs
  double relative_error = 0;  ///< largest of them over the sizes that the numbers are made of
  numeric::ContactEnd end = numeric::ContactEnd::a;
  numeric::Vector3 place = numeric::Vector3::Zero();  ///< as numeric::ImpactRecord::place
  numeric::FrictionMode mode = numeric::FrictionMode::frictionless;
};

struct StiffLimit {
  std::vector<LimitRow> rows;  ///< those impacts that the stiffest runs have apart from each other
  double stiffness = 0;        ///< of the stiffest run [N/m³], or its modulus [Pa]
  bool by_modulus = false;     ///< whether the ground is a half-space
  double power = 0;            ///< −d ln T/d ln k_G of the first contact's duration: 1/(p+1) for a force ∝ δ^p
  int runs = 0;
  std::string ended;  ///< why the next impact has no limit, one clause; empty if all asked for have theirs
};

/// What is asked of a limit.
struct LimitRequest {
  int impacts = 1;
  bool planar = true;  ///< keep the motion in its x–z plane
  /// In space, by what a relative error of the drop has grown at each impact.
  std::vector<double> amplification{};
  bool whole_patch = false;  ///< in space: friction acts all over the patch, that of a face
};

/// Numbers of the first impacts as k_G → ∞ with c_G/k_G kept.
///
/// They are smooth functions of the duration T of the first contact, which falls like k_G^(−1/(p+1)): turning,
/// gravity and indentation during a contact are all of the order of T.  The stiffness rises sixteenfold from run to
/// run until every contact is short against the flights beside it, the turning in it small against its angle (in space:
/// turning and indentation together against the height of the next vertex), and the indentation against the body's
/// smallest feature; then a + b T + c T² through three runs (T^(1+1/p) in place of T² where a contact sticks and lets
/// go) gives the value at T = 0, and the changes from one triple of runs to the next its error.  Impacts whose relative
/// error bar stays above 1e-3 have no limit here, nor do those after them.
///
/// In space friction acts at the pressure centre alone (numeric::World::point_friction): what a corner's spin does to
/// it vanishes with the patch, so that the limit is the same, and the bars hold the stiffest run's own error estimates.
/// A face's patch does not vanish (LimitRequest::whole_patch).
/// Where c_G v/k_G > 1 numbers go like T ln T over many runs, and the bars are four times as wide.
[[nodiscard]] StiffLimit stiff_limit(const Scene& scene, const numeric::Body& body, const LimitRequest& request);

}  // namespace clatter::validation

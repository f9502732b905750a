// SPDX-License-Identifier: GPL-3.0-or-later
// The discrete model's part of a comparison, planar or in space: one form for both.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "validation/compare/prediction.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/motion_numbers.hpp"

namespace clatter::validation {

/// One impact.
struct SequenceImpact {
  MotionNumbers numbers{}, errors{};
  std::string end;  ///< which end strikes in the plane; in space the corner
  /// In space: of the corner that strikes, or the mean of several, body frame from the centre of mass [m].
  std::optional<numeric::Vector3> place;
  double amplification = 0;
  bool predictable = true;    ///< errors of the start have not grown too far
  bool is_group = false;      ///< in space: several corners land at once
  bool sticks = false;        ///< ends in stick
  bool nearly_stops = false;  ///< in space: slip comes within a thousandth of the contact's speed of stopping
  bool jams = false;          ///< friction is beyond Painlevé's limit
  /// Why the rebound is not that of an ever stiffer ground: several corners at once; empty: it is, up to `tipping`.
  std::string open;
  std::string follows_open;  ///< the same for an impact that only comes after such a one
  bool is_face = false;      ///< in space: a level face lands with all of its area
  MotionNumbers tipping{};   ///< of such a face: face_tipping
};

/// A corner of a body in space and what reports call it.
struct NamedCorner {
  numeric::Vector3 place = numeric::Vector3::Zero();  ///< body frame, from the centre of mass [m]
  std::string name;
};

struct DiscreteSide {
  bool in_space = false;
  std::vector<NamedCorner> corners;  ///< in space
  ComparedQuantities quantities;     ///< those that the comparison shows
  std::vector<SequenceImpact> impacts;
  MotionNumbers scales{};
  analytic::Outcome outcome = analytic::Outcome::no_further_impact;
  std::string message;  ///< why the sequence ended
  /// Sizes of the deviations to expect at the scene's own stiffness, for the durations of the contacts [s].
  std::function<std::vector<PredictedSize>(const std::vector<double>&)> predict;
};

/// The sequence of the drop of a scene with that body: in space also where a face lands that slides in the plane, since
/// only a face in space has its width, over which the ground presses and rubs.
/// @throws analytic::OutsideModelError if the first impact leaves the model.
[[nodiscard]] DiscreteSide discrete_side(const Scene& scene, DiscreteBody& body);

}  // namespace clatter::validation

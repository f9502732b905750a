// Drops in space with their impacts by an independent computation of 40 digits.
#pragma once

#include <string>
#include <vector>

#include "analytic/space/sequence.hpp"

namespace clatter::validation {

struct SpaceReferenceImpact {
  double time = 0;  ///< after the first impact [s]
  int corner = 0;   ///< as analytic::space::box counts them
  analytic::space::Quaternion attitude;
  analytic::space::Vector3 impulse, velocity, angular_velocity;  ///< the latter two after the impact
};

struct SpaceReference {
  std::string name;
  analytic::space::Drop drop;
  double tolerance = 0;  ///< of doubles, relative to the sequence's sizes: 5e-12, or 5e-13 times the sensitivity
  std::vector<SpaceReferenceImpact> impacts;
};

/// The drops of boxes in tests/analytic/reference/space_scenes.csv.
[[nodiscard]] const std::vector<SpaceReference>& space_references();

}  // namespace clatter::validation

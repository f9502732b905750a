// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as the discrete model in space sees it.
#pragma once

#include <optional>
#include <string>
#include <variant>

#include "analytic/space/sequence.hpp"
#include "numeric/body.hpp"
#include "numeric/simulate.hpp"
#include "validation/record/impact_quantities.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation::inline scene {

/// Whether the planar discrete model does for the drop: it stays in its plane by symmetry, and the body has an outline
/// of at most four corners there.  Otherwise the model in space runs, which gives the same in the plane up to rounding.
[[nodiscard]] bool is_planar(const Scene& scene, const numeric::Body& body);

/// The body with its own corners: the vertices of the hull of its surface.
[[nodiscard]] analytic::space::Body space_body(const numeric::Body& body);
/// The drop for the discrete model: real corners and inertia, restitution from the ground's damping at each impact's
/// own speed, Coulomb friction with the sliding coefficient.
/// @throws analytic::OutsideModelError for regularised friction.
[[nodiscard]] analytic::space::Drop space_drop(const Scene& scene, const numeric::Body& body);

/// The drop of `body` with restitution and friction as the impact.* keys give them; an impulse ratio acts along x.
/// @throws BadInput if drop.height is not above the centre of mass at the touch.
[[nodiscard]] analytic::space::Drop impact_space_drop(const Scene& scene, analytic::space::Body body);

/// The drop for the discrete model that runs it: in the plane or in space, as is_planar() says.
using DiscreteDrop = std::variant<analytic::Drop, analytic::space::Drop>;
/// With restitution and friction as the impact.* keys give them.  @throws as impact_drop and impact_space_drop
[[nodiscard]] DiscreteDrop chosen_drop(const Scene& scene);
/// On the scene's own ground, as discrete_drop and space_drop have it.  @throws as those
[[nodiscard]] DiscreteDrop chosen_drop(const Scene& scene, const numeric::Body& body);

/// A scene's body by its sizes alone, for both models, each form made when a drop first needs it: a rod is a round
/// cylinder with its rims in space (radius 0: a thin rod).
class DiscreteBody {
 public:
  /// @throws as body_properties
  explicit DiscreteBody(const Scene& scene);
  /// The drop of a scene that has this body.  @throws as impact_drop and impact_space_drop
  [[nodiscard]] DiscreteDrop drop(const Scene& scene);
  /// Of mass, in the body's frame [m].
  [[nodiscard]] const numeric::Vector3& centre() const { return centre_; }

 private:
  [[nodiscard]] const std::optional<analytic::PlanarBody>& outline();
  [[nodiscard]] const analytic::space::Body& in_space();

  Scene scene_;
  numeric::Vector3 centre_;
  std::optional<numeric::Body> solid_;  ///< of a mesh
  bool has_looked_for_outline_ = false;
  std::optional<analytic::PlanarBody> outline_;
  std::optional<analytic::space::Body> in_space_;
};

/// Name of a corner of the body: the signs of the coordinates of a box's corner ("+x-y+z"), "a" and "b" of a rod's
/// ends, otherwise its number from 1.
[[nodiscard]] std::string corner_name(const Scene& scene, const analytic::space::Corner& corner);
/// Names of the corners whose mean is `place` [m], from the centre of mass, as of those that touch at once; empty for a
/// mesh, whose corners have numbers that depend on all of them.
[[nodiscard]] std::string corner_names(const Scene& scene, const numeric::Vector3& place);
/// What small tilts make of corners that land at once: how many outcomes and how far apart; of a level rim, which has
/// one for each direction, how far apart.
[[nodiscard]] std::string tilt_words(const analytic::space::OutcomeSet& set);
/// The corners of a row in words: "2 corners land at once", "a round end lands level".
[[nodiscard]] std::string landing_words(const std::vector<analytic::space::Corner>& corners);
/// The rows of a sequence with the names of the corners that strike.
/// @param centre  of mass, in the body's frame [m]
[[nodiscard]] std::vector<SpaceRow> space_rows(const Scene& scene, const analytic::space::Sequence& sequence,
                                               const numeric::Vector3& centre);

/// The rows of a run of the continuous model, with the names of the corners that touch first.
[[nodiscard]] std::vector<ContinuousRow> continuous_rows(const Scene& scene, const numeric::Simulation& run);

}  // namespace clatter::validation::inline scene

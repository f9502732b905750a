// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as the discrete model sees it, in the plane or in space: the one rule from a scene to its law, its body and
// its drop, which every command, notebook and page takes.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/landing/tilted_outcomes.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "numeric/body/body.hpp"
#include "numeric/simulate.hpp"
#include "validation/run/run.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// What gave a number of the discrete model's law.
enum class LawSource {
  standard,  ///< neither [impact] nor a ground: elastic, frictionless
  impact,    ///< the [impact] keys
  ground,    ///< c_G/k_G, or the ground's sliding friction
};

/// Restitution and friction of the discrete model, and where each came from.
struct DiscreteLaw {
  analytic::ImpactLaw law;
  LawSource restitution_from = LawSource::standard, friction_from = LawSource::standard;
};

/// The law that the discrete model takes: each number from [impact] where that gives it, else from the ground.
/// @throws analytic::OutsideModelError where the ground's regularised friction would be taken.
[[nodiscard]] DiscreteLaw discrete_law(const Scene& scene);

/// By what the law that [impact] gives the discrete model is not the ground's, which the continuous model takes, one
/// clause; empty: by nothing.
/// @param approach  speed of the first contact, for the ground's restitution [m/s]
[[nodiscard]] std::string other_law_words(const Scene& scene, double approach);
/// The same as a remark on a run of the continuous model, whose numbers a reader may take for those of that law; empty
/// without an impact.
[[nodiscard]] std::string other_law_remark(const Scene& scene, const numeric::Simulation& run);

/// Why the drop moves in space and not in the plane y = 0, as its keys say; empty: in the plane.  The one place that
/// decides so; planar_body refuses meshes whose shape or mass is not symmetric about that plane.
[[nodiscard]] std::string reason_in_space(const Scene& scene);

/// The planar body with the same mass, the same moment of inertia about y and, as vertices, the corners of the real
/// outline in the x–z plane: a, b (below), a-top, b-top.
/// @throws analytic::OutsideModelError if the body is not symmetric about the plane y = 0 (products of inertia or
///         corners off it by more than 1e-9 of its size), or its outline has more than four corners.
[[nodiscard]] analytic::PlanarBody planar_body(const numeric::Body& body);
/// The body with its own corners: the vertices of the hull of its surface.
[[nodiscard]] analytic::space::Body space_body(const numeric::Body& body);

/// A drop for the discrete model that runs it: in the plane where reason_in_space is empty and the body has an outline
/// there, else in space, where the same motion comes out up to rounding.
using DiscreteDrop = std::variant<analytic::Drop, analytic::space::Drop>;
/// Its sequence.
using DiscreteSequence = std::variant<analytic::Sequence, analytic::space::Sequence>;

/// The law of a drop.
[[nodiscard]] const analytic::ImpactLaw& law_of(const DiscreteDrop& drop);
/// Approach speed of the lowest point at the first touch [m/s].
[[nodiscard]] double first_approach_speed(const DiscreteDrop& drop);

/// A scene's body for the discrete model, each form made when a drop first needs it.  By its sizes alone a rod is a
/// round cylinder with its rims in space (radius 0: a thin rod), a box its outline or its corners; of a mesh, or of
/// `solid`, the corners of the surface.
class DiscreteBody {
 public:
  /// @throws as body_properties
  explicit DiscreteBody(const Scene& scene);
  /// The corners of a mesh in place of those of the shape that it stands for.
  explicit DiscreteBody(std::shared_ptr<const numeric::Body> solid);
  /// The same of a mesh that is there as long as this.
  explicit DiscreteBody(const numeric::Body& solid);
  /// A scene's where the continuous model's body is there already and stays, whose corners a mesh has.
  DiscreteBody(const Scene& scene, const numeric::Body& body);
  /// The drop of a scene that has this body.
  /// @throws BadInput if drop.height is not above the centre of mass at the touch; OutsideModelError as discrete_law.
  [[nodiscard]] DiscreteDrop drop(const Scene& scene);
  /// The same in space, also where it moves in the plane.  @throws as drop
  [[nodiscard]] analytic::space::Drop drop_in_space(const Scene& scene);
  /// The centre of mass in the body's frame [m].
  [[nodiscard]] const numeric::Vector3& centre() const { return centre_; }

  /// In the plane y = 0; none of a body that is not symmetric about it.  @throws as planar_body
  [[nodiscard]] const std::optional<analytic::PlanarBody>& outline();
  /// About the centre of mass.
  [[nodiscard]] const analytic::space::Body& in_space();

 private:
  std::optional<Scene> scene_;                  ///< of a shape by its sizes
  std::shared_ptr<const numeric::Body> solid_;  ///< of a mesh
  numeric::Vector3 centre_ = numeric::Vector3::Zero();
  bool has_looked_for_outline_ = false;
  std::optional<analytic::PlanarBody> outline_;
  std::optional<analytic::space::Body> in_space_;
};

/// The drop of a scene: its body, motion and law for the discrete model.  @throws as DiscreteBody
[[nodiscard]] DiscreteDrop discrete_drop(const Scene& scene);
/// Whether the corners or the inertia of the two drops' bodies differ by more than 1e-9 of their size: those of a mesh
/// from those of the shape that it stands for.
[[nodiscard]] bool has_other_corners(const DiscreteDrop& drop, const DiscreteDrop& mesh);

/// A scene with what the discrete model makes of it, made once.
struct PreparedScene {
  Scene scene;              ///< `speed` is that of the fall, where a height is given
  numeric::Vector3 centre;  ///< of mass, in the body's frame [m]
  DiscreteDrop drop;
};

/// @throws as discrete_drop
[[nodiscard]] PreparedScene prepared(Scene scene);
/// A scene for `sequence` and `explain`.
/// @throws BadInput as read_scene, and for a scene that sweeps what the discrete model takes; as prepared().
[[nodiscard]] PreparedScene read_discrete_scene(const SceneValues& values, const std::vector<SceneOverride>& overrides);

/// "e = 0.770 at 4.33 m/s, from the ground's damping; Coulomb friction μ = 0.075, from the ground".
/// @param approach  of the first contact [m/s]; none: e is told by c_G/k_G
/// @param unsettled  keys of which nothing is to be said
[[nodiscard]] std::string law_words(const Scene& scene, std::optional<double> approach, const KeyNames& unsettled = {});
/// The same as fields: "law", "restitution" (at "approach_speed"), "restitution_from", "friction_law", "friction",
/// "friction_from".
[[nodiscard]] Value law_fields(const Scene& scene, std::optional<double> approach);

/// Name of a corner of the body: the signs of the coordinates of a box's corner ("+x-y+z"), "a" and "b" of a rod's
/// ends, otherwise its number from 1.
[[nodiscard]] std::string corner_name(const Scene& scene, const analytic::space::Corner& corner);
/// Names of the corners whose mean is `place` [m], from the centre of mass, as of those that touch at once; empty for a
/// mesh, whose corners have numbers that depend on all of them.
[[nodiscard]] std::string corner_names(const Scene& scene, const numeric::Vector3& place);
/// What small tilts make of corners that land at once: how many outcomes, how far apart and the largest share of the
/// directions; of a level rim, which has one for each direction, how far apart.
[[nodiscard]] std::string tilt_words(const analytic::space::OutcomeSet& set);
/// The corners of a row in words: "2 corners land at once", "a round end lands level".
[[nodiscard]] std::string landing_words(const std::vector<analytic::space::Corner>& corners);
/// The inclination of the first touch as the scene gives it [°]; no_inclination after a free flight.
[[nodiscard]] double given_inclination(const Scene& scene);
/// The run of a drop's sequence, in space with the names and places of the corners that strike.
/// @param centre  of mass, in the body's frame [m]
[[nodiscard]] Run named_run(const Scene& scene, const DiscreteSequence& sequence, const numeric::Vector3& centre);
/// The run of the continuous model, with the names of the corners that touch first.
[[nodiscard]] Run named_run(const Scene& scene, const numeric::Simulation& simulation);

// A run of the discrete model with its record.

/// The method of the discrete model under its name, "auto" or "discrete", which are the same.
/// @throws BadInput for closed-form, which former versions had, and for unknown names.
std::string read_sequence_method(const std::string& option, const std::string& name);

/// What a scene asks of its sequence.
[[nodiscard]] analytic::SequenceOptions sequence_options(const Scene& scene, bool with_errors = true);

/// A sequence of the discrete model, and its record.
struct DiscreteRun {
  DiscreteSequence sequence;
  Run run;
};

/// Runs the scene.  Warnings are left in the run.
/// @throws as impact_sequence.
[[nodiscard]] DiscreteRun run_discrete(const PreparedScene& prepared);

}  // namespace clatter::validation

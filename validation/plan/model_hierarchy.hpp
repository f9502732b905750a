// SPDX-License-Identifier: GPL-3.0-or-later
// The hierarchy of models: from a formula to the body in space, each level under one interface.
#pragma once

#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "analytic/plane/sequence.hpp"
#include "analytic/space/sequence/sequence.hpp"
#include "numeric/body/body.hpp"
#include "numeric/motion/motion_state.hpp"
#include "validation/run/motion_numbers.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

// Whether a body and its motion are their own mirror image.

/// Whether the body at this attitude is its own mirror image in the vertical plane y = 0 through its centre of mass and
/// moves along it, so that the motion stays in it.  Vertices and products of inertia count as mirrored within 1e-9 of
/// the body's size, velocities within rounding.
[[nodiscard]] bool is_mirror_image(const numeric::Body& body, const numeric::MotionState& state);

// The first three impacts of a thin rod from Eqs. 9 and 12 alone.

/// Why the closed form does not apply to a drop; empty: it does.  It is for a thin rod that falls straight, one end
/// first, with Newton's restitution and an impulse ratio as given, or none.
[[nodiscard]] std::string reason_against_closed_form(const analytic::Drop& drop);

/// The first impacts, at most three, of a drop to which it applies.  One impact is Eq. 9; with the second and third
/// come the roots β and γ of Eq. 12.  What comes after the third impact is not known.  Accuracy: as contact_angles();
/// the rows' errors are left unknown.
[[nodiscard]] analytic::Sequence closed_form_sequence(const analytic::Drop& drop, int impacts);

/// The models, from the cheapest to the one that leaves nothing out.
enum class ModelLevel {
  closed_form,  ///< Eqs. 9 and 12: thin rod that falls straight, without friction or damping; at most three impacts
  discrete,     ///< instantaneous impacts at the real corners, flights between them, in the plane of the motion
  discrete_in_space,  ///< the same in three dimensions, for a drop that leaves its plane
  planar,             ///< continuous contact, kept in its plane
  spatial,            ///< continuous contact in three dimensions
};
inline constexpr ModelLevel all_levels[] = {ModelLevel::closed_form, ModelLevel::discrete,
                                            ModelLevel::discrete_in_space, ModelLevel::planar, ModelLevel::spatial};

[[nodiscard]] const char* level_name(ModelLevel level);
/// What a level takes for granted, in which the level above it does not follow.
[[nodiscard]] const char* level_assumption(ModelLevel level, const numeric::Ground& ground);
[[nodiscard]] inline bool is_continuous(ModelLevel level) {
  return level == ModelLevel::planar || level == ModelLevel::spatial;
}

/// What a continuous run can leave out of a scene that has it.
enum class Part {
  friction,            ///< μ_s = μ_k = 0
  damping,             ///< c_G = 0
  gravity_in_contact,  ///< g acts in flight only
  unmerged_faces,      ///< coplanar elements become one facet; the result is the same
};
inline constexpr Part all_parts[] = {Part::friction, Part::damping, Part::gravity_in_contact, Part::unmerged_faces};
[[nodiscard]] const char* part_name(Part part);
/// Whether the scene has it, so that something is left out without it.
[[nodiscard]] bool has_part(const Scene& scene, Part part);
/// The scene without it.
[[nodiscard]] Scene without(Scene scene, Part part);

/// The scene with no more evaluations than a run of a plan or a measurement may take, 2 million.
[[nodiscard]] Scene limited(Scene scene);

/// How a level is run.  Method, tolerance and step are for the continuous levels.
struct LevelSetting {
  ModelLevel level = ModelLevel::spatial;
  numeric::Method method = numeric::Method::rk8pd;
  double tolerance = 0;  ///< relative, per step, of an adaptive method
  double step = 0;       ///< of tvd-rk3 [s]
};

/// What a level says of a scene.
struct LevelResult {
  std::vector<MotionNumbers> rows;
  long evaluations = 0;  ///< of the contact force; of height functions for the levels without
  std::string ending;    ///< how it ended, in words
};

/// A scene with what its levels share.
class ModelHierarchy {
 public:
  /// `observer` of the continuous levels' runs.  @throws as Scene::make_body and start.
  explicit ModelHierarchy(Scene scene, numeric::Observer observer = {});

  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const numeric::Observer& observer() const { return observer_; }
  [[nodiscard]] const numeric::Body& body() const { return body_; }
  /// As the discrete model has it, if it applies.
  [[nodiscard]] const std::optional<analytic::Drop>& drop() const { return drop_; }
  /// As the discrete model in space has it, if that applies.
  [[nodiscard]] const std::optional<analytic::space::Drop>& space_drop() const { return space_drop_; }
  /// Why the level does not apply to the scene; empty: it does.
  [[nodiscard]] const std::string& against(ModelLevel level) const { return against_[static_cast<std::size_t>(level)]; }
  /// The lowest level that leaves nothing out of this scene: a body that is symmetric about the plane of its motion
  /// stays in it, so that the planar level is the spatial one.
  [[nodiscard]] ModelLevel full() const {
    return against(ModelLevel::planar).empty() ? ModelLevel::planar : ModelLevel::spatial;
  }

  /// The first `impacts` impacts by a level that applies.
  [[nodiscard]] LevelResult run(const LevelSetting& setting, int impacts) const;
  /// The same of a continuous level with all its numbers; neither error estimates nor amplification.
  [[nodiscard]] numeric::Simulation simulate(const LevelSetting& setting, int impacts) const;
  /// With what the request asks for besides.
  [[nodiscard]] numeric::Simulation simulate(const LevelSetting& setting, const numeric::Request& request) const;

 private:
  void find_discrete();
  [[nodiscard]] std::string find_closed_form();
  [[nodiscard]] std::string reason_against_planar() const;

  Scene scene_;
  numeric::Observer observer_;
  numeric::Body body_;
  numeric::MotionState start_;
  std::optional<analytic::Drop> drop_, thin_rod_;
  std::optional<analytic::space::Drop> space_drop_;
  std::string against_[std::size(all_levels)];
};

/// Reference values of a scene: the full level by rk8pd at the smallest tolerance.
struct Truth {
  LevelSetting setting;
  std::vector<MotionNumbers> rows;  ///< those whose estimated relative error is at most `trusted`
  MotionNumbers sizes{};
  double error = 0;         ///< largest of these estimates
  double contact_time = 0;  ///< duration of the first contact [s]
  /// Why the reference run has fewer impacts than asked for, where a number that could not be computed or a limit on
  /// the work is the reason; else empty.
  std::string cut_short;
};
[[nodiscard]] Truth true_values(const ModelHierarchy& hierarchy, double trusted = 1e-6);

}  // namespace clatter::validation

// SPDX-License-Identifier: GPL-3.0-or-later
// A body that is struck at several places while its velocity changes and its attitude does not.
#pragma once

#include <optional>
#include <vector>

#include "analytic/space/impulse/contact_area.hpp"
#include "analytic/space/impulse/impact.hpp"
#include "analytic/space/landing/edge_friction.hpp"

namespace clatter::analytic::space {

/// Impulse on a body by several corners, and what it did.
struct GroupImpact {
  Vector3 impulse = Vector3::Zero();                 ///< P, world frame [N·s]
  Vector3 moment = Vector3::Zero();                  ///< of the impulses about the centre of mass [N·m·s]
  Vector3 velocity_after = Vector3::Zero();          ///< of the centre of mass, world frame [m/s]
  Vector3 angular_velocity_after = Vector3::Zero();  ///< world frame [rad/s]
  double approach_speed = 0;                         ///< largest of the corners [m/s]
  double energy_loss = 0;                            ///< −[P·(V + V′) + M·(ω + ω′)]/2 [J]
  bool is_whole = false;                             ///< the body rebounds as a whole, in one strike
  bool tilts = false;                                ///< friction has tilted it beside that
  bool is_open = false;   ///< of corners that are equally fast an index decided which strikes first
  double path_error = 0;  ///< of the impulse, relative, where it is more than that of paths without tilting
  /// Indices (Corner::index) of the corners of each strike, in order.
  std::vector<std::vector<int>> order;
  PathKind path = PathKind::frictionless;  ///< of the first strike
};

/// The impulse of a face that rebounds as a whole, and where its pushes act.
struct FaceRebound {
  Vector3 impulse = Vector3::Zero();         ///< P, world frame [N·s]
  Vector3 moment = Vector3::Zero();          ///< about the centre of mass [N·m·s]
  Vector2 pressure_point = Vector2::Zero();  ///< of (2) in simultaneous.hpp, from the centre of mass [m]
  PathKind path = PathKind::frictionless;
  std::optional<double> spin_after = {};  ///< ω_z, where friction has a couple about the vertical [rad/s]
  bool tilts = false;                     ///< the turning is not that of the rebound as a whole
  double path_error = 0;                  ///< as GroupImpact's
  bool is_lost = false;                   ///< its friction could not be followed, or makes energy
};

/// Bound on the rounding of a point's normal velocity u during an impact [m/s].  With 2E/m = V² + ω·Iω/m, which bounds
/// what an impulse P changes, δω = I⁻¹ (r × δP) in body axes, where I is nearly diagonal:
///     δu = 64 ε (|V| + |ω| |r|) + 16 ε √(2E/m) (1 + m |r| Σₖ Jₖ |eₖ × r|),   Jₖ = Σⱼ |(I⁻¹)ₖⱼ|.              (1)
/// Two normal velocities that differ by less are equal, and one below it is zero: their signs would be rounding's.
class VelocityRounding {
 public:
  VelocityRounding(const Body& body, const State& before);
  /// @param place  r, body frame from the centre of mass
  [[nodiscard]] double at(const Vector3& place) const;

 private:
  double speed_, turning_, change_;  ///< |V|, |ω|, √(2E/m)
  Vector3 gain_;                     ///< m J
};

/// Strikes add up to one GroupImpact.  World frame; arms are from the centre of mass.
class StrikingBody {
 public:
  /// Body and law must outlive this.  @throws std::domain_error as ImpactLaw::validate()
  StrikingBody(const Body& body, const State& before, const ImpactLaw& law);

  [[nodiscard]] Vector3 arm(const Vector3& place) const { return axes_ * place; }
  /// Inverse of arm(): body frame.
  [[nodiscard]] Vector3 place(const Vector3& arm) const { return axes_.transpose() * arm; }
  [[nodiscard]] const State& state() const { return state_; }
  [[nodiscard]] const Body& body() const { return body_; }
  [[nodiscard]] const ImpactLaw& law() const { return law_; }
  [[nodiscard]] const Matrix3& inverse_inertia() const { return inverse_inertia_; }
  [[nodiscard]] Vector3 velocity(const Vector3& arm) const {
    return state_.velocity + state_.angular_velocity.cross(arm);
  }
  /// Rounding of a point's normal velocity [m/s].
  [[nodiscard]] double rounding(const Vector3& arm) const { return rounding_.at(place(arm)); }
  [[nodiscard]] bool approaches(const Vector3& arm) const { return velocity(arm).z() < -rounding(arm); }
  void know_approach(double speed) { impact_.approach_speed = std::fmax(impact_.approach_speed, speed); }

  /// The impact of one point; `points` are the indices that the record gets.  @throws as space::strike()
  void strike_at(const Vector3& place, const std::vector<int>& points) { strike_at(place, points, law_); }
  void strike_at(const Vector3& place, const std::vector<int>& points, const ImpactLaw& law);
  /// V_z, ω_x, ω_y → −e times themselves, with friction below the centre of mass; nothing if that does not come down.
  /// @param depth  of the ground below the centre of mass [m]
  [[nodiscard]] std::optional<FaceRebound> face_rebound(double depth) const;
  /// The same with friction all over the area, from below the centre of mass; nothing if the area
  /// has no pressure for it.  Under every law but Newton's e is the largest without a gain of energy.
  [[nodiscard]] std::optional<FaceRebound> face_rebound(double depth, const ContactArea& area) const;
  /// The edge between two places at one height, as (1) of edge_friction.hpp has it.
  [[nodiscard]] EdgeContact edge_contact(const Vector3& from, const Vector3& to) const;
  /// Strikes with that edge, its edge_contact(from, to), friction all along it; nothing, and nothing done, if it has no
  /// pressure for that, or gains energy.
  std::optional<EdgeImpulse> strike_along(const EdgeContact& edge, const Vector3& from, const Vector3& to,
                                          const std::vector<int>& points);
  /// Goes on from another that began with the same body, state and law.
  void take(const StrikingBody& other);
  void push(const FaceRebound& face, const std::vector<int>& points);

  void leave_open() { impact_.is_open = true; }
  /// Adds an impulse to the last strike.
  void add(const Vector3& impulse, const Vector3& moment);
  [[nodiscard]] const GroupImpact& impact() const { return impact_; }
  [[nodiscard]] std::size_t strikes() const { return impact_.order.size(); }
  /// Lets what follows count as part of the last strike, or as strikes of their own.
  void merge_strikes(bool merge) { merges_ = merge; }
  [[nodiscard]] GroupImpact result() const;

 private:
  void push(const Vector3& impulse, const Vector3& moment, PathKind path, const std::vector<int>& points);
  [[nodiscard]] double face_restitution() const;
  [[nodiscard]] FaceRebound face_rebound_by(double restitution, double depth) const;
  [[nodiscard]] std::optional<FaceRebound> face_rebound_by(double restitution, double depth,
                                                           const ContactArea& area) const;
  [[nodiscard]] double energy() const;
  [[nodiscard]] double energy_loss(const FaceRebound& face) const;

  const Body& body_;
  const ImpactLaw& law_;
  State state_, before_;
  VelocityRounding rounding_;
  Matrix3 axes_, inverse_inertia_;
  GroupImpact impact_;
  bool merges_ = false;
};

/// Strikes in turn can go on as a geometric series, each round a little weaker than the one before.
class StrikeSeries {
 public:
  /// @param block  strikes in each sum
  explicit StrikeSeries(std::size_t block = 64) : block_(block), next_(block) {}
  /// Once the parts of the sums over blocks of strikes fall by ratios q of their own, adds the blocks to come, block·
  /// q(1 − qⁿ)/(1 − q), to 1e-9 of all so far and until a tenth is left, which still approaches; true if so.
  bool converges(StrikingBody& struck);

 private:
  using Sum = Eigen::Matrix<double, 6, 1>;  ///< impulse and moment
  std::vector<Sum> sums_;                   ///< after each block
  std::size_t block_, next_;
};

/// @throws NumericalError if there are too many
void check_number_of_strikes(std::size_t strikes);

}  // namespace clatter::analytic::space

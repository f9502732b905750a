// SPDX-License-Identifier: GPL-3.0-or-later
// How errors of a drop in space and of rounding grow along its sequence.
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>

#include "analytic/base/limits.hpp"
#include "analytic/space/impulse/impact.hpp"
#include "analytic/space/sequence/impact_rows.hpp"
#include "analytic/space/sequence/sustained_contact.hpp"

namespace clatter::analytic::space {

/// Errors of the state (t, δθ, δV, δω) at touch and departure, to first order: δθ the rotation vector of the attitude's
/// error, everything in the world frame; the height of the centre of mass follows from the touch.
///
/// Impact: impact.hpp; where that has none, central differences, of a corner's P in its velocity and in δθ,
/// each on its own scale, of a group's impact in δθ, V and ω.  Flight: flight_derivatives.hpp.
/// A corner's normal velocity after an impact and after a small hop is carried beside V and ω to relative accuracy:
/// rounding of those leaves it as it is.
/// Independent errors are columns of a factor F of the covariance F Fᵀ; bounds are three standard deviations.
/// Domain: errors so small that all this is linear; beyond, nothing is predictable any more, nor is a row whose corner
/// another one precedes within the errors, nor what follows corners that arrive together (their order, which rounding
/// decides, matters), unless the body does not turn.
class ErrorGrowth {
 public:
  /// Errors of the drop: one unit in the last place of each number.
  /// @param gravity, gravity_along  as Drop's
  ErrorGrowth(const Body& body, const State& start, double gravity, double gravity_along = 0);

  /// Impulse and velocities after an impact, as a function of the state before.
  using Strike = std::function<Impact(const State&)>;
  /// Fills in the row's errors and amplification, and carries the errors through the impact.
  /// @param derivatives  of the impact; where they are not all finite, differences of `strike` serve
  void strike(const Strike& strike, const StrikeDerivatives& derivatives, ImpactRow& row);
  /// Carries the errors through a flight.
  void fly(const FreeFlight& flight, const FirstContact& contact, const Vector3& from_place, const Vector3& to_place);
  /// What the errors have become after this time of a flight that the last impact, or the drop, has begun, of a state
  /// at exactly that time; and the bound on the error of its height.
  /// @param from  of fly()
  struct InFlight {
    StateErrors state;
    double height = detail::infinite;  ///< [m]
  };
  [[nodiscard]] InFlight in_flight(const FreeFlight& flight, double time, const Vector3& from) const;
  /// Counts time from the touch that fly() has come to.  Returns the bound on the error of the time until then.
  double begin_time();
  /// Carries the errors through a contact that lasts; amplification is not known thereafter.
  /// @param derivatives  contact_derivatives(); none: nothing is predictable any more
  /// @param before  what adds to the errors at its beginning
  /// @param rounding  contact_rounding()
  void stay(const SustainedContact& contact, const std::optional<ContactDerivatives>& derivatives,
            const StateErrors& before, const StateErrors& rounding);
  /// Begins anew with these bounds.
  void restart(const StateErrors& errors);
  /// On the errors of the state.
  [[nodiscard]] StateErrors bounds() const;
  /// After a flight without contact: whether the errors leave that certain.
  void end_without_contact(const FirstContact& contact);

  [[nodiscard]] bool predictable() const { return predictable_; }
  void give_up() { predictable_ = false; }

 private:
  static constexpr int size = 10, most_columns = 4 * size;
  using Factor = Eigen::Matrix<double, size, Eigen::Dynamic, Eigen::ColMajor, size, most_columns>;
  using Deviations = Eigen::Matrix<double, size, 1>;
  using Gradient = Eigen::Matrix<double, 1, size>;

  /// Changes of impulse, velocity and angular velocity after an impact for the columns of a factor.
  using Struck = Eigen::Matrix<double, 9, Eigen::Dynamic, Eigen::ColMajor, 9, most_columns>;

  [[nodiscard]] static Factor triangular(const Factor& factor);
  void append(const Factor& columns);
  [[nodiscard]] Factor impulse_rounding(const ImpactRow& row) const;
  [[nodiscard]] static Factor without_approach(Factor columns, const Gradient& approach, double rounding);
  [[nodiscard]] double approach_rounding(const ImpactRow& row) const;
  [[nodiscard]] Gradient approach_gradient(const Quaternion& attitude, const Corner& corner,
                                           const Vector3& turning) const;
  [[nodiscard]] StrikeDerivatives corner_differences(const Strike& strike, const ImpactRow& row) const;
  [[nodiscard]] Struck differences_along_errors(const Strike& strike, const ImpactRow& row) const;
  [[nodiscard]] StrikeDerivatives group_differences(const Strike& strike, const ImpactRow& row) const;
  /// Derivative of the energy before the impact by the state before, with z = −r_z and the inertia turned; of the
  /// energy after it by the attitude.
  struct EnergyGradients {
    Gradient before = Gradient::Zero(), after = Gradient::Zero();
  };
  [[nodiscard]] EnergyGradients energy_gradients(const ImpactRow& row, const Matrix3& inertia) const;
  void fill(const Struck& struck, ImpactRow& row) const;
  [[nodiscard]] Factor rounding_of(const ImpactRow& row) const;  ///< of the impact
  void depart();
  void check_others(const FreeFlight& flight, const FirstContact& contact, const Quaternion& attitude,
                    const Vector3& touching);
  void strike_again(const State& now, const FirstContact& contact, const Corner& corner);
  [[nodiscard]] double height_bound(double time) const;

  const Body& body_;
  double gravity_, gravity_along_;
  double energy_ = 0;  ///< bound on the error of the energy, where the ground slopes [J]
  Matrix3 inverse_inertia_;
  Factor factor_;
  Factor arriving_;                         ///< the rounding of a flight, until its impact is known
  Factor leaving_;                          ///< that of an impact, until something follows
  Eigen::Matrix<double, size, 9> of_drop_;  ///< changes of the state for changes of the drop
  bool predictable_ = true, resumed_ = false;
};

}  // namespace clatter::analytic::space

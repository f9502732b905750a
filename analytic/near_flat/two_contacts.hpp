// SPDX-License-Identifier: GPL-3.0-or-later
// Two contacts that strike in turn, in the limit of a flat landing: a billiard in a wedge.
//
// Without gravity and friction, and in the limit of no inclination, the body's place is a point that moves straight
// between strikes in the plane of (z, κ φ), in which kinetic energy is m/2 times the square of the speed.  The ground
// leaves it a wedge with a wall for each contact.  With x = −a and x = b the contacts about the centre of mass,
//     α_a = atan2(κ, a),   α_b = atan2(κ, b),   ψ = α_a + α_b                                              (1)
// are the angles between the vertical and the walls, and of the wedge.  Unfolded, the elastic path is a straight line
// across walls ψ apart, the speed against the wall of strike j being |v| s_j,
//     s_j = sin(α_1 + (j − 1) ψ),   P_j = (1 + e) m |v| s_j sin α_j,                                          (2)
// as long as that is positive; α_1 is that of the contact that strikes first, α_j of the one that strikes at j.  With
// a = b this is P_j = 2 m |v| sin(ψ/2) sin((2j − 1) ψ/2).  With e < 1
//     s_{j+1} = (1 + e) cos ψ s_j − e s_{j−1},   s_1 = sin α_1,   e s_0 = −sin α_2,                             (3)
// whose solution turns by χ at each strike, s_j = e^{j/2} R sin(j χ − φ), cos χ = (1 + e) cos ψ/(2 √e), while that is
// below 1.  Otherwise, (1 + e) cos ψ >= 2 √e, s_j never changes its sign:
//     infinitely many strikes if and only if e <= e_c = (1 − sin ψ)/(1 + sin ψ) and ψ < 90°,                    (4)
// whatever the arms; they end in no time with both contacts at rest, so that ΣP = m |v| as of a plastic landing.
// Derivation: the page "Close to flat" of the reference.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace clatter::analytic::near_flat {

enum class End { a, b };

/// The body: contacts at x = −arm_a and x = arm_b of the centre of mass, one arm at most not positive.
struct TwoContacts {
  double arm_a = 0.5;     ///< a [m]
  double arm_b = 0.5;     ///< b; a + b > 0 [m]
  double gyration = 0.5;  ///< κ = √(I/m) > 0 [m]

  /// @throws std::domain_error naming the field, its value and what is allowed.
  void validate() const;
};

/// ψ of (1), in (0, π) [rad].  Accuracy: 2 ulp.
[[nodiscard]] double wedge_angle(const TwoContacts& body);

/// e_c of (4); 0 where ψ >= 90°.  Accuracy: 1e-16 + 4 ulp.
[[nodiscard]] double critical_restitution(const TwoContacts& body);

/// How many strikes there are, `first` striking first; nothing: infinitely many, (4).  Strikes slower than
/// 1e-15 j |v| count as grazing, and none: the count is exact unless s_j of (2) is as small as that without being zero.
/// @throws std::domain_error as validate(); for a restitution outside [0, 1]; NumericalError for a count beyond 1e15
[[nodiscard]] std::optional<long long> strike_count(const TwoContacts& body, double restitution, End first);

/// One strike.
struct PlanarStrike {
  End end = End::a;
  double approach = 1;  ///< speed of the contact against the ground over |v|: the velocity change of that contact over
                        ///< that of the flat drop, (1 + e)|v|
  double impulse = 0;   ///< P_j/(m |v|)
};

/// The first strikes, `most` of them or all.  Accuracy: 4 ulp of the largest × (1 + j/100) elastic, j² 1e-19 of the
/// largest + 4 ulp damped.  @throws as strike_count
[[nodiscard]] std::vector<PlanarStrike> strikes(const TwoContacts& body, double restitution, End first,
                                                std::size_t most);

}  // namespace clatter::analytic::near_flat

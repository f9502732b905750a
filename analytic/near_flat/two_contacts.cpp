// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/near_flat/two_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "analytic/base/errors.hpp"

namespace clatter::analytic::near_flat {
namespace {

using Long = long double;
constexpr Long half_turn = std::numbers::pi_v<Long>;

/// The angles of (1).
struct Wedge {
  Long first, second, whole;

  Wedge(const TwoContacts& body, End struck)
      : first(std::atan2(static_cast<Long>(body.gyration), static_cast<Long>(body.arm_a))),
        second(std::atan2(static_cast<Long>(body.gyration), static_cast<Long>(body.arm_b))), whole(first + second) {
    if (struck == End::b) std::swap(first, second);
  }
  /// cos ψ, without the rounding of ψ near 90°.
  [[nodiscard]] Long cosine() const { return std::cos(first) * std::cos(second) - std::sin(first) * std::sin(second); }
};

Long critical(Long cosine, Long psi) {
  if (!(cosine > 0)) return 0;
  const Long root = cosine / (1 + std::sin(psi));  // (1 − sin ψ)/cos ψ
  return root * root;
}

/// Where s_j of (3) has turned through half a turn: positive before it.
Long last_strike(const Wedge& wedge, Long e) {
  const Long cosine = (1 + e) * wedge.cosine() / (2 * std::sqrt(e));
  const Long chi = std::acos(cosine), before = -std::sin(wedge.second) / e;  // s_0
  const Long quadrature = (std::sin(wedge.first) / std::sqrt(e) - before * cosine) / std::sin(chi);
  return (half_turn + std::atan2(-before, quadrature)) / chi;
}

}  // namespace

void TwoContacts::validate() const {
  detail::require(std::isfinite(arm_a), "arm_a", arm_a, "finite");
  detail::require(std::isfinite(arm_b) && arm_a + arm_b > 0, "arm_b", arm_b, "finite and greater than -arm_a");
  detail::require(gyration > 0 && std::isfinite(gyration), "gyration", gyration, "greater than 0");
}

double wedge_angle(const TwoContacts& body) {
  body.validate();
  return static_cast<double>(Wedge(body, End::a).whole);
}

double critical_restitution(const TwoContacts& body) {
  body.validate();
  const Wedge wedge(body, End::a);
  return static_cast<double>(critical(wedge.cosine(), wedge.whole));
}

std::optional<long long> strike_count(const TwoContacts& body, double restitution, End first) {
  body.validate();
  detail::require(restitution >= 0 && restitution <= 1, "restitution", restitution, "from 0 to 1");
  const Wedge wedge(body, first);
  const Long c = wedge.cosine();
  if (!(c > 0)) return std::sin(wedge.second) + (1 + restitution) * c * std::sin(wedge.first) > 1e-15L ? 2 : 1;
  if (restitution <= critical(c, wedge.whole)) return std::nullopt;
  const Long last = restitution == 1 ? (half_turn - wedge.first) / wedge.whole + 1 : last_strike(wedge, restitution);
  if (!(last < 1e15L)) throw NumericalError("more than 1e15 strikes");
  return static_cast<long long>(std::ceil(last * (1 - 1e-15L))) - 1;
}

std::vector<PlanarStrike> strikes(const TwoContacts& body, double restitution, End first, std::size_t most) {
  const auto count = strike_count(body, restitution, first);
  if (count) most = std::min(most, static_cast<std::size_t>(*count));
  const Wedge wedge(body, first);
  const Long e = restitution, growth = (1 + e) * wedge.cosine();
  const Long sines[2] = {std::sin(wedge.first), std::sin(wedge.second)};
  Long s = sines[0], lost = -sines[1];  // e s_{j−1}
  std::vector<PlanarStrike> found;
  for (std::size_t i = 0; i < most; ++i) {
    if (restitution == 1) s = std::sin(wedge.first + static_cast<Long>(i) * wedge.whole);
    const Long sine = sines[i % 2];
    found.push_back({(i % 2 == 0) == (first == End::a) ? End::a : End::b, static_cast<double>(s / sine),
                     static_cast<double>((1 + e) * s * sine)});
    const Long next = growth * s - lost;
    lost = e * s;
    s = next;
  }
  return found;
}

}  // namespace clatter::analytic::near_flat

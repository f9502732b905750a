// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/step_jacobians.hpp"

#include <optional>

#include "tests/support.hpp"

namespace {

using namespace clatter::analytic;

constexpr double part = 1e-5;       // of speeds and angle, by which the state is shifted
constexpr double tolerance = 1e-6;  // part², rounding over part, and curvature near slip that stops

/// u, s, Ω after an impact, and its impulse.
struct Response {
  double numbers[5] = {};
  ImpactMode mode = ImpactMode::frictionless;
};

Response response_of(const Impact& impact, const ContactPoint& d) {
  return {{impact.normal_impulse, impact.tangential_impulse, normal_velocity(impact.after, d),
           slip_velocity(impact.after, d), impact.after.angular},
          impact.mode};
}

/// The impact of a shifted state, by the law as it stands.
Response shifted(const StruckState& struck, const StateVector& by) {
  const double s = std::sin(by[at_angle]), c = std::cos(by[at_angle]);
  const auto turned = [&](const ContactPoint& d) {
    return ContactPoint{d.tangential * c - d.normal * s, d.normal * c + d.tangential * s};
  };
  const ContactPoint d = turned(struck.place);
  const double u = struck.contact.normal + by[at_normal], slip = struck.contact.slip + by[at_slip];
  const double turn = struck.before.angular + by[at_turn];
  const PlanarVelocity before{.normal = u + turn * d.tangential, .tangential = slip - turn * d.normal, .angular = turn};
  if (!struck.flat) return response_of(strike(struck.body, before, d, struck.law), d);
  return response_of(strike_flat(struck.body, before, d, turned(struck.second), struck.law).value(), d);
}

class RandomImpacts {
 public:
  std::optional<StruckState> next(bool flat, RestitutionLaw law, FrictionKind friction) {
    const double height = random_(0.05, 0.4);
    const double e = law == RestitutionLaw::viscoelastic ? 1 : random_(0, 1);
    StruckState struck{.body = make_box({.mass = random_(0.5, 2), .length = 1, .width = 1, .thickness = 2 * height}),
                       .law = {.restitution = e, .law = law, .friction = friction},
                       .before = {.normal = -random_(0.5, 2),
                                  .tangential = random_(-2, 2),
                                  .angular = flat ? random_(-0.5, 0.5) : random_(-3, 3)},
                       .contact = {},
                       .place = {},
                       .second = {0.5, -height},
                       .flat = flat};
    if (friction == FrictionKind::impulse_ratio) struck.law.friction_value = random_(-0.3, 0.3);
    if (friction == FrictionKind::coulomb) struck.law.friction_value = random_(0.01, 1.2);
    if (law == RestitutionLaw::viscoelastic) struck.law.damping_per_stiffness = random_.decades(-6, 1.5);
    const double angle = flat ? 0 : random_(-1.5, 1.5);
    struck.place = struck.body.contact_point(0, std::sin(angle), std::cos(angle));
    struck.contact = {normal_velocity(struck.before, struck.place), slip_velocity(struck.before, struck.place)};
    if (!(struck.contact.normal < -0.1)) return {};
    if (flat && !strike_flat(struck.body, struck.before, struck.place, struck.second, struck.law)) return {};
    return struck;
  }

 private:
  clatter::test::Random random_{21};
};

/// Largest error of a derivative beside the size of what it changes, in `worst`; false if slip
/// stops, or no longer stops, within the shift.
bool compare(const StruckState& struck, double& worst) {
  const Response as_it_is = shifted(struck, {});
  const ImpactDerivatives d = impact_derivatives(struck, as_it_is.mode);
  const StateVector* rows[] = {&d.normal, &d.tangential, &d.state[at_normal], &d.state[at_slip], &d.state[at_turn]};
  for (std::size_t i = at_angle; i <= at_turn; ++i) {
    if (struck.flat && i == at_angle) continue;
    StateVector up{}, down{};
    up[i] = part;
    down[i] = -part;
    const Response more = shifted(struck, up), less = shifted(struck, down);
    if (more.mode != as_it_is.mode || less.mode != as_it_is.mode) return false;
    for (std::size_t k = 0; k < 5; ++k) {
      const double slope = (more.numbers[k] - less.numbers[k]) / (2 * part);
      const double size = 1 + std::fabs(slope) + std::fabs(as_it_is.numbers[k]);
      worst = std::fmax(worst, std::fabs((*rows[k])[i] - slope) / size);
    }
  }
  return true;
}

}  // namespace

BOOST_AUTO_TEST_CASE(derivatives_of_an_impact_are_the_changes_that_small_shifts_of_its_state_make) {
  RandomImpacts impacts;
  for (const bool flat : {false, true}) {
    for (int law = 0; law < 4; ++law) {
      for (int friction = 0; friction < 3; ++friction) {
        double worst = 0;
        int compared = 0;
        for (int k = 0; k < 1000; ++k) {
          const auto struck = impacts.next(flat, static_cast<RestitutionLaw>(law), static_cast<FrictionKind>(friction));
          if (struck && compare(*struck, worst)) ++compared;
        }
        BOOST_TEST_CONTEXT("flat " << flat << " law " << law << " friction " << friction) {
          BOOST_TEST(compared >= 150);
          BOOST_TEST(worst <= tolerance);
        }
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(an_impact_that_sticks_from_the_start_feels_a_slip_as_small_as_it_may_be) {
  // P_t stops the slip: dP_t/ds = −1/(C − B²/A) per unit mass where u' = −e u is kept (Newton).
  StruckState struck{.body = make_rod({}),
                     .law = {.restitution = 0.5, .friction = FrictionKind::coulomb, .friction_value = 2},
                     .before = {},
                     .contact = {.normal = -1, .slip = 0},
                     .place = {-0.4, -0.3},
                     .second = {}};
  struck.before = {.normal = -1, .tangential = 0, .angular = 0};
  const ContactInertia inertia = contact_inertia(struck.body.gyration_square, struck.place);
  const ImpactDerivatives d = impact_derivatives(struck, ImpactMode::stick);
  const double expected = -1 / (inertia.tangential - inertia.coupling * inertia.coupling / inertia.normal);
  BOOST_TEST(std::fabs(d.tangential[at_slip] / expected - 1) <= 1e-14);
}

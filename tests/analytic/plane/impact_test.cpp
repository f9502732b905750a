// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/plane/impact.hpp"

#include "analytic/base/errors.hpp"
#include "analytic/plane/rod_impact.hpp"
#include "tests/support.hpp"
#include "validation/oracles/impulse_path.hpp"

namespace {

using namespace clatter::analytic;
using clatter::test::eps, clatter::test::mentions, clatter::test::Random;

/// Ten roundings on each of two independent paths to numbers of order 1.
constexpr double rounding = 20 * eps;

// Read in a vector's order, the fall would be a turn.
template <class Velocity>
concept takes_a_list = requires {
  Velocity{0, 0, -1};
};
static_assert(!takes_a_list<PlanarVelocity>);

bool close(double a, double b, double tolerance) {
  return std::fabs(a - b) <= tolerance * std::fmax(1, std::fmax(std::fabs(a), std::fabs(b)));
}

struct Case {
  PlanarBody body;
  PlanarVelocity before;
  ContactPoint contact;
};

Case random_case(Random& random) {
  Case c{.body = {.mass = random(0.1, 3), .gyration_square = random(0.05, 2)},
         .before = {},
         .contact = {random(-1, 1), random(-1, -0.01)}};
  do c.before = {.normal = random(-2, 0.5), .tangential = random(-2, 2), .angular = random(-3, 3)};
  while (!(normal_velocity(c.before, c.contact) < -0.01));
  return c;
}

ImpactLaw coulomb(RestitutionLaw law, double restitution, double friction, double damping = 0) {
  return {.restitution = restitution,
          .law = law,
          .friction = FrictionKind::coulomb,
          .friction_value = friction,
          .damping_per_stiffness = damping};
}

Impact rod_impact_at(const Angle& theta, const ImpactLaw& law, const PlanarVelocity& before = {.normal = -1}) {
  const PlanarBody rod = make_rod({});
  return strike(rod, before, rod.contact_point(0, theta.sine, theta.cosine), law);
}

double energy(const PlanarBody& body, const PlanarVelocity& v) {
  return body.mass *
         (v.normal * v.normal + v.tangential * v.tangential + body.gyration_square * v.angular * v.angular) / 2;
}

/// Coulomb's law by following the impulse in small steps: velocities at the contact, compression and
/// work as they accumulate.  Knows nothing of phases.
struct SteppedPath {
  double normal = 0, tangential = 0;

  SteppedPath(const Case& c, const ImpactLaw& law, double step) {
    const double m = c.body.mass, k2 = c.body.gyration_square;
    const double dt = c.contact.tangential, dn = c.contact.normal;
    double u = normal_velocity(c.before, c.contact), s = slip_velocity(c.before, c.contact);
    const double u0 = u;
    double compression = -1, work = 0, work_compression = 0, stored = 0;
    for (;;) {
      // Friction opposes slip; within one step of zero slip it is what keeps the slip at zero, if it can.
      const double hold = dt * dn / k2 / (1 + dn * dn / k2);
      const double reach = step / m * (1 + dn * dn / k2) * (law.friction_value + std::fabs(hold));
      double ratio = -std::copysign(law.friction_value, s);
      if (std::fabs(s) <= reach)
        ratio = std::fabs(hold) <= law.friction_value ? hold : std::copysign(law.friction_value, hold);
      const double du = ((1 + dt * dt / k2) - dt * dn / k2 * ratio) * step / m;
      const double ds = ((1 + dn * dn / k2) * ratio - dt * dn / k2) * step / m;
      work += (u + du / 2) * step;
      stored -= (u + du / 2) / (1 - law.damping_per_stiffness * (u + du / 2)) * step;
      u += du;
      s += ds;
      normal += step;
      tangential += ratio * step;
      if (compression < 0 && u >= 0) {
        compression = normal;
        work_compression = work;
      }
      if (compression < 0) continue;
      const double e = law.restitution;
      if (law.law == RestitutionLaw::newton && u >= -e * u0) return;
      if (law.law == RestitutionLaw::poisson && normal >= (1 + e) * compression) return;
      // The ground holds what the force (1 - tau u) K stored, less what it has given back.
      if (law.law == RestitutionLaw::viscoelastic && stored <= 0) return;
      if (law.law == RestitutionLaw::stronge && work - work_compression >= -e * e * work_compression) return;
    }
  }
};

}  // namespace

BOOST_AUTO_TEST_CASE(equation_8_is_satisfied_for_any_body) {
  Random random(8);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random);
    const double e = random(0, 1), ratio = random(-0.3, 0.3);
    const ImpactLaw law{.restitution = e, .friction = FrictionKind::impulse_ratio, .friction_value = ratio};
    const ContactInertia inertia = contact_inertia(c.body.gyration_square, c.contact);
    if (!(inertia.normal - ratio * inertia.coupling > 0.1)) continue;
    const Impact impact = strike(c.body, c.before, c.contact, law);
    const double m = c.body.mass, p = impact.normal_impulse;
    const double moment = ratio * p * c.contact.normal - p * c.contact.tangential;
    const double scale = 1e-12;  // impulses up to 100 and cancellation between terms of that size
    BOOST_REQUIRE(close(m * (impact.after.normal - c.before.normal), p, scale));
    BOOST_REQUIRE(close(m * (impact.after.tangential - c.before.tangential), ratio * p, scale));
    BOOST_REQUIRE(close(m * c.body.gyration_square * (impact.after.angular - c.before.angular), moment, scale));
    BOOST_REQUIRE(close(normal_velocity(impact.after, c.contact), -e * normal_velocity(c.before, c.contact), scale));
    BOOST_REQUIRE(close(impact.energy_loss, energy(c.body, c.before) - energy(c.body, impact.after), 1e-10));
  }
}

BOOST_AUTO_TEST_CASE(the_general_solution_gives_equation_9_for_the_unit_rod) {
  for (double degrees = 0.5; degrees < 90; degrees += 0.5) {
    for (const double ratio : {-0.5, 0.0, 0.3, 0.9}) {
      for (const double e : {0.0, 0.4, 1.0}) {
        const Angle theta = Angle::from_degrees(degrees);
        const RodImpact closed = rod_impact(theta, {.normal = -1.5, .tangential = 0.25}, e, ratio);
        const Impact general =
            rod_impact_at(theta, {.restitution = e, .friction = FrictionKind::impulse_ratio, .friction_value = ratio},
                          {.normal = -1.5, .tangential = 0.25});
        BOOST_REQUIRE(close(general.normal_impulse, closed.normal_impulse, rounding));
        BOOST_REQUIRE(close(general.after.normal, closed.after.normal, rounding));
        BOOST_REQUIRE(close(general.after.tangential, closed.after.tangential, rounding));
        BOOST_REQUIRE(close(general.after.angular, closed.after.angular, rounding));
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(the_flat_landing_gives_equation_11) {
  const PlanarBody rod = make_rod({});
  const ImpactLaw law{.restitution = 0.7, .friction = FrictionKind::impulse_ratio, .friction_value = 0.2};
  const auto flat =
      strike_flat(rod, {.normal = -2, .tangential = 1}, rod.contact_point(0, 0, 1), rod.contact_point(1, 0, 1), law);
  const RodImpact closed = flat_rod_impact({.normal = -2, .tangential = 1}, 0.7, 0.2);
  BOOST_REQUIRE(flat.has_value());
  BOOST_TEST(close(flat->normal_impulse, closed.normal_impulse, rounding));
  BOOST_TEST(close(flat->after.normal, closed.after.normal, rounding));
  BOOST_TEST(close(flat->after.tangential, closed.after.tangential, rounding));
  BOOST_TEST(flat->after.angular == 0);
}

BOOST_AUTO_TEST_CASE(a_flat_landing_with_spin_reverses_every_vertex_or_is_left_to_one) {
  const PlanarBody rod = make_rod({});
  const ContactPoint a = rod.contact_point(0, 0, 1), b = rod.contact_point(1, 0, 1);
  const PlanarVelocity slow{.normal = -1, .angular = 0.5};
  const auto flat = strike_flat(rod, slow, a, b, {.restitution = 0.6});
  BOOST_REQUIRE(flat.has_value());
  BOOST_TEST(close(normal_velocity(flat->after, a), -0.6 * normal_velocity(slow, a), rounding));
  BOOST_TEST(close(normal_velocity(flat->after, b), -0.6 * normal_velocity(slow, b), rounding));
  BOOST_TEST(close(flat->energy_loss, energy(rod, slow) - energy(rod, flat->after), rounding));
  BOOST_TEST(!strike_flat(rod, {.normal = -1, .angular = 5}, a, b, {}).has_value());  // one end recedes
}

BOOST_AUTO_TEST_CASE(a_flat_landing_on_damped_ground_bounces_as_a_mass_at_its_pressure_centre_does) {
  constexpr double tolerance = 1e-9;  // integrated_restitution()
  const double half = 0.5, height = 0.1, square = (1 + 4 * height * height) / 12, descent = 1.2;
  const PlanarBody box = make_box({.length = 2 * half, .thickness = 2 * height});
  for (const double damping : {0.05, 0.4, 1.5}) {
    for (const double spin : {0.0, 0.6, -1.0}) {
      for (const double friction : {0.0, 0.3}) {
        const ImpactLaw law = coulomb(RestitutionLaw::viscoelastic, 1, friction, damping);
        const PlanarVelocity before{.normal = -descent, .tangential = 0.4, .angular = spin};
        const auto flat = strike_flat(box, before, {-half, -height}, {half, -height}, law);
        BOOST_REQUIRE(flat.has_value());
        // Pushes at the ends that reverse both motions: p_a + p_b = (1+e) V and (p_b − p_a) L/2 = (1+e) k² ω.
        const double centre = half * (square * spin / half) / descent;
        const double e = clatter::oracle::integrated_restitution(damping, -normal_velocity(before, {centre, -height}));
        BOOST_TEST(std::fabs(flat->after.normal - e * descent) <= tolerance);
        BOOST_TEST(std::fabs(flat->after.angular + e * spin) <= tolerance);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_flat_landing_gains_no_energy_but_by_newtons_law_and_is_newtons_where_that_gains_none) {
  constexpr double tolerance = 1e-13;
  Random random(8);
  int limited = 0, whole = 0;
  for (int i = 0; i < 20000; ++i) {
    const double half = random(0.1, 1), height = random(0.05, 1);
    const PlanarBody box = make_box({.length = 2 * half, .thickness = 2 * height});
    const PlanarVelocity before{.normal = -1, .tangential = random(-1, 1), .angular = random(-1, 1) / half};
    ImpactLaw law{.restitution = random(0.5, 1), .friction = FrictionKind::coulomb, .friction_value = random(0, 3)};
    const auto landed = [&](RestitutionLaw by) {
      law.law = by;
      return strike_flat(box, before, {-half, -height}, {half, -height}, law);
    };
    const auto newton = landed(RestitutionLaw::newton);
    for (const RestitutionLaw by : {RestitutionLaw::poisson, RestitutionLaw::stronge}) {
      const auto flat = landed(by);
      BOOST_REQUIRE_EQUAL(flat.has_value(), newton.has_value());
      if (!flat) continue;
      const double gain = energy(box, flat->after) - energy(box, before);
      BOOST_CHECK_LE(gain, tolerance * energy(box, before));
      if (flat->is_limited) {
        BOOST_CHECK_GE(gain, -tolerance * energy(box, before));
        BOOST_CHECK_GE(energy(box, newton->after) - energy(box, before), 0);
        BOOST_CHECK_LE(flat->restitution(), law.restitution);
      } else {
        BOOST_CHECK_LE(std::fabs(flat->after.angular - newton->after.angular), 100 * tolerance);
        BOOST_CHECK_LE(std::fabs(flat->after.tangential - newton->after.tangential), 100 * tolerance);
      }
      ++(flat->is_limited ? limited : whole);
    }
  }
  BOOST_TEST(limited > 100);
  BOOST_TEST(whole > 100);
}

BOOST_AUTO_TEST_CASE(rouths_closed_form_agrees_with_stepping_along_the_impulse) {
  Random random(3);
  constexpr double step = 2e-5;
  constexpr double tolerance = 1e-3;  // first order in the step, growing with the steepest slope
  int modes[5] = {};
  for (int i = 0; i < 300; ++i) {
    const Case c = random_case(random);
    const auto kind = static_cast<RestitutionLaw>(i % 4);
    const double e = random(0.05, 1), friction = random(0.02, 1.2);
    const ImpactLaw law =
        kind == RestitutionLaw::viscoelastic ? coulomb(kind, 1, friction, random(0, 1)) : coulomb(kind, e, friction);
    const Impact impact = strike(c.body, c.before, c.contact, law);
    const SteppedPath path(c, law, step);
    BOOST_REQUIRE(close(impact.normal_impulse, path.normal, tolerance));
    BOOST_REQUIRE(close(impact.tangential_impulse, path.tangential, tolerance));
    BOOST_REQUIRE(std::fabs(impact.tangential_impulse) <= law.friction_value * impact.normal_impulse * (1 + rounding));
    ++modes[static_cast<int>(impact.mode)];
  }
  BOOST_TEST(modes[static_cast<int>(ImpactMode::slip)] > 20);
  BOOST_TEST(modes[static_cast<int>(ImpactMode::slip_stick)] > 20);
  BOOST_TEST(modes[static_cast<int>(ImpactMode::reverse_slip)] > 5);
}

BOOST_AUTO_TEST_CASE(the_restitution_laws_agree_as_long_as_slip_does_not_stop) {
  Random random(4);
  int compared = 0;
  for (int i = 0; i < 5000; ++i) {
    const Case c = random_case(random);
    const auto by = [&](RestitutionLaw law) { return strike(c.body, c.before, c.contact, coulomb(law, 0.6, 0.15)); };
    const Impact newton = by(RestitutionLaw::newton);
    bool slips = newton.mode == ImpactMode::slip;
    for (const Impact& other : {by(RestitutionLaw::poisson), by(RestitutionLaw::stronge)}) {
      slips = slips && other.mode == ImpactMode::slip;
      if (slips) BOOST_REQUIRE(close(newton.normal_impulse, other.normal_impulse, rounding));
    }
    compared += slips ? 1 : 0;
  }
  BOOST_TEST(compared > 1000);
}

BOOST_AUTO_TEST_CASE(coulomb_friction_never_creates_energy_with_stronges_law) {
  Random random(5);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random);
    const ImpactLaw law = coulomb(RestitutionLaw::stronge, random(0, 1), random(0, 5));
    const Impact impact = strike(c.body, c.before, c.contact, law);
    BOOST_REQUIRE(impact.energy_loss >= -1e-12 * energy(c.body, c.before));
    BOOST_REQUIRE(close(impact.energy_loss, energy(c.body, c.before) - energy(c.body, impact.after), 1e-11));
  }
}

BOOST_AUTO_TEST_CASE(a_viscoelastic_ground_without_damping_is_stronges_law_with_e_1) {
  Random random(6);
  for (int i = 0; i < 2000; ++i) {
    const Case c = random_case(random);
    const double friction = random(0, 2);
    const auto impulse = [&](RestitutionLaw law, double damping = 0) {
      return strike(c.body, c.before, c.contact, coulomb(law, 1, friction, damping)).normal_impulse;
    };
    const double stronge = impulse(RestitutionLaw::stronge);
    // The impulse of a path that nearly jams is large; 1e-13 is 500 roundings of it.
    BOOST_REQUIRE(close(impulse(RestitutionLaw::viscoelastic), stronge, 1e-13));
    BOOST_REQUIRE(close(impulse(RestitutionLaw::viscoelastic, 1e-9), stronge, 1e-7));  // restitution by (2/3) 1e-9 v
  }
}

BOOST_AUTO_TEST_CASE(a_ground_damped_without_bound_lets_a_sticking_contact_separate_slowly) {
  // The ground gives back at u < 1/tau only, whatever it has stored; s = tau v = 1e4 once gave infinity.
  const Case c{.body = {.gyration_square = 0.1}, .before = {.normal = -1, .tangential = 0.05}, .contact = {-0.3, -0.4}};
  for (const double tau : {1e2, 1e4, 1e6}) {
    const Impact impact = strike(c.body, c.before, c.contact, coulomb(RestitutionLaw::viscoelastic, 1, 0.9, tau));
    BOOST_TEST((impact.mode == ImpactMode::slip_stick));
    BOOST_TEST(impact.separation_speed > 0.9 / tau);
    BOOST_TEST(impact.separation_speed <= (1 + 1e-9) / tau);
  }
}

BOOST_AUTO_TEST_CASE(sticking_at_45_degrees_begins_at_0_6) {
  const auto mode = [](double mu) {
    return rod_impact_at(Angle::from_degrees(45), coulomb(RestitutionLaw::newton, 1, mu)).mode;
  };
  BOOST_CHECK(mode(0.6 - 1e-14) == ImpactMode::slip);
  BOOST_CHECK(mode(0.6 + 1e-14) == ImpactMode::stick);
}

BOOST_AUTO_TEST_CASE(an_impulse_ratio_at_or_beyond_the_jamming_limit_is_refused_by_name) {
  const auto hit = [](double ratio) {
    return rod_impact_at(Angle::from_radians(std::atan(2.0)),
                         {.friction = FrictionKind::impulse_ratio, .friction_value = ratio});
  };
  BOOST_CHECK_NO_THROW(static_cast<void>(hit(4.0 / 3 - 1e-9)));
  CHECK_REFUSED_SAYING(hit(4.0 / 3 + 1e-9), OutsideModelError, "jamming");
}

BOOST_AUTO_TEST_CASE(a_law_out_of_range_is_refused_naming_the_field) {
  for (const ImpactLaw& law :
       {ImpactLaw{.restitution = 1.0000000000000002}, {.restitution = -1e-300}, {.restitution = NAN}})
    BOOST_CHECK_EXCEPTION(law.validate(), std::domain_error, mentions("restitution"));
  for (const double bad : {-0.1, double(INFINITY)})
    BOOST_CHECK_EXCEPTION(coulomb(RestitutionLaw::newton, 1, bad).validate(), std::domain_error, mentions("friction"));
}

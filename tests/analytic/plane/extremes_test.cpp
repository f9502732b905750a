// SPDX-License-Identifier: GPL-3.0-or-later
#include <boost/test/unit_test.hpp>
#include <cmath>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/law/impact_limits.hpp"
#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/sequence.hpp"

namespace {

using namespace clatter::analytic;

struct Counts {
  int results = 0;
  int refusals = 0;
};

void require_reason(const Drop& drop, const std::string& what) {
  const bool jams = drop.law.friction == FrictionKind::impulse_ratio;  // or nearly, and is thrown up without end
  BOOST_REQUIRE_MESSAGE(
      (what.starts_with("the impulse overflows") && drop.law.friction_value > 1e100) ||
          (what.starts_with("the flight is so long") && drop.gravity > 0 && jams),
      "numerical error at inclination " << drop.inclination.degrees << ", gravity " << drop.gravity << ": " << what);
}

/// A result without NaN, or a typed refusal; anything else fails.
void run(const Drop& drop, Counts& counts) {
  try {
    const Sequence s = impact_sequence(drop, {.impacts = 12});
    BOOST_REQUIRE(!s.rows.empty());
    for (const ImpactRow& row : s.rows) {
      for (const double x : {row.start, row.contact_angle, row.impact.normal_impulse, row.impact.after.normal,
                             row.impact.after.tangential, row.impact.after.angular, row.centre_height}) {
        BOOST_REQUIRE_MESSAGE(std::isfinite(x), "inclination " << drop.inclination.degrees << " gravity "
                                                               << drop.gravity << " e " << drop.law.restitution
                                                               << " friction " << drop.law.friction_value << " row "
                                                               << (&row - s.rows.data()) << " value " << x);
      }
      BOOST_REQUIRE(row.impact.normal_impulse >= 0);
    }
    if (s.tail) BOOST_REQUIRE(std::isfinite(s.tail->end_time) && std::isfinite(s.tail->normal_impulse));
    const bool ends_early = s.outcome == Outcome::not_computed;
    if (ends_early) require_reason(drop, s.message);
    ++(ends_early || s.outcome == Outcome::outside_model ? counts.refusals : counts.results);
  } catch (const OutsideModelError&) {
    ++counts.refusals;
  } catch (const NumericalError& error) {
    ++counts.refusals;
    require_reason(drop, error.what());
  }
}

std::vector<Angle> extreme_angles() {
  std::vector<Angle> angles;
  for (const double degrees : {0.0, 1e-300, 1e-15, 1e-8, 10.0, 45.0, 89.999999, 90.0})
    angles.push_back(Angle::from_degrees(degrees));
  angles.push_back(Angle::from_degrees(std::nextafter(90.0, 0.0)));
  for (const ImpactNumber number : {ImpactNumber::second, ImpactNumber::third}) {
    const double fold = regime_boundary(number, {}).theta;
    for (const double t : {std::nextafter(fold, 0.0), fold, std::nextafter(fold, 2.0)})
      angles.push_back(Angle::from_radians(t));
  }
  return angles;
}

std::vector<ImpactLaw> extreme_laws(const Angle& angle) {
  std::vector<ImpactLaw> laws;
  const PlanarBody rod = make_rod({});
  const ContactInertia inertia = contact_inertia(rod.gyration_square, rod.contact_point(0, angle.sine, angle.cosine));
  const double sticking = sticking_ratio(inertia), jamming = jamming_ratio(inertia);
  for (const double e : {0.0, 1e-12, 0.5, 1.0}) {
    laws.push_back({.restitution = e});
    for (const RestitutionLaw law : {RestitutionLaw::newton, RestitutionLaw::poisson, RestitutionLaw::stronge}) {
      for (const double mu :
           {std::nextafter(sticking, 0.0), sticking, std::nextafter(sticking, 9.0), 1e-300, 0.5, 10.0, 1e300}) {
        laws.push_back({.restitution = e, .law = law, .friction = FrictionKind::coulomb, .friction_value = mu});
      }
    }
    if (!std::isfinite(jamming)) continue;
    for (const double ratio : {std::nextafter(jamming, 0.0), jamming, std::nextafter(jamming, INFINITY), jamming * 2}) {
      laws.push_back({.restitution = e, .friction = FrictionKind::impulse_ratio, .friction_value = ratio});
    }
  }
  return laws;
}

}  // namespace

BOOST_AUTO_TEST_CASE(every_corner_of_angle_law_and_gravity_ends_in_a_number_or_a_typed_refusal) {
  Counts counts;
  for (const Angle& angle : extreme_angles()) {
    for (const ImpactLaw& law : extreme_laws(angle)) {
      for (const double gravity : {0.0, 1e-12, 1.0, 1e12}) {
        run({.body = make_rod({}), .inclination = angle, .velocity = {.normal = -1}, .gravity = gravity, .law = law},
            counts);
      }
    }
  }
  BOOST_TEST_MESSAGE(counts.results << " results, " << counts.refusals << " refusals");
  BOOST_TEST(counts.results > 1000);
  BOOST_TEST(counts.refusals > 10);
}

BOOST_AUTO_TEST_CASE(masses_and_lengths_from_1e_minus_150_to_1e150_change_nothing_but_the_scale) {
  const Drop unit{.body = make_rod({}),
                  .inclination = Angle::from_degrees(10),
                  .velocity = {.normal = -1},
                  .gravity = 0,
                  .law = {}};
  const Sequence expected = impact_sequence(unit, {});
  for (const double mass : {1e-150, 1e-30, 1e150}) {
    for (const double length : {1e-150, 1e30, 1e150}) {
      Drop drop = unit;
      drop.body = make_rod({.mass = mass, .length = length});
      const Sequence s = impact_sequence(drop, {});
      BOOST_REQUIRE(s.rows.size() == expected.rows.size());
      for (std::size_t i = 0; i < s.rows.size(); ++i) {
        const double impulse = expected.rows[i].impact.normal_impulse;
        BOOST_TEST(std::fabs(s.rows[i].impact.normal_impulse / mass - impulse) <= 1e-14 * impulse);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_fast_spin_makes_a_million_turns_with_few_evaluations_of_its_height) {
  Drop drop{.body = make_rod({}),
            .inclination = Angle::from_degrees(30),
            .velocity = {.normal = -10, .tangential = 0, .angular = -1e7},
            .gravity = 9.81,
            .law = {}};
  const Sequence s = impact_sequence(drop, {.impacts = 3});
  BOOST_TEST(s.rows.size() == 3u);
  BOOST_TEST(s.root_evaluations < 1000);
}

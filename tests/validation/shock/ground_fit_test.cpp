// SPDX-License-Identifier: GPL-3.0-or-later
// k_G and c_G from measured numbers: closed forms of the flat landing, and numbers of the simulator there and back.
#include "validation/shock/ground_fit.hpp"

#include "tests/support.hpp"
#include "validation/scene/scene.hpp"

using namespace clatter;
using namespace clatter::validation;

namespace {

constexpr double round_trip = 1e-8;  // what is claimed
constexpr double mass = 0.2, area = 0.1 * 0.06, speed = 2, gravity = 9.81;

/// A box that lands as told, and what is measured of it.
struct Landing {
  numeric::Body body;
  MeasuredDrop drop;

  explicit Landing(const std::vector<SceneOverride>& overrides, const char* measure = "projected")
      : Landing(scene_of(overrides, measure)) {}
  explicit Landing(const Scene& scene) : body(scene.make_body()) {
    drop = {&body, scene.world, scene.start(body), mass * gravity};
  }
  static Scene scene_of(const std::vector<SceneOverride>& overrides, const char* measure) {
    std::vector<SceneOverride> all{{"body.shape", "--body", "box"},
                                   {"body.size", "--size", "0.1x0.06x0.02"},
                                   {"body.mass", "--mass", "0.2"},
                                   {"drop.speed", "--speed", "2"},
                                   {"ground.stiffness", "--stiffness", "1e9"},
                                   {"ground.area", "--area", measure}};
    all.insert(all.end(), overrides.begin(), overrides.end());
    return read_scene("", all, Model::continuous);
  }
};

const std::vector<SceneOverride> flat{{"drop.angle_deg", "--angle", "0"}};
const std::vector<SceneOverride> corner{{"drop.orientation", "--orientation", "20"}};

MeasuredNumber of(DropMeasure measure, const Measures& measures) {
  return {measure, measures[static_cast<std::size_t>(measure)]};
}

}  // namespace

BOOST_AUTO_TEST_CASE(an_elastic_flat_landing_gives_the_stiffness_of_its_closed_form) {
  const Landing landing(flat);
  const double time = 4e-4, stiffness = std::pow(std::numbers::pi / time, 2) * mass / area;
  const GroundFit by_time = fit_ground(landing.drop, {DropMeasure::restitution, 1}, {DropMeasure::contact_time, time});
  BOOST_TEST_REQUIRE(by_time.solutions.size() == 1U);
  BOOST_TEST(std::fabs(by_time.solutions[0].stiffness / stiffness - 1) < 1e-9);
  BOOST_TEST(by_time.solutions[0].damping == 0);
  const double force = speed * std::sqrt(stiffness * area * mass);
  const GroundFit by_force = fit_ground(landing.drop, {DropMeasure::peak_force, force}, {DropMeasure::restitution, 1});
  BOOST_TEST_REQUIRE(by_force.solutions.size() == 1U);
  BOOST_TEST(std::fabs(by_force.solutions[0].stiffness / stiffness - 1) < 1e-9);
  // T ∝ k^(−1/2), F ∝ k^(1/2)
  BOOST_TEST(std::fabs(by_time.solutions[0].stiffness_by[1] + 2) < 1e-5);
  BOOST_TEST(std::fabs(by_force.solutions[0].stiffness_by[0] - 2) < 1e-5);
}

BOOST_AUTO_TEST_CASE(a_damped_flat_landing_gives_the_damping_of_its_closed_form) {
  // ln[(1+s)/(1−s e)] = s (1+e), s = c_G v/k_G: e = 0.937475579949905 at s = 0.1, 0.593624260040 at s = 1.
  const Landing landing(flat);
  for (const auto& [e, s] : {std::pair{0.937475579949905, 0.1}, {0.593624260040, 1.0}}) {
    const double indentation = 1e-6, stiffness = mass * gravity / (area * indentation);
    const GroundFit fit =
        fit_ground(landing.drop, {DropMeasure::restitution, e}, {DropMeasure::indentation, indentation});
    BOOST_TEST_REQUIRE(fit.solutions.size() == 1U);
    BOOST_TEST(std::fabs(fit.solutions[0].stiffness / stiffness - 1) < 1e-12);
    BOOST_TEST(std::fabs(fit.solutions[0].damping * speed / stiffness / s - 1) < round_trip);
  }
}

BOOST_AUTO_TEST_CASE(two_numbers_of_a_drop_give_back_its_ground) {
  const std::vector<std::pair<DropMeasure, DropMeasure>> pairs{
      {DropMeasure::restitution, DropMeasure::contact_time}, {DropMeasure::restitution, DropMeasure::peak_force},
      {DropMeasure::restitution, DropMeasure::indentation},  {DropMeasure::contact_time, DropMeasure::peak_force},
      {DropMeasure::contact_time, DropMeasure::indentation}, {DropMeasure::peak_force, DropMeasure::indentation}};
  test::Random random(5);
  int number = 0;
  for (const auto* drop : {&flat, &corner}) {
    const Landing surface(*drop, "surface"), projected(*drop, "projected");
    for (const auto& [first, second] : pairs) {
      const Landing& landing = number++ % 2 == 0 ? surface : projected;
      // So stiff that a corner is in the ground alone.
      const double stiffness = drop == &flat ? random.decades(8, 10) : random.decades(11, 13);
      const double damping = random.decades(-1.5, 0.5) * stiffness / speed;
      const Measures measures = measures_of(landing.drop, stiffness, damping);
      const GroundFit fit = fit_ground(landing.drop, of(first, measures), of(second, measures));
      double off = 1;
      for (const FittedGround& ground : fit.solutions) {
        const double by_damping = std::fabs(ground.damping / damping - 1);
        off = std::min(off, std::max(std::fabs(ground.stiffness / stiffness - 1), by_damping));
        const Measures again = measures_of(landing.drop, ground.stiffness, ground.damping);
        for (const DropMeasure one : {first, second}) {  // each is a ground that gives both
          BOOST_TEST(std::fabs(of(one, again).value / of(one, measures).value - 1) < round_trip);
        }
      }
      BOOST_TEST(off < round_trip, measure_name(first) << " and " << measure_name(second) << ": off by " << off
                                                       << " of " << fit.solutions.size());
    }
  }
}

BOOST_AUTO_TEST_CASE(numbers_that_no_ground_gives_are_told) {
  const Landing landing(flat);
  const Measures elastic = measures_of(landing.drop, 1e9, 0);
  // F T/(m v) is π without damping and has a least value: nothing lies far below it.
  const GroundFit none = fit_ground(landing.drop, of(DropMeasure::contact_time, elastic),
                                    {DropMeasure::peak_force, 0.1 * of(DropMeasure::peak_force, elastic).value});
  BOOST_TEST(none.solutions.empty());
  BOOST_TEST(none.least > 0);
  for (const auto& [restitution, time] : {std::pair{1.1, 1e-3}, {test::not_a_number, 1e-3}, {0.5, 0.0}})
    CHECK_REFUSED(fit_ground(landing.drop, {DropMeasure::restitution, restitution}, {DropMeasure::contact_time, time}),
                  std::domain_error);
}

BOOST_AUTO_TEST_CASE(layers_and_half_spaces_have_their_textbook_stiffness) {
  BOOST_TEST(std::fabs(layer_stiffness(3e6, 0, 0.01) - 3e8) < 1e-6);
  // The plane-strain modulus λ + 2μ, from Lamé's constants.
  const double modulus = 5e6, poisson = 0.45, shear = modulus / (2 * (1 + poisson)),
               lame = 2 * shear * poisson / (1 - 2 * poisson);
  BOOST_TEST(std::fabs(layer_stiffness(modulus, poisson, 0.02) * 0.02 / (lame + 2 * shear) - 1) < 1e-13);
  // Boussinesq's rigid circular punch: F = 2 a E δ/(1 − ν²).
  const double a = 0.03, footprint = std::numbers::pi * a * a;
  BOOST_TEST(std::fabs(half_space_stiffness(30e9, 0.2, footprint) * footprint / (2 * a * 30e9 / 0.96) - 1) < 1e-13);
  CHECK_REFUSED(layer_stiffness(1e6, 0.5, 0.01), std::domain_error);
  CHECK_REFUSED(half_space_stiffness(-1, 0.2, 1), std::domain_error);
}

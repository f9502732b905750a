// SPDX-License-Identifier: GPL-3.0-or-later
// What impacts do to points of the body: kinematics, closed forms of landings, both models, error bars.
#include "validation/shock/shock_run.hpp"

#include "tests/support.hpp"

using namespace clatter::validation;
using clatter::numeric::Vector3;

namespace {

using std::numbers::pi;
constexpr double closes = 1e-9;  // what is claimed of ∫a dt against ΔV

const std::vector<Probe> box_probes{{"centre", Vector3::Zero()}, {"corner", Vector3(0.05, 0.03, 0.01)}};

/// A box of 0.2 kg, 0.1 × 0.06 × 0.02 m, on an elastic ground.
Scene box(const std::vector<SceneOverride>& overrides) {
  std::vector<SceneOverride> all{
      {"body.shape", "--body", "box"},  {"body.size", "--size", "0.1x0.06x0.02"},   {"body.mass", "--mass", "0.2"},
      {"drop.speed", "--speed", "2"},   {"ground.stiffness", "--stiffness", "1e9"}, {"run.digits", "--digits", "9"},
      {"run.impacts", "--impacts", "1"}};
  all.insert(all.end(), overrides.begin(), overrides.end());
  return read_scene("", all, Model::continuous);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_acceleration_from_the_forces_integrates_to_the_change_of_velocity) {
  const std::vector<Probe> probes{
      {"centre", Vector3::Zero()}, {"corner", Vector3(0.05, 0.02, 0.009)}, {"off", Vector3(-0.2, 0.1, 0.3)}};
  for (const char* name : {"phone-damped", "phone-corner", "phone-elastic"}) {
    const ShockRun run =
        run_shock(case_scene(name, {{"run.digits", "--digits", "9"}, {"run.impacts", "--impacts", "2"}}), probes,
                  {.sensitivity = false, .count = 2});
    BOOST_TEST_REQUIRE(run.continuous->rows.size() == 2 * probes.size());
    for (const ShockRow& row : run.continuous->rows) {
      BOOST_TEST_CONTEXT(name << ", impact " << row.impact << ", probe " << row.probe) {
        BOOST_TEST(row.closure < closes);
        BOOST_TEST(row.value.peak_size > 0);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(rows_are_the_same_where_no_more_of_a_recording_is_held_than_a_contact) {
  const Scene scene = case_scene("phone-damped", {{"run.impacts", "--impacts", "3"}, {"run.digits", "--digits", "4"}});
  const clatter::numeric::Body body = scene.make_body();
  const std::vector<Vector3> places{Vector3(0.05, 0.02, 0.009)};
  const ContinuousShock kept = continuous_shock(scene, body, places),
                        streamed = continuous_shock(scene, body, places, {.keeps_motion = false});
  BOOST_TEST((!kept.motion.pieces().empty() && !kept.other.pieces().empty()));
  BOOST_TEST((streamed.motion.pieces().empty() && streamed.other.pieces().empty()));
  BOOST_TEST_REQUIRE(streamed.rows.size() == kept.rows.size());
  for (std::size_t i = 0; i < kept.rows.size(); ++i) {
    BOOST_TEST(streamed.rows[i].value.peak_size == kept.rows[i].value.peak_size);
    BOOST_TEST(streamed.rows[i].error.peak_size == kept.rows[i].error.peak_size);
    BOOST_TEST(streamed.rows[i].impact == kept.rows[i].impact);
  }
}

BOOST_AUTO_TEST_CASE(at_the_centre_of_mass_the_peak_is_force_over_mass) {
  const Scene scene = case_scene("phone-elastic", {{"run.impacts", "--impacts", "2"}, {"run.digits", "--digits", "9"}});
  const ShockRun run = run_shock(scene, {{"centre", Vector3::Zero()}}, {.sensitivity = false, .count = 2});
  const auto& impacts = run.continuous->planned.run.impacts;
  for (const ShockRow& row : run.continuous->rows) {
    const auto& force = impacts[static_cast<std::size_t>(row.impact - 1)].value;
    BOOST_TEST(std::fabs(row.value.peak_size * scene.body.mass / force.peak_force - 1) < 1e-7);
    const Vector3 weight(0, 0, scene.world.gravity * row.duration);  // acts in the contact, too
    BOOST_TEST(((row.value.delta_v + weight) * scene.body.mass - force.impulse).norm() < 1e-9 * force.impulse.norm());
  }
}

BOOST_AUTO_TEST_CASE(an_elastic_flat_landing_is_a_half_sine_of_known_height_width_and_spectrum) {
  Scene scene = box({{"drop.angle_deg", "--angle", "0"}, {"ground.area", "--area", "projected"}});
  const double omega = std::sqrt(1e9 * 0.1 * 0.06 / 0.2), time = pi / omega, peak = 2 * omega;
  ShockRequest request{.low = 0.809936786 / time, .high = 2 / time, .count = 2, .quality = clatter::test::infinite};
  const FragilePart part{.frequency = 0.3 / time, .fragility = peak},
      tested{.fragility = peak, .duration = time, .kind = FragilePart::Kind::tested};
  request.parts = {part, tested};
  const ShockRun run = run_shock(scene, box_probes, request);
  for (const ShockRow& row : run.continuous->rows) {
    BOOST_TEST(std::fabs(row.value.delta_v_size - 4) < 1e-8);
    BOOST_TEST(std::fabs(row.value.peak_size / peak - 1) < 1e-8);
    BOOST_TEST(std::fabs(row.value.width / (time * (1 - 2 * std::asin(0.1) / pi)) - 1) < 1e-7);
    BOOST_TEST(std::fabs(row.value.peak_time / (time / 2) - 1) < 1e-3);
    BOOST_TEST(std::fabs(row.sensitivity->value - 0.5) < 1e-5);
    // The blow is the pulse of which a part's response is known in closed form; the one that a tested part bore.
    for (const FragilePart& one : request.parts) {
      const double expected = peak * pulse_response(PulseShape::half_sine, one.oscillator()->frequency * time);
      BOOST_TEST(std::fabs(row.response_of(one)->value / expected - 1) < 1e-7);
      BOOST_TEST(row.response_of(one)->error >= std::fabs(row.response_of(one)->value - expected));
    }
    BOOST_TEST(std::fabs(margin_of(row, tested, true).value - 1) < 1e-7);
  }
  const Spectrum* spectrum = run.spectrum(0, true, Blows::impact_1);
  BOOST_TEST_REQUIRE(spectrum != nullptr);
  BOOST_TEST(spectrum->axis == 2);
  BOOST_TEST(std::fabs(spectrum->points[0].whole().acceleration.maximax() / peak - 1.768457654) < 1e-7);
}

BOOST_AUTO_TEST_CASE(the_peaks_sensitivity_is_that_of_how_the_force_grows) {
  // F ∝ k_G δ^p: the peak grows like k_G^(1/(p + 1)), p = 2 for an edge and 3 for a corner, as the contact gets short.
  const Scene edge = box({{"drop.orientation", "--orientation", "9"}, {"ground.stiffness", "--stiffness", "1e12"}});
  const Scene corner = box({{"drop.orientation", "--orientation", "20"}, {"ground.stiffness", "--stiffness", "1e13"}});
  const ShockRun on_edge = run_shock(edge, box_probes, {.count = 2}),
                 on_corner = run_shock(corner, box_probes, {.count = 2});
  BOOST_TEST(std::fabs(on_edge.continuous->rows[0].sensitivity->value - 1.0 / 3) < 0.01);
  BOOST_TEST(std::fabs(on_corner.continuous->rows[0].sensitivity->value - 0.25) < 0.01);
}

BOOST_AUTO_TEST_CASE(the_far_end_of_a_nearly_flat_elastic_rod_gets_twice_the_flat_drops_change_of_velocity) {
  Scene scene = read_scene("", {{"drop.angle_deg", "--angle", "1e-4"}}, Model::discrete);
  const ShockRun run =
      run_shock(scene, {{"a", Vector3(-0.5, 0, 0)}, {"b", Vector3(0.5, 0, 0)}}, {.continuous = false, .count = 2});
  BOOST_TEST_REQUIRE(run.discrete.size() == 6U);
  const ShockRow& far = run.discrete[3];  // impact 2, end b
  BOOST_TEST(far.impact == 2);
  BOOST_TEST(std::fabs(far.value.delta_v.z() - 4) < 1e-9);
  const Spectrum* const flat = run.spectrum(1, false, Blows::flat);
  const Spectrum* const all = run.spectrum(1, false, Blows::all);
  BOOST_TEST_REQUIRE((flat != nullptr && all != nullptr));
  // Oscillators so fast that each blow is over for them before the next.
  BOOST_TEST(flat->points.back().whole().pseudo_velocity.maximax() > 1.85);
}

BOOST_AUTO_TEST_CASE(the_corner_that_strikes_changes_its_normal_velocity_by_one_plus_e_times_its_approach) {
  clatter::test::Random random(3);
  int looked_at = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Eigen::Quaterniond q = random.attitude();
    Scene scene = read_scene("",
                             {{"body.shape", "--body", "box"},
                              {"body.size", "--size", "0.1x0.06x0.02"},
                              {"drop.angle_deg", "--angle", "10"}},
                             Model::discrete);
    const double e = random(0, 1);
    scene.impact.restitution = e;
    scene.attitude = {q.w(), q.x(), q.y(), q.z()};
    scene.body.centre = {random(-0.01, 0.01), random(-0.005, 0.005), random(-0.002, 0.002)};
    scene.request.impacts = 1;
    const Vector3 normal = q.conjugate() * Vector3::UnitZ();
    Vector3 lowest;  // corner of the box, from its geometric centre
    for (int i = 0; i < 3; ++i) lowest[i] = normal[i] > 0 ? -scene.body.size[i] / 2 : scene.body.size[i] / 2;
    const ShockRun run = run_shock(scene, {{"corner", lowest}}, {.continuous = false, .count = 2});
    BOOST_TEST_REQUIRE(run.discrete.size() == 1U);
    const ShockRow& row = run.discrete[0];
    BOOST_TEST(std::fabs(row.value.delta_v.z() - (1 + e)) < 1e-13 + row.error.delta_v_size);
    if (std::isfinite(row.error.delta_v_size)) ++looked_at;
  }
  BOOST_TEST(looked_at > 95);
}

BOOST_AUTO_TEST_CASE(the_continuous_change_of_velocity_tends_to_the_discrete_one) {
  // Like the contact's duration, k^(-1/4): by 100^(-1/4) each time, and to nothing at k = ∞.
  const double ratio = std::pow(100, -0.25);
  std::vector<Vector3> apart;
  for (const char* stiffness : {"1e10", "1e12", "1e14"}) {
    Scene scene = box({{"drop.orientation", "--orientation", "20"},
                       {"ground.stiffness", "--stiffness", stiffness},
                       {"drop.speed", "--speed", "1"},
                       {"drop.angular_velocity", "--angular-velocity", "1,2,3"}});
    const ShockRun run = run_shock(scene, box_probes, {.sensitivity = false, .count = 2});
    BOOST_TEST_REQUIRE(run.discrete.size() == 2U);
    apart.push_back(run.continuous->rows[1].value.delta_v - run.discrete[1].value.delta_v);
  }
  for (std::size_t i = 1; i < apart.size(); ++i)
    BOOST_TEST(std::fabs(apart[i].norm() / apart[i - 1].norm() / ratio - 1) < 0.1);
  const Vector3 limit = (apart[2] - ratio * apart[1]) / (1 - ratio);
  BOOST_TEST(limit.norm() < 0.1 * apart[2].norm(), "left at k = ∞: " << limit.norm() << " of " << apart[2].norm());
}

BOOST_AUTO_TEST_CASE(numbers_of_few_digits_lie_within_their_errors) {
  clatter::test::Random random(11);
  int within = 0, all = 0, unknown = 0;
  for (int trial = 0; trial < 20; ++trial) {
    const std::string angle = std::to_string(random(5, 85)), tilt = std::to_string(random(0, 20)),
                      damping = std::to_string(random(0, 1e5));
    const std::vector<SceneOverride> overrides{{"drop.angle_deg", "--angle", angle},
                                               {"drop.tilt_deg", "--tilt", tilt},
                                               {"ground.damping", "--damping", damping}};
    Scene scene = box(overrides), finer = scene;
    scene.accuracy.digits = 4;
    finer.accuracy.digits = 11;
    const ShockRequest request{.sensitivity = false, .low = 50, .high = 5000, .count = 3};
    const ShockRun rough = run_shock(scene, box_probes, request), fine = run_shock(finer, box_probes, request);
    const auto count = [&](double one, double other, double error) {
      if (!std::isfinite(error)) {
        ++unknown;  // an impact in which rounding decides has no error, and no spectrum
        return;
      }
      ++all;
      if (std::fabs(one - other) <= error) ++within;
    };
    for (std::size_t i = 0; i < rough.continuous->rows.size(); ++i) {
      const ShockRow &one = rough.continuous->rows[i], &other = fine.continuous->rows[i];
      using Numbers = std::remove_const_t<decltype(ShockRow::value)>;
      for (const auto number :
           {&Numbers::delta_v_size, &Numbers::peak_size, &Numbers::peak_alpha, &Numbers::width, &Numbers::peak_time}) {
        count(one.value.*number, other.value.*number, one.error.*number);
      }
    }
    const Spectrum *one = rough.spectrum(1, true, Blows::impact_1), *other = fine.spectrum(1, true, Blows::impact_1);
    if (!one || !other) {
      unknown += 6;
      continue;
    }
    for (std::size_t i = 0; i < one->points.size(); ++i) {
      count(one->points[i].whole().pseudo_velocity.maximax(), other->points[i].whole().pseudo_velocity.maximax(),
            one->points[i].pseudo_velocity_error);
      count(one->points[i].whole().acceleration.maximax(), other->points[i].whole().acceleration.maximax(),
            one->points[i].acceleration_error);
    }
  }
  BOOST_TEST(all > 200);
  BOOST_TEST(unknown < 0.1 * all);
  BOOST_TEST(within >= 0.95 * all);  // as the simulator's own bars
}

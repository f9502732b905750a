// SPDX-License-Identifier: GPL-3.0-or-later
// The batch against the scalar code, and both against equations that neither has: counts, error bars, the same bits
// from every instruction set.
#include "analytic/batch/batch.hpp"

#include <cstring>

#include "analytic/base/angle.hpp"
#include "analytic/batch/lane_kernels.hpp"
#include "analytic/batch/rod_batch.hpp"
#include "analytic/plane/contact_angles.hpp"
#include "analytic/plane/sequence.hpp"
#include "tests/support.hpp"

using namespace clatter::analytic;
using namespace clatter::analytic::batch;
using clatter::test::Random;

namespace {

#define CLATTER_LANES 2
#include "analytic/batch/lane_kernel.hpp"
#undef CLATTER_LANES

struct Kind {
  const char* name;
  PlanarBody body;
  int limit;
  double least_restitution = 1, most_gravity = 0, most_ratio = 0, most_spin = 0, most_restitution = 1;
};

const std::vector<Kind> kinds{
    {"elastic rod", make_rod({}), 6},
    {"rod, e < 1", make_rod({}), 40, 0.05},
    {"rod with gravity", make_rod({}), 3, 1, 2},
    {"rod with all", make_rod({}), 3, 0.05, 2, 0.3, 1},
    {"thick rod", make_rod({.radius = 0.1}), 8, 0.2, 0, 0.2},
    {"box", make_box({.length = 0.15, .thickness = 0.12}), 8, 0.2, 0, 0, 5},
    {"box with all", make_box({.mass = 0.3, .length = 0.15, .thickness = 0.03}), 4, 0.1, 20, 0.3, 5},
};

struct RandomDrops {
  std::vector<double> angle, restitution, gravity, ratio, spin, fall{-1}, still{0};
  BatchDrops drops;

  RandomDrops(const Kind& kind, std::size_t count) {
    Random random(11);
    for (std::size_t i = 0; i < count; ++i) {
      angle.push_back((2 * random(0, 1) - 1) * pi / 2);
      restitution.push_back(kind.most_restitution - (kind.most_restitution - kind.least_restitution) * random(0, 1));
      gravity.push_back(kind.most_gravity * random(0, 1));
      ratio.push_back(kind.most_ratio * (2 * random(0, 1) - 1));
      spin.push_back(kind.most_spin * (2 * random(0, 1) - 1));
    }
    drops = {kind.body, angle, fall, still, spin, gravity, restitution, ratio};
  }
};

bool is_within(double value, double expected, double bar) { return std::fabs(value - expected) <= bar; }

bool agrees(const BatchOutcome& outcome, const Sequence& sequence) {
  if (outcome.impacts != static_cast<int>(sequence.rows.size()) || sequence.tail) return false;
  if (outcome.last_vertices != sequence.rows.back().vertices) return false;
  for (std::size_t n = 0; n < std::min<std::size_t>(3, sequence.rows.size()); ++n) {
    const ImpactRow& row = sequence.rows[n];
    if (!is_within(outcome.impulse[n], row.impact.normal_impulse, row.error.normal_impulse) ||
        !is_within(outcome.contact_angle[n], row.contact_angle, row.error.contact_angle) ||
        !is_within(outcome.start[n], row.start, row.error.start)) {
      return false;
    }
  }
  double loss = 0, loss_error = 0, largest = 0;
  for (const ImpactRow& row : sequence.rows) {
    loss += row.impact.energy_loss;
    loss_error += row.error.energy_loss;
    largest = std::fmax(largest, row.impact.normal_impulse);
  }
  const double hardest = sequence.rows.at(static_cast<std::size_t>(outcome.hardest - 1)).impact.normal_impulse;
  return is_within(outcome.energy_loss, loss, loss_error) &&
         is_within(outcome.largest, largest, sequence.total_normal_impulse_error) &&
         is_within(hardest, largest, sequence.total_normal_impulse_error) &&
         is_within(outcome.total, sequence.total_normal_impulse, sequence.total_normal_impulse_error);
}

bool same_bits(double a, double b) { return std::memcmp(&a, &b, sizeof a) == 0 || (std::isnan(a) && std::isnan(b)); }

constexpr std::size_t drop_count = CLATTER_TEST_SLOW_BUILD ? 400 : 4000;

/// Of wild drops the batch decides one of a hundred or fewer, so no build runs fewer.
constexpr std::size_t wild_count = 4000;

/// Parts of drops that rounding or a number of impacts leaves to the scalar code.
constexpr double few = 0.15;

}  // namespace

BOOST_AUTO_TEST_CASE(counts_are_the_scalar_codes_and_numbers_within_its_error_bars) {
  for (const Kind& kind : kinds) {
    const RandomDrops random(kind, drop_count);
    std::vector<BatchOutcome> outcomes(drop_count);
    run_batch(random.drops, {.limit = kind.limit}, 0, outcomes);
    std::size_t scalar = 0, wrong = 0;
    for (std::size_t i = 0; i < drop_count; ++i) {
      scalar += outcomes[i].is_scalar ? 1 : 0;
      if (outcomes[i].is_scalar) continue;
      if (!agrees(outcomes[i], impact_sequence(random.drops.drop(i), {.impacts = kind.limit}))) ++wrong;
    }
    BOOST_TEST(wrong == 0u, kind.name << ": " << wrong << " wrong");
    BOOST_TEST(static_cast<double>(scalar) <= few * static_cast<double>(drop_count), kind.name << ": " << scalar);
  }
}

BOOST_AUTO_TEST_CASE(drops_of_many_turns_and_bounces_have_the_scalar_codes_counts_or_are_its_own) {
  const Kind wild[]{{"box of many turns", make_box({.length = 200, .thickness = 60}), 6, 0.2, 0.01, 0, 20},
                    {"rod near jamming", make_rod({}), 5, 0.3, 1, 1.3, 1},
                    {"box that rattles", make_box({.length = 0.01, .thickness = 0.006}), 7, 0.6, 1e8, 0, 100},
                    {"rod of many bounces", make_rod({}), 11, 0.002}};
  for (const Kind& kind : wild) {
    const RandomDrops random(kind, wild_count);
    std::vector<BatchOutcome> outcomes(wild_count);
    run_lanes(random.drops, {.limit = kind.limit}, 0, outcomes);
    std::size_t wrong = 0, scalar = 0;
    for (std::size_t i = 0; i < wild_count; ++i) {
      scalar += outcomes[i].is_scalar ? 1 : 0;
      if (outcomes[i].is_scalar) continue;
      const Sequence sequence = impact_sequence(random.drops.drop(i), {.impacts = kind.limit, .amplification = false});
      if (outcomes[i].impacts != static_cast<int>(sequence.rows.size()) || sequence.tail ||
          outcomes[i].last_vertices != sequence.rows.back().vertices) {
        ++wrong;
      }
    }
    BOOST_TEST(wrong == 0u, kind.name << ": " << wrong << " wrong");
    BOOST_TEST(scalar < wild_count, kind.name);
  }
}

BOOST_AUTO_TEST_CASE(every_instruction_set_gives_the_same_bits) {
  for (const Kind& kind : kinds) {
    const RandomDrops random(kind, 203);  // not a multiple of the block
    std::vector<BatchOutcome> widest(203), other(203);
    run_batch(random.drops, {.limit = kind.limit}, 0, widest);
    for (const batch::KernelChoice& kernel : batch::kernels()) {
      run_batch(random.drops, {.limit = kind.limit}, 0, other, kernel.run);
      for (std::size_t i = 0; i < other.size(); ++i) {
        BOOST_TEST_REQUIRE(other[i].impacts == widest[i].impacts, kernel.name);
        BOOST_TEST_REQUIRE(other[i].is_scalar == widest[i].is_scalar, kernel.name);
        BOOST_TEST_REQUIRE(same_bits(other[i].total, widest[i].total), kernel.name);
        BOOST_TEST_REQUIRE(same_bits(other[i].energy_loss, widest[i].energy_loss), kernel.name);
        for (std::size_t n = 0; n < 3; ++n)
          BOOST_TEST_REQUIRE(same_bits(other[i].contact_angle[n], widest[i].contact_angle[n]), kernel.name);
      }
    }
  }
}

BOOST_AUTO_TEST_CASE(a_part_of_a_batch_is_that_part_of_the_whole) {
  const RandomDrops random(kinds[6], 100);
  std::vector<BatchOutcome> whole(100), part(37);
  run_batch(random.drops, {.limit = 4}, 0, whole);
  run_batch(random.drops, {.limit = 4}, 41, part);
  for (std::size_t i = 0; i < part.size(); ++i) BOOST_TEST(same_bits(part[i].total, whole[41 + i].total));
}

BOOST_AUTO_TEST_CASE(a_fold_is_the_scalar_codes) {
  const double fold = regime_boundary(ImpactNumber::second, {}).theta;
  std::vector<double> theta;
  for (int i = -8; i <= 8; ++i) theta.push_back(fold * (1 + i * 0x1p-52));
  theta.insert(theta.end(), {fold - 1e-7, fold + 1e-7});
  const std::vector<double> fall{-1}, none{0}, one{1};
  const BatchDrops drops{make_rod({}), theta, fall, none, none, none, one, none};
  std::vector<BatchOutcome> outcomes(theta.size());
  run_batch(drops, {.limit = 6}, 0, outcomes);
  for (std::size_t i = 0; i < 17; ++i) {
    BOOST_TEST(outcomes[i].is_scalar);
    BOOST_TEST(outcomes[i].impacts == static_cast<int>(impact_sequence(drops.drop(i), {.impacts = 6}).rows.size()));
  }
  BOOST_TEST(outcomes[8].is_open);
  BOOST_TEST(outcomes[17].impacts == 2);
  BOOST_TEST(outcomes[18].impacts == 1);
}

BOOST_AUTO_TEST_CASE(infinitely_many_impacts_are_proven_where_the_scalar_code_sums_them_up_and_nowhere_else) {
  PlanarBody heavy_middle = make_rod({}), unequal = make_rod({});
  heavy_middle.gyration_square = 0.01;
  heavy_middle.uniform_thin_rod = unequal.uniform_thin_rod = false;
  unequal.vertices = {{{-0.3, 0}, {0.7, 0}}};
  unequal.gyration_square = 0.1;
  // Both sides of each body's limit of e.
  const Kind many[]{{"rod", make_rod({}), 100, 0.001, 0, 0, 0.5, 0.09},
                    {"heavy middle", heavy_middle, 100, 0.01, 0, 0, 2, 0.6},
                    {"unequal arms", unequal, 100, 0.001, 0, 0, 2, 0.3},
                    {"box", make_box({.length = 1, .thickness = 0.2}), 100, 0.001, 0, 0, 0.5, 0.08}};
  for (const Kind& kind : many) {
    const RandomDrops random(kind, drop_count);
    std::vector<BatchOutcome> outcomes(drop_count);
    run_lanes(random.drops, {.limit = kind.limit, .only_counts = true}, 0, outcomes);
    std::size_t wrong = 0, summed = 0, proven = 0;
    for (std::size_t i = 0; i < drop_count; ++i) {
      // Close to the limit of e the scalar code may need more than these impacts for its sum.
      const BatchEnd scalar = scalar_outcome(random.drops.drop(i), kind.limit).end;
      const bool is_proven = outcomes[i].end == BatchEnd::infinite, is_summed = scalar == BatchEnd::infinite;
      summed += is_summed ? 1 : 0;
      proven += is_proven ? 1 : 0;
      if (!outcomes[i].is_scalar && (is_proven ? !is_summed && scalar != BatchEnd::at_limit : is_summed)) ++wrong;
    }
    BOOST_TEST(wrong == 0u, kind.name << ": " << wrong << " wrong");
    BOOST_TEST(10 * proven >= 8 * summed, kind.name << ": " << proven << " of " << summed << " proven");
    BOOST_TEST((summed > 0u && summed < drop_count), kind.name << ": " << summed << " with a sum");
  }
}

BOOST_AUTO_TEST_CASE(what_the_kernels_are_not_for_has_an_end_of_its_own) {
  const std::vector<double> theta{0, pi / 2, 0.3, 0.3, 1.1, 0.3}, fall{-1, -1, -1, 1, -1, -1}, none{0};
  const std::vector<double> gravity{0, 0, 9.81, 0, 0, 9.81}, e{1, 1, 0.2, 1, 1, 0}, ratio{0, 0, 0, 0, 5, 0};
  const BatchDrops drops{make_rod({}), theta, fall, none, none, gravity, e, ratio};
  std::vector<BatchOutcome> outcomes(theta.size());
  run_batch(drops, {.limit = 500}, 0, outcomes);
  const BatchEnd ends[] = {BatchEnd::finished, BatchEnd::finished, BatchEnd::infinite,
                           BatchEnd::refused,  BatchEnd::outside,  BatchEnd::stays};
  for (std::size_t i = 0; i < theta.size(); ++i) {
    BOOST_TEST(outcomes[i].is_scalar);
    BOOST_TEST(static_cast<int>(outcomes[i].end) == static_cast<int>(ends[i]), "drop " << i);
  }
  BOOST_TEST(outcomes[0].last_vertices == 3);
  BOOST_TEST(std::isnan(outcomes[3].total));
}

BOOST_AUTO_TEST_CASE(a_drop_that_is_none_is_refused_and_the_others_go_on) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<double> angle{0.3, nan, 0.3, 0.3, 4}, fall{-1, -1, nan, -1, -1}, none{0}, one{1};
  std::vector<BatchOutcome> outcomes(angle.size());
  run_batch({make_rod({}), angle, fall, none, none, none, one, none}, {.limit = 6}, 0, outcomes);
  for (const std::size_t bad : {1, 2, 4}) {
    BOOST_TEST((outcomes[bad].end == BatchEnd::refused), "drop " << bad);
    BOOST_TEST(std::isnan(outcomes[bad].total));
  }
  BOOST_TEST((outcomes[0].end == BatchEnd::finished));
  BOOST_TEST(outcomes[3].total == outcomes[0].total);
}

BOOST_AUTO_TEST_CASE(arrays_that_are_left_out_have_the_values_of_a_drop_but_angle_and_speed_must_be_there) {
  const std::vector<double> angle{0.2, 0.4}, fall{-1};
  const BatchDrops drops{.body = make_rod({}), .inclination = angle, .normal = fall};
  const Drop without = drops.drop(1), plain;
  BOOST_TEST((without.velocity.tangential == plain.velocity.tangential));
  BOOST_TEST((without.velocity.angular == plain.velocity.angular && without.gravity == plain.gravity));
  BOOST_TEST((without.law.restitution == plain.law.restitution && without.law.friction == plain.law.friction));
  std::vector<BatchOutcome> outcomes(2);
  run_batch(drops, {}, 0, outcomes);
  for (std::size_t i = 0; i < 2; ++i)
    BOOST_TEST(outcomes[i].impacts == static_cast<int>(impact_sequence(drops.drop(i)).rows.size()));
  BOOST_CHECK_THROW(run_batch({.body = make_rod({}), .inclination = angle, .normal = {}}, {}, 0, outcomes),
                    std::invalid_argument);
  BOOST_CHECK_THROW(run_batch({.body = make_rod({}), .inclination = {}, .normal = fall}, {}, 0, outcomes),
                    std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(arrays_of_two_lengths_a_limit_below_one_and_a_body_that_is_none_are_refused) {
  const std::vector<double> three{0.1, 0.2, 0.3}, two{-1, -1}, none{0}, one{1};
  std::vector<BatchOutcome> outcomes(3);
  BatchDrops drops{make_rod({}), three, two, none, none, none, one, none};
  BOOST_CHECK_THROW(run_batch(drops, {.limit = 6}, 0, outcomes), std::invalid_argument);
  drops.normal = std::span(two).first(1);
  BOOST_CHECK_THROW(run_batch(drops, {.limit = 0}, 0, outcomes), std::invalid_argument);
  BOOST_CHECK_THROW(run_batch(drops, {.limit = 6}, 1, outcomes), std::invalid_argument);  // of three drops two are left
  run_batch(drops, {.limit = 6}, 0, outcomes);
  for (const double mass : {-1.0, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
    drops.body.mass = mass;
    BOOST_CHECK_THROW(run_batch(drops, {.limit = 6}, 0, outcomes), std::domain_error);
  }
}

BOOST_AUTO_TEST_CASE(contacts_of_many_rods_are_those_of_each_with_the_velocities_after_them) {
  constexpr double close = 1e-12;  // condition numbers stay below a thousand but next to a fold
  const std::vector<RodParameters> rods{{}, {0.7, 1, 0}, {0, 0.4, 0}, {0, 1, 0.3}, {0, 1, -1.2}, {0.5, 0.8, 1.1}};
  std::vector<double> theta;
  for (std::size_t i = 0; i < drop_count; ++i) theta.push_back(90. * static_cast<double>(i) / drop_count);
  std::vector<RodContacts> rows(drop_count);
  for (const RodParameters& rod : rods) {
    batch_contact_angles(theta, rod, rows);
    std::size_t scalar = 0;
    for (std::size_t i = 0; i < drop_count; ++i) {
      const ContactAngles one = contact_angles(Angle::from_degrees(theta[i]), rod);
      BOOST_TEST_REQUIRE(rows[i].impacts == one.impacts(), "theta " << theta[i] << " mu " << rod.impulse_ratio);
      BOOST_TEST_REQUIRE(std::isnan(rows[i].angle[0]) == (one.impacts() < 2));
      if (one.impacts() > 1) BOOST_TEST_REQUIRE(is_within(rows[i].angle[0], one.beta.angle, 1e-8));  // near a fold
      scalar += rows[i].is_scalar ? 1 : 0;
      if (rows[i].impacts < 3) BOOST_TEST_REQUIRE(std::isnan(rows[i].velocity[2]));
      if (i % 9 != 0 || std::fabs(rod.impulse_ratio) > 1) continue;
      for (std::size_t n = 0; n < static_cast<std::size_t>(rows[i].impacts); ++n) {
        BOOST_TEST(is_within(rows[i].impulse[n], one.impulse[n], close));
        BOOST_TEST(is_within(rows[i].velocity[n], one.velocity[n], close));
        BOOST_TEST(is_within(rows[i].angular[n], one.angular[n], 10 * close));
      }
    }
    BOOST_TEST(static_cast<double>(scalar) <= few * static_cast<double>(drop_count));
  }
  CHECK_REFUSED(batch_contact_angles(theta, {}, std::span(rows).first(1)), std::invalid_argument);
}

BOOST_AUTO_TEST_CASE(sines_and_cosines_are_good_to_one_and_a_half_ulp) {
  Random random(5);
  double worst = 0;
  for (std::size_t i = 0; i < 50 * drop_count; ++i) {
    const double x = random(-100, 100) / (i % 2 ? 1 : 64);
    const SineCosine found = sine_cosine(Vector{x, -x});
    const long double s = sinl(x), c = cosl(x);
    for (const auto& [value, exact] : {std::pair(found.sine[0], s), std::pair(-found.sine[1], s),
                                       std::pair(found.cosine[0], c), std::pair(found.cosine[1], c)}) {
      const double ulp = 0x1p-52 * std::exp2(std::floor(std::log2(std::fabs(static_cast<double>(exact)))));
      worst = std::fmax(worst, static_cast<double>(fabsl(value - exact)) / std::fmax(ulp, 0x1p-56));
    }
  }
  BOOST_TEST(worst <= 1.5);
}

// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/batch/batch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "analytic/base/errors.hpp"
#include "analytic/plane/sequence.hpp"

namespace clatter::analytic {
namespace {

using batch::block_size;

double number_at(std::span<const double> numbers, std::size_t i) { return numbers[numbers.size() == 1 ? 0 : i]; }

/// One number of a drop: its name, the array of a batch that has it, and where a block of eight drops keeps it.
struct DropNumber {
  const char* name;
  std::span<const double> BatchDrops::*array;
  batch::Block batch::LaneDrops::*lanes;
};
constexpr DropNumber drop_numbers[]{
    {"inclination", &BatchDrops::inclination, &batch::LaneDrops::inclination},
    {"normal", &BatchDrops::normal, &batch::LaneDrops::normal},
    {"tangential", &BatchDrops::tangential, &batch::LaneDrops::tangential},
    {"angular", &BatchDrops::angular, &batch::LaneDrops::angular},
    {"gravity", &BatchDrops::gravity, &batch::LaneDrops::gravity},
    {"restitution", &BatchDrops::restitution, &batch::LaneDrops::restitution},
    {"impulse_ratio", &BatchDrops::impulse_ratio, &batch::LaneDrops::impulse_ratio},
};

batch::LaneBody lane_body(const PlanarBody& body) {
  batch::LaneBody lanes{
      .mass = body.mass, .inverse_gyration_square = 1 / body.gyration_square, .vertex_count = body.vertex_count};
  for (std::size_t j = 0; j < static_cast<std::size_t>(body.vertex_count); ++j) {
    const auto [x, z] = body.vertices[j];
    lanes.x[j] = x;
    lanes.z[j] = z;
    lanes.reach[j] = std::hypot(x, z);
    lanes.polar[j] = std::atan2(z, x);
    lanes.most_reach = std::fmax(lanes.most_reach, lanes.reach[j]);
  }
  return lanes;
}

/// The eight drops from number `first` on; the last one fills the block up.
batch::LaneDrops lane_drops(const BatchDrops& drops, std::size_t first) {
  batch::LaneDrops lanes;
  const std::size_t last = drops.count() - 1;
  for (const DropNumber& number : drop_numbers) {
    for (std::size_t i = 0; i < block_size; ++i)
      (lanes.*number.lanes)[i] = number_at(drops.*number.array, std::min(first + i, last));
  }
  return lanes;
}

/// Below this an end hardly leaves the ground, and rounding may decide what its flight begins with.
constexpr double least_restitution = 1e-4;

/// Within what the kernels are for; the scalar code has an answer, or words, for all else.
bool is_lane_drop(const batch::LaneDrops& lanes, std::size_t i) {
  const double e = lanes.restitution[i];
  return e >= least_restitution && e <= 1 && lanes.gravity[i] >= 0 && std::fabs(lanes.inclination[i]) <= pi / 2;
}

BatchOutcome without_numbers(BatchEnd end) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  return {.end = end,
          .is_scalar = true,
          .total = none,
          .largest = none,
          .last_start = none,
          .energy_loss = none,
          .impulse = {none, none, none},
          .contact_angle = {none, none, none},
          .start = {none, none, none}};
}

BatchOutcome outcome_of(const batch::LaneResults& lanes, std::size_t i) {
  if (lanes.is_infinite[i]) {
    BatchOutcome outcome = without_numbers(BatchEnd::infinite);
    outcome.impacts = static_cast<int>(lanes.impacts[i]);
    outcome.is_scalar = false;
    return outcome;
  }
  BatchOutcome outcome{.impacts = static_cast<int>(lanes.impacts[i]),
                       .end = lanes.is_at_limit[i] ? BatchEnd::at_limit : BatchEnd::finished,
                       .total = lanes.total[i],
                       .largest = lanes.largest[i],
                       .hardest = static_cast<int>(lanes.hardest[i]),
                       .last_vertices = static_cast<VertexSet>(1u << static_cast<unsigned>(lanes.last_vertex[i])),
                       .last_start = lanes.last_start[i],
                       .energy_loss = lanes.loss[i]};
  for (std::size_t n = 0; n < outcome.impulse.size(); ++n) {
    outcome.impulse[n] = lanes.impulse[n][i];
    outcome.contact_angle[n] = lanes.contact_angle[n][i];
    outcome.start[n] = lanes.start[n][i];
  }
  return outcome;
}

BatchOutcome outcome_of(const Sequence& sequence) {
  BatchOutcome outcome = without_numbers(batch_end(sequence.outcome, sequence.tail.has_value()));
  outcome.impacts = static_cast<int>(sequence.rows.size());
  outcome.is_open = !sequence.end_predictable;
  outcome.total = sequence.total_normal_impulse;
  outcome.largest = outcome.energy_loss = 0;
  for (std::size_t n = 0; n < sequence.rows.size(); ++n) {
    const ImpactRow& row = sequence.rows[n];
    outcome.energy_loss += row.impact.energy_loss;
    if (row.impact.normal_impulse > outcome.largest) {
      outcome.largest = row.impact.normal_impulse;
      outcome.hardest = static_cast<int>(n) + 1;
    }
    if (n >= outcome.impulse.size()) continue;
    outcome.impulse[n] = row.impact.normal_impulse;
    outcome.contact_angle[n] = row.contact_angle;
    outcome.start[n] = row.start;
  }
  outcome.last_vertices = sequence.rows.back().vertices;
  outcome.last_start = sequence.rows.back().start;
  return outcome;
}

}  // namespace

BatchEnd batch_end(Outcome outcome, bool has_tail) {
  if (has_tail) return BatchEnd::infinite;
  switch (outcome) {
    case Outcome::no_further_impact: return BatchEnd::finished;
    case Outcome::impact_limit:
    case Outcome::time_limit: return BatchEnd::at_limit;
    case Outcome::at_rest:
    case Outcome::sustained_contact: return BatchEnd::stays;
    case Outcome::outside_model: return BatchEnd::outside;
    case Outcome::not_computed: break;
  }
  return BatchEnd::not_computed;
}

std::size_t BatchDrops::count() const {
  std::size_t most = 1;
  for (const DropNumber& number : drop_numbers) most = std::max(most, (this->*number.array).size());
  return most;
}

Drop BatchDrops::drop(std::size_t i) const {
  return {.body = body,
          .inclination = Angle::from_radians(number_at(inclination, i)),
          .velocity = {.normal = number_at(normal, i),
                       .tangential = number_at(tangential, i),
                       .angular = number_at(angular, i)},
          .gravity = number_at(gravity, i),
          .law = {.restitution = number_at(restitution, i),
                  .friction = number_at(impulse_ratio, i) != 0 ? FrictionKind::impulse_ratio : FrictionKind::none,
                  .friction_value = number_at(impulse_ratio, i)}};
}

void BatchDrops::validate() const {
  for (const DropNumber& number : drop_numbers) {
    const std::size_t size = (this->*number.array).size();
    if (size == 1 || size == count()) continue;
    throw std::invalid_argument("arrays of a batch: " + std::string(number.name) + " has " + std::to_string(size) +
                                " numbers; must be 1 or " + std::to_string(count()) + ", as the longest has");
  }
  Drop drop;  // one, whatever its body
  drop.body = body;
  drop.inclination = Angle::from_radians(0.1);
  drop.velocity.normal = -1;
  drop.validate();
}

namespace {

/// @param drop  makes it, unless its numbers are none
BatchOutcome outcome_of_scalar(auto&& drop, int limit) {
  try {
    return outcome_of(summed_sequence(drop(), {.impacts = limit}));
  } catch (const OutsideModelError&) {
    return without_numbers(BatchEnd::outside);
  } catch (const NumericalError&) {
    return without_numbers(BatchEnd::not_computed);
  } catch (const std::domain_error&) {
    return without_numbers(BatchEnd::refused);
  }
}

}  // namespace

BatchOutcome scalar_outcome(const Drop& drop, int limit) {
  return outcome_of_scalar([&]() -> const Drop& { return drop; }, limit);
}

void run_lanes(const BatchDrops& drops, const BatchRequest& request, std::size_t first,
               std::span<BatchOutcome> outcomes, batch::Kernel kernel) {
  drops.validate();
  if (request.limit < 1) throw std::invalid_argument("the limit of a batch must be at least 1");
  if (drops.count() > 1 && (first > drops.count() || outcomes.size() > drops.count() - first))
    throw std::invalid_argument("more outcomes are asked for than the batch has drops");
  if (!kernel) kernel = batch::kernels().front().run;
  const batch::LaneBody body = lane_body(drops.body);
  batch::LaneResults results;
  for (std::size_t begin = 0; begin < outcomes.size(); begin += block_size) {
    const batch::LaneDrops lanes = lane_drops(drops, first + begin);
    kernel(body, lanes, request, results);
    for (std::size_t i = 0; i < std::min<std::size_t>(block_size, outcomes.size() - begin); ++i) {
      const bool is_lane = results.is_certain[i] && is_lane_drop(lanes, i);
      outcomes[begin + i] = is_lane ? outcome_of(results, i) : without_numbers(BatchEnd::not_computed);
    }
  }
}

void run_batch(const BatchDrops& drops, const BatchRequest& request, std::size_t first,
               std::span<BatchOutcome> outcomes, batch::Kernel kernel) {
  run_lanes(drops, request, first, outcomes, kernel);
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    if (outcomes[i].is_scalar) outcomes[i] = outcome_of_scalar([&] { return drops.drop(first + i); }, request.limit);
  }
}

}  // namespace clatter::analytic

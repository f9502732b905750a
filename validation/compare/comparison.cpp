// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "analytic/law/viscoelastic.hpp"
#include "validation/compare/stiff_limit.hpp"
#include "validation/output/number.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/names.hpp"

namespace clatter::validation {
namespace {

using numeric::ImpactRecord;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double bars_apart =
    5;  // a bar holds in all but some of a hundred numbers; a model that is wrong misses by many
constexpr long evaluations_per_run = 300'000;  // a contact that takes more is none that the discrete model knows

/// Whether an impact ended in stick.
bool sticks(numeric::FrictionMode mode) {
  return mode == numeric::FrictionMode::stick || mode == numeric::FrictionMode::slip_stick;
}

/// Whether an impact sticks in one model alone because the discrete one has no static coefficient of its own.
bool sticks_in_one_model(const numeric::Ground& ground, const SequenceImpact& discrete,
                         numeric::FrictionMode continuous) {
  return ground.static_friction != ground.sliding_friction && discrete.sticks != sticks(continuous);
}

/// Whether slip that nearly stops has done so in one model alone: the deviations of a finite contact, grown by the
/// impacts before, decide that on every ground of the runs, and what they tend to is no limit of the discrete value.
bool stops_in_one_model(const SequenceImpact& discrete, numeric::FrictionMode continuous) {
  return discrete.nearly_stops && discrete.sticks != sticks(continuous);
}

/// Whether a face turns in the discrete model, while the continuous one, whose friction holds the pressure centre
/// alone, sticks and lets it spin.
bool only_spins(const SequenceImpact& discrete, numeric::FrictionMode continuous) {
  return discrete.is_face && !discrete.sticks && continuous == numeric::FrictionMode::stick;
}

/// Why an impact cannot be compared at any stiffness; empty if it can.
std::string reason_in_principle(const SequenceImpact& impact) {
  return impact.open.empty() ? impact.follows_open : impact.open;
}

/// Whether an ever stiffer ground has numbers to show beside it, if not the same.
bool has_limit(const SequenceImpact& impact) {
  return impact.follows_open.empty() && (impact.open.empty() || impact.is_face);
}

std::string unpredictable_words(const ImpactRecord& record, bool in_space) {
  return fmt::format("beyond the predictable: {}an error of the start has grown {} times",
                     in_space ? "" : "out of its plane ", significant(record.amplification, 2));
}

/// Why impact i cannot be compared at the scene's stiffness; empty if it can.
std::string reason_against(const Comparison& comparison, const Scene& scene, const numeric::Body& body, std::size_t i) {
  const DiscreteSide& side = comparison.discrete;
  const auto& records = comparison.run.impacts;
  if (i >= side.impacts.size()) return "the discrete sequence has ended: " + side.message;
  if (i >= records.size()) return "the continuous run has ended: " + comparison.run.message;
  const SequenceImpact& impact = side.impacts[i];
  if (const std::string reason = reason_in_principle(impact); !reason.empty()) return reason;
  const ImpactRecord& record = records[i];
  if (!record.predictable) return unpredictable_words(record, side.in_space);
  if (!impact.predictable) return "beyond the predictable: an error of the start has grown too far";
  if (impact.jams) return "jamming: friction beyond Painlevé's limit drives the contact into the ground";
  if (const std::string reason = other_blow(side, impact, record, body); !reason.empty()) return reason;
  if (sticks_in_one_model(scene.world.ground, impact, record.mode))
    return "static and sliding friction differ; the discrete model has one coefficient";
  const MotionNumbers size = comparison.impacts[i].predicted.total();
  if (!std::isfinite(size[0] + size[1] + size[normal_impulse_place]))
    return "the contacts last too long: within what they leave open another sequence follows";
  return "";
}

/// |limit − discrete| that error bars and the rounding of the discrete model leave open.
MotionNumbers allowance(const LimitRow& limit, const SequenceImpact& impact, const MotionNumbers& scales) {
  MotionNumbers sum{};
  const double growth = std::isfinite(impact.amplification) ? impact.amplification : 1;
  for (std::size_t q = 0; q < motion_number_count; ++q)
    sum[q] = bars_apart * limit.error[q] + 8 * epsilon * (1 + growth) * scales[q] + impact.tipping[q];
  return sum;
}

/// The estimates, unknown in a row that cannot be predicted.
MotionNumbers error_of(const ImpactRecord& record) {
  MotionNumbers error = motion_numbers(impact_of(record).error);
  if (!record.predictable) error.fill(std::numeric_limits<double>::infinity());
  return error;
}

void add_impact(Comparison& comparison, const numeric::Body& body, std::size_t i) {
  const DiscreteSide& side = comparison.discrete;
  const auto& records = comparison.run.impacts;
  ComparedImpact& impact = comparison.impacts.emplace_back();
  impact.n = static_cast<int>(i) + 1;
  if (i < side.impacts.size()) {
    impact.discrete = side.impacts[i].numbers;
    impact.discrete_error = side.impacts[i].errors;
    impact.discrete_end = side.impacts[i].end;
  }
  if (comparison.as_given && i < comparison.as_given->impacts.size()) {
    impact.as_given = comparison.as_given->impacts[i].numbers;
    impact.as_given_error = comparison.as_given->impacts[i].errors;
    impact.as_given_end = comparison.as_given->impacts[i].end;
  }
  if (i < records.size()) {
    impact.continuous = motion_numbers(impact_of(records[i]).value);
    impact.continuous_error = error_of(records[i]);
    impact.continuous_end = contact_name(side, records[i].end, records[i].place, body);
    impact.contact_time = records[i].value.duration;
  }
  const auto& limits = comparison.limit.rows;
  if (i < limits.size() && i < side.impacts.size() && has_limit(side.impacts[i]) &&
      same_contact(side.impacts[i], limits[i].end, limits[i].place, body)) {
    impact.limit = limits[i];
    impact.has_same_limit = reason_in_principle(side.impacts[i]).empty();
    impact.allowance = allowance(limits[i], side.impacts[i], side.scales);
  }
}

/// The stiff limit holds the friction of the sequence: with two coefficients it may stick where the discrete model
/// slips, and is then no limit of it.  In space an impact after one of another corner has none either.
void drop_unlike_limits(Comparison& comparison, const Scene& scene) {
  bool alike = true;
  for (std::size_t i = 0; i < comparison.impacts.size(); ++i) {
    ComparedImpact& impact = comparison.impacts[i];
    const SequenceImpact* const discrete =
        i < comparison.discrete.impacts.size() ? &comparison.discrete.impacts[i] : nullptr;
    if (impact.limit && sticks_in_one_model(scene.world.ground, *discrete, impact.limit->mode)) alike = false;
    if (comparison.discrete.in_space && !impact.limit) alike = false;
    if (impact.limit && only_spins(*discrete, impact.limit->mode)) alike = false;
    if (impact.limit && impact.bars_off() > 1 && stops_in_one_model(*discrete, impact.limit->mode)) alike = false;
    if (!alike) impact.limit.reset();
  }
}

/// By how much the rule of a face is off the limit of an even bed.
std::string bed_words(const ComparedImpact& impact, const DiscreteSide& side) {
  double largest = 0;
  std::string quantity;
  for (const auto& [name, heading, q] : side.quantities) {
    const double off = std::fabs(impact.limit->value[q] - (*impact.discrete)[q]) / side.scales[q];
    if (off <= largest) continue;
    largest = off;
    quantity = fmt::format(" ({})", heading);
  }
  return fmt::format("on an even bed up to {} of the scale off{}: ", significant(largest, 2), quantity);
}

/// Where a limit is off by more than its bar says; empty: by less.
std::string limit_miss_words(const ComparedImpact& impact, const SequenceImpact& discrete) {
  if (!impact.lands()) return "its limit misses the discrete value: the models differ here";
  const double bars = impact.bars_off();
  if (bars <= 1) return "";
  if (discrete.tipping != MotionNumbers{})
    return "friction, below the centre of mass, tips the body on an even bed: the limit is off by less than its size";
  return fmt::format("off by up to {} of its error bars: the numbers approach it more slowly than the bar assumes",
                     significant(bars, 2));
}

/// Why the impact has no limit, or its limit lies outside its error bar; empty: it lies within.
std::string explanation_of(const Comparison& comparison, const Scene& scene, const numeric::Body& body, std::size_t i) {
  const DiscreteSide& side = comparison.discrete;
  const ComparedImpact& impact = comparison.impacts[i];
  if (impact.has_landing()) return limit_miss_words(impact, side.impacts[i]);
  if (i >= side.impacts.size()) return "the discrete sequence has ended: " + side.message;
  const SequenceImpact& discrete = side.impacts[i];
  if (const std::string reason = reason_in_principle(discrete); !reason.empty())
    return impact.has_limit() ? bed_words(impact, side) + reason : reason;
  if (!discrete.predictable)
    return "beyond the predictable: rounding, grown by the impacts before, decides what follows";
  const auto& limits = comparison.limit.rows;
  if (i >= limits.size()) return comparison.limit.ended.empty() ? "not asked for" : comparison.limit.ended;
  if (!same_contact(discrete, limits[i].end, limits[i].place, body)) {
    return contacts_differ(side, discrete.end, contact_name(side, limits[i].end, limits[i].place, body)) +
           ", however stiff the ground";
  }
  if (sticks_in_one_model(scene.world.ground, discrete, limits[i].mode))
    return "static and sliding friction differ; the discrete model has one coefficient";
  if (only_spins(discrete, limits[i].mode))
    return "the face spins about its pressure centre, which the ground's friction holds alone and lets spin";
  if (stops_in_one_model(discrete, limits[i].mode))
    return "slip nearly stops, and stops in one model alone: stiffer ground than doubles resolve would tell";
  return "follows an impact that is not the same in both models";
}

/// Impacts of which a limit can be held against the discrete model: all in the plane, in space those before the first
/// that is open or cannot be predicted, and one at least.
LimitRequest limit_request(const DiscreteSide& side, const Scene& scene) {
  if (!side.in_space) {
    const int listed = static_cast<int>(std::max<std::size_t>(side.impacts.size(), 1));
    return {.impacts = std::isfinite(scene.request.until) ? listed : scene.request.impacts, .planar = true};
  }
  LimitRequest request{.impacts = 0, .planar = false};
  for (const SequenceImpact& impact : side.impacts) {
    if (!has_limit(impact) || !impact.predictable) break;
    request.amplification.push_back(impact.amplification);
    ++request.impacts;
    request.whole_patch = request.whole_patch || impact.is_face;
  }
  if (request.impacts == 0) request = {.impacts = 1, .planar = false, .amplification = {1}};
  return request;
}

/// Largest error of the two models together in a number, relative to its scale; infinite: one is not known.
double largest_error(const Comparison& comparison) {
  double worst = 0;
  for (const ComparedImpact& impact : comparison.impacts) {
    for (const auto& [name, heading, q] : comparison.discrete.quantities) {
      double error = impact.discrete ? impact.discrete_error[q] : 0;
      if (impact.continuous) error += impact.continuous_error[q];
      if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, error / comparison.discrete.scales[q]);
    }
  }
  return worst;
}

std::string shortfall_of(const Comparison& comparison, const Scene& scene) {
  const auto words = [](const char* model, const auto& ended) {
    return fmt::format("{} model: {}: {}", model, outcome_name(ended.outcome), ended.message);
  };
  if (is_cut_short(comparison.discrete.outcome)) return words("discrete", comparison.discrete);
  if (is_cut_short(comparison.run.outcome)) return words("continuous", comparison.run);
  return scene.require_digits ? digits_shortfall(scene.accuracy.digits, largest_error(comparison)) : "";
}

/// The sequence of the body as given and, where the mesh has other corners, that of these.
void find_discrete_sides(Comparison& comparison, const Scene& scene, const numeric::Body& body) {
  DiscreteBody given(scene, body), mesh(body);
  const DiscreteDrop drop = given.drop(scene);
  comparison.approach_speed = first_approach_speed(drop);
  comparison.discrete = discrete_side(scene, given);
  const bool is_same = scene.body.is_polyhedron() || body.smooth();
  if (is_same || !has_other_corners(drop, mesh.drop(scene))) return;
  comparison.as_given = std::move(comparison.discrete);
  comparison.discrete = discrete_side(scene, mesh);
}

/// Whether the same end of the body strikes with the mesh's corners as with the body as given: a level rim is many of
/// those corners.
bool is_same_end(const ComparedImpact& impact) {
  const auto ends = [](std::string names) {
    std::erase(names, ' ');
    return std::set<char>(names.begin(), names.end());
  };
  return ends(impact.as_given_end) == ends(impact.discrete_end);
}

}  // namespace

bool ComparedImpact::lands() const {
  for (std::size_t q = 0; q < motion_number_count; ++q) {
    if (!(std::fabs(limit->value[q] - (*discrete)[q]) <= allowance[q])) return false;
  }
  return true;
}

double ComparedImpact::bars_off() const {
  double worst = 0;
  for (std::size_t q = 0; q < motion_number_count; ++q) {
    const double gap = std::fabs(limit->value[q] - (*discrete)[q]);
    if (gap == 0) continue;
    const double bars = gap / (limit->error[q] + discrete_error[q]);
    if (!(bars <= worst)) worst = std::isnan(bars) ? std::numeric_limits<double>::infinity() : bars;
  }
  return worst;
}

CornersApart Comparison::corners_apart() const {
  CornersApart apart;
  for (const ComparedImpact& impact : impacts) {
    if (!impact.as_given || !impact.discrete || !is_same_end(impact)) break;
    ++apart.same_count;
    for (const auto& [name, heading, q] : discrete.quantities) {
      const double off = std::fabs((*impact.discrete)[q] - (*impact.as_given)[q]) / discrete.scales[q];
      if (!(off <= apart.largest)) apart = {off, impact.n, heading, apart.same_count};
    }
  }
  return apart;
}

bool Comparison::has_content() const {
  return std::any_of(impacts.begin(), impacts.end(),
                     [](const ComparedImpact& impact) { return impact.has_limit() || impact.reason.empty(); });
}

bool Comparison::agrees() const {
  return std::all_of(impacts.begin(), impacts.end(),
                     [](const ComparedImpact& impact) { return !impact.has_landing() || impact.lands(); });
}

Comparison compare_models(const Scene& scene, const numeric::Body& body) {
  Comparison comparison;
  find_discrete_sides(comparison, scene, body);
  const DiscreteSide& side = comparison.discrete;
  numeric::Request request = scene.request;
  request.amplification = true;
  numeric::Accuracy accuracy = scene.accuracy;
  accuracy.evaluation_limit = std::min(accuracy.evaluation_limit, evaluations_per_run);
  comparison.run = numeric::simulate(body, scene.world, scene.start(body), request, accuracy);
  comparison.limit = stiff_limit(scene, body, limit_request(side, scene));

  std::vector<double> contact_times;
  for (const ImpactRecord& record : comparison.run.impacts) contact_times.push_back(record.value.duration);
  const std::vector<PredictedSize> predicted = side.predict(contact_times);
  const std::size_t count = std::max(side.impacts.size(), comparison.run.impacts.size());
  std::string first_reason;
  for (std::size_t i = 0; i < count; ++i) {
    add_impact(comparison, body, i);
    ComparedImpact& impact = comparison.impacts.back();
    if (i < predicted.size()) {
      impact.predicted = predicted[i];
      impact.predicted.tipping = side.impacts[i].tipping;
    }
    impact.reason =
        first_reason.empty() ? reason_against(comparison, scene, body, i) : "follows an impact that cannot be compared";
    if (first_reason.empty()) first_reason = impact.reason;
  }
  drop_unlike_limits(comparison, scene);
  for (std::size_t i = 0; side.in_space && i < count; ++i)
    comparison.impacts[i].explanation = explanation_of(comparison, scene, body, i);
  comparison.parted = parted_blows(side, comparison.run.impacts, body);
  comparison.shortfall = shortfall_of(comparison, scene);
  comparison.other_law = other_law_words(scene, comparison.approach_speed);
  return comparison;
}

}  // namespace clatter::validation

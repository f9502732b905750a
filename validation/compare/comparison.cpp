#include "validation/compare/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

#include "analytic/impact_limits.hpp"
#include "validation/output/number.hpp"
#include "validation/plan/shortfall.hpp"
#include "validation/record/names.hpp"
#include "validation/scene/discrete_scene.hpp"

namespace clatter::validation {
namespace {

using analytic::ImpactMode;
using analytic::ImpactRow;
using numeric::ImpactRecord;

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double bars_apart =
    5;  // a bar holds in all but some of a hundred numbers; a model that is wrong misses by many
constexpr long evaluations_per_run = 300'000;  // a contact that takes more is none that the discrete model knows

/// End of the continuous model's kind: by the side of the body that the vertices are on.
std::string end_of(const analytic::PlanarBody& body, const ImpactRow& row) {
  bool left = false, right = false;
  for (int i = 0; i < body.vertex_count; ++i) {
    if (!(row.vertices >> i & 1)) continue;
    (body.vertices[static_cast<std::size_t>(i)].x < 0 ? left : right) = true;
  }
  return left && right ? "both" : left ? "a" : "b";
}

bool jams(const Comparison& comparison, const ImpactRow& row) {
  if (comparison.drop.law.friction != analytic::FrictionKind::coulomb || std::popcount(row.vertices) != 1) return false;
  const analytic::ContactPoint d = comparison.drop.body.contact_point(
      std::countr_zero(row.vertices), std::sin(row.inclination), std::cos(row.inclination));
  const double limit = analytic::jamming_ratio(contact_inertia(comparison.drop.body.gyration_square, d));
  return comparison.drop.law.friction_value >= std::fabs(limit);
}

/// Whether an impact ended in stick.
bool sticks(ImpactMode mode) { return mode == ImpactMode::stick || mode == ImpactMode::slip_stick; }
bool sticks(numeric::FrictionMode mode) {
  return mode == numeric::FrictionMode::stick || mode == numeric::FrictionMode::slip_stick;
}

/// Whether an impact sticks in one model alone because the discrete one has no static coefficient of its own.
bool sticks_in_one_model(const numeric::Ground& ground, ImpactMode discrete, numeric::FrictionMode continuous) {
  return ground.static_friction != ground.sliding_friction && sticks(discrete) != sticks(continuous);
}

/// The body lies flat or stands upright as it lands.
bool is_face(const ImpactRow& row) {
  constexpr double square = 1e-12;  // [rad]
  return row.contact_angle < square || row.contact_angle > analytic::pi / 2 - square;
}

/// A whole face lands while it turns or slides.  Where along the face the ground then presses decides the rebound,
/// which impulses at corners do not know; only a face that lands at rest against the ground has one answer.
bool is_open_face(const ImpactRow& row) {
  return is_face(row) && (row.before.angular != 0 || row.impact.tangential_impulse != 0);
}

/// Why row i cannot be compared at any stiffness; empty if it can.
std::string reason_in_principle(const Comparison& comparison, std::size_t i) {
  const auto& rows = comparison.sequence.rows;
  if (i >= rows.size()) return "";
  if (is_open_face(rows[i])) {
    return "a whole face lands turning or sliding: its rebound depends on where along it the ground presses";
  }
  if (std::any_of(rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(i), is_face)) {
    return "follows the landing of a whole face: rounding decides how it lands again";
  }
  return "";
}

/// Why row i cannot be compared at the scene's stiffness; empty if it can.
std::string reason_against(const Comparison& comparison, const Scene& scene, std::size_t i) {
  const auto& rows = comparison.sequence.rows;
  const auto& impacts = comparison.run.impacts;
  if (i >= rows.size()) return "the discrete sequence has ended: " + comparison.sequence.message;
  if (i >= impacts.size()) return "the continuous run has ended: " + comparison.run.message;
  if (const std::string reason = reason_in_principle(comparison, i); !reason.empty()) return reason;
  const ImpactRecord& record = impacts[i];
  const std::string end = end_of(comparison.drop.body, rows[i]);
  if (!record.predictable) {
    return fmt::format("beyond the predictable: out of its plane an error of the start has grown {} times",
                       significant(record.amplification, 2));
  }
  if (!(rows[i].amplification * epsilon <= 0.01))
    return "beyond the predictable: an error of the start has grown too far";
  if (record.touches > 1 && end != "both") return "another place touches before the first contact has ended";
  if (jams(comparison, rows[i])) return "jamming: friction beyond Painlevé's limit drives the contact into the ground";
  if (end != end_name(record.end))
    return fmt::format("end {} strikes in one model, end {} in the other", end, end_name(record.end));
  if (sticks_in_one_model(scene.ground, rows[i].impact.mode, record.mode)) {
    return "static and sliding friction differ; the discrete model has one coefficient";
  }
  const Quantities size = comparison.impacts[i].predicted.total();
  if (!std::isfinite(size[0] + size[1] + size[2])) {
    return "the contacts last too long: within what they leave open another sequence follows";
  }
  return "";
}

/// |limit − discrete| that error bars and the rounding of the discrete model leave open.
Quantities allowance(const ComparedImpact& impact, const ImpactRow& row, const Quantities& scales) {
  Quantities sum{};
  const double growth = std::isfinite(row.amplification) ? row.amplification : 1;
  for (std::size_t q = 0; q < quantity_count; ++q) {
    sum[q] = bars_apart * impact.limit->error[q] + 8 * epsilon * (1 + growth) * scales[q];
  }
  return sum;
}

/// The estimates, unknown in a row that cannot be predicted.
Quantities error_of(const ImpactRecord& record) {
  Quantities error = in_plane(motion_errors(record));
  if (!record.predictable) error.fill(std::numeric_limits<double>::infinity());
  return error;
}

void add_impact(Comparison& comparison, std::size_t i, const std::vector<PredictedSize>& predicted) {
  const auto& rows = comparison.sequence.rows;
  const auto& records = comparison.run.impacts;
  ComparedImpact impact{.n = static_cast<int>(i) + 1,
                        .reason = {},
                        .discrete = {},
                        .continuous = {},
                        .discrete_error = {},
                        .continuous_error = {},
                        .discrete_end = {},
                        .continuous_end = {},
                        .predicted = {},
                        .limit = {}};
  if (i < rows.size()) {
    impact.discrete = in_plane(motion_numbers(rows[i]));
    impact.discrete_error = in_plane(motion_errors(rows[i]));
    impact.discrete_end = end_of(comparison.drop.body, rows[i]);
  }
  if (i < records.size()) {
    impact.continuous = in_plane(motion_numbers(records[i]));
    impact.continuous_error = error_of(records[i]);
    impact.continuous_end = end_name(records[i].end);
    impact.contact_time = records[i].value.duration;
  }
  if (i < predicted.size()) impact.predicted = predicted[i];
  const auto& limits = comparison.limit.rows;
  if (i < limits.size() && i < rows.size() && impact.discrete_end == end_name(limits[i].end) &&
      reason_in_principle(comparison, i).empty()) {
    impact.limit = limits[i];
    impact.allowance = allowance(impact, rows[i], comparison.scales);
  }
  comparison.impacts.push_back(impact);
}

/// The stiff limit holds the friction of the sequence: with two coefficients it may stick where the discrete model
/// slips, and is then no limit of it.
void drop_unlike_limits(Comparison& comparison, const Scene& scene) {
  bool alike = true;
  for (std::size_t i = 0; i < comparison.impacts.size(); ++i) {
    ComparedImpact& impact = comparison.impacts[i];
    if (impact.limit &&
        sticks_in_one_model(scene.ground, comparison.sequence.rows[i].impact.mode, impact.limit->mode)) {
      alike = false;
    }
    if (!alike) impact.limit.reset();
  }
}

/// Largest error of the two models together in a number, relative to its scale; infinite: one is not known.
double largest_error(const Comparison& comparison) {
  double worst = 0;
  for (const ComparedImpact& impact : comparison.impacts) {
    for (std::size_t q = 0; q < quantity_count; ++q) {
      double error = impact.discrete ? impact.discrete_error[q] : 0;
      if (impact.continuous) error += impact.continuous_error[q];
      if (!std::isfinite(error)) return std::numeric_limits<double>::infinity();
      worst = std::max(worst, error / comparison.scales[q]);
    }
  }
  return worst;
}

std::string shortfall_of(const Comparison& comparison, const Scene& scene) {
  const auto words = [](const char* model, const auto& ended) {
    return fmt::format("{} model: {}: {}", model, outcome_name(ended.outcome), ended.message);
  };
  if (is_cut_short(comparison.sequence.outcome)) return words("discrete", comparison.sequence);
  if (is_cut_short(comparison.run.outcome)) return words("continuous", comparison.run);
  return scene.require_digits ? digits_shortfall(scene.options.digits, largest_error(comparison)) : "";
}

}  // namespace

bool ComparedImpact::lands() const {
  for (std::size_t q = 0; q < quantity_count; ++q) {
    if (!(std::fabs(limit->value[q] - (*discrete)[q]) <= allowance[q])) return false;
  }
  return true;
}

bool Comparison::has_content() const {
  return std::any_of(impacts.begin(), impacts.end(),
                     [](const ComparedImpact& impact) { return impact.has_landing() || impact.reason.empty(); });
}

bool Comparison::agrees() const {
  return std::all_of(impacts.begin(), impacts.end(),
                     [](const ComparedImpact& impact) { return !impact.has_landing() || impact.lands(); });
}

Comparison compare_models(const Scene& scene, const numeric::Body& body) {
  Comparison comparison{
      .drop = discrete_drop(scene, body), .sequence = {}, .run = {}, .limit = {}, .impacts = {}, .shortfall = {}};
  comparison.sequence = impact_sequence(comparison.drop, {.impacts = scene.options.impacts});
  numeric::Options options = scene.options;
  options.amplification = true;
  options.history = nullptr;
  options.evaluation_limit = std::min(options.evaluation_limit, evaluations_per_run);
  comparison.run = numeric::simulate(body, scene.ground, scene.start(body), options);
  comparison.limit = stiff_limit(scene, body, scene.options.impacts);
  comparison.scales = quantity_scales(comparison.sequence, comparison.drop.body);

  std::vector<double> contact_times;
  for (const ImpactRecord& record : comparison.run.impacts) contact_times.push_back(record.value.duration);
  const auto predicted = predicted_sizes(comparison.drop, comparison.sequence, contact_times);
  const std::size_t count = std::max(comparison.sequence.rows.size(), comparison.run.impacts.size());
  std::string first_reason;
  for (std::size_t i = 0; i < count; ++i) {
    add_impact(comparison, i, predicted);
    ComparedImpact& impact = comparison.impacts.back();
    impact.reason =
        first_reason.empty() ? reason_against(comparison, scene, i) : "follows an impact that cannot be compared";
    if (first_reason.empty()) first_reason = impact.reason;
  }
  drop_unlike_limits(comparison, scene);
  comparison.shortfall = shortfall_of(comparison, scene);
  return comparison;
}

}  // namespace clatter::validation

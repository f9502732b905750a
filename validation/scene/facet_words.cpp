// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/scene/facet_words.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

/// The error of an impact, as a part of its numbers.
std::string facet_part(double inside, const numeric::ImpactRecord& row) {
  const double part = inside / row.value.indentation;
  return part < 1 ? shortest(rounded_up(100 * part)) + " %" : "all";
}

}  // namespace

/// R (1 − cos(π/n)) beside a rod's axis; a sphere's facet spans a cap in which one meridian's cosine is added as a
/// factor. What maps a unit ball to an ellipsoid stretches no distance by more than its longest semiaxis.
double facet_depth(const BodyScene& body) {
  if (body.shape == BodyScene::Shape::box || body.shape == BodyScene::Shape::mesh || body.is_smooth()) return 0;
  const double around = std::cos(std::numbers::pi / body.meshed_sectors());
  if (body.shape == BodyScene::Shape::rod) return body.meshed_radius() * (1 - around);
  const double along = std::cos(std::numbers::pi / (4 * body.meshed_rings()));
  const double radius = body.has_size() ? body.size.maxCoeff() / 2 : body.meshed_radius();
  return radius * (1 - around * along);
}

std::string facet_words(const Scene& scene, const numeric::Simulation& run) {
  const double inside = facet_depth(scene.body);
  if (!(inside > 0)) return "";
  std::string words = fmt::format("facets: up to {} m inside the round surface", shortest(rounded_up(inside)));
  if (run.impacts.empty()) return words;
  const auto shallowest =
      std::ranges::min_element(run.impacts, {}, [](const numeric::ImpactRecord& row) { return row.value.indentation; });
  words += fmt::format("; the round body's depth, time, force and change of velocity may differ by {} in impact 1",
                       facet_part(inside, run.impacts.front()));
  const auto impact = shallowest - run.impacts.begin() + 1;
  return impact == 1 ? words : words + fmt::format(", {} in impact {}", facet_part(inside, *shallowest), impact);
}

}  // namespace clatter::validation

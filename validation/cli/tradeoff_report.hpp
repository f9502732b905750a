// Cost against error as a table, as JSON, as a picture.
#pragma once

#include "validation/figures/picture.hpp"
#include "validation/output/json.hpp"
#include "validation/output/table.hpp"
#include "validation/tradeoff/tradeoff.hpp"

namespace clatter::validation {

/// The front of points that nothing beats in both cost and error, and what failed.
[[nodiscard]] Table tradeoff_table(const Scene& scene, const Tradeoff& tradeoff);
/// All points.
[[nodiscard]] Table tradeoff_records(const Scene& scene, const Tradeoff& tradeoff);
[[nodiscard]] Json tradeoff_json(const Scene& scene, const Tradeoff& tradeoff);
/// Error over cost, one curve for each model and method.
[[nodiscard]] Picture tradeoff_picture(const Scene& scene, const Tradeoff& tradeoff);

}  // namespace clatter::validation

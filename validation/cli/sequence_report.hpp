// An impact sequence as a table and as JSON.
#pragma once

#include <string>
#include <vector>

#include "analytic/sequence.hpp"
#include "validation/output/json.hpp"
#include "validation/output/table.hpp"
#include "validation/scene/scene.hpp"

namespace clatter::validation {

[[nodiscard]] Table sequence_table(const Scene& scene, const analytic::Sequence& sequence);
[[nodiscard]] Json sequence_json(const Scene& scene, const analytic::Sequence& sequence);
/// One row per impact with the JSON's names as columns, vectors spread over three.
[[nodiscard]] Table sequence_records(const Scene& scene, const analytic::Sequence& sequence);

}  // namespace clatter::validation

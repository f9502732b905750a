// The map of extremes as a table, as JSON, as a picture.
#pragma once

#include <string>

#include "validation/extremes/extremes.hpp"
#include "validation/output/json.hpp"
#include "validation/output/table.hpp"

namespace clatter::validation {

/// One row per region; reasons of refusals and how errors were judged as notes.
[[nodiscard]] Table extremes_table(const ExtremesMap& map, Format format);
/// All cells.
[[nodiscard]] Table extremes_records(const ExtremesMap& map);
[[nodiscard]] Json extremes_json(const ExtremesMap& map);
/// SVG: a strip for each quantity and model, its values side by side, coloured by digits, refusals hatched.
[[nodiscard]] std::string extremes_picture(const ExtremesMap& map);

}  // namespace clatter::validation

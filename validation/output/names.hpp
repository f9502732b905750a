// Names that the models' results have in tables, JSON and CSV.
#pragma once

#include "analytic/sequence.hpp"
#include "numeric/impact_record.hpp"

namespace clatter::validation {

[[nodiscard]] const char* mode_name(analytic::ImpactMode mode);
[[nodiscard]] const char* mode_name(numeric::FrictionMode mode);
[[nodiscard]] const char* outcome_name(analytic::Outcome outcome);
[[nodiscard]] const char* outcome_name(numeric::Outcome outcome);
[[nodiscard]] const char* end_name(numeric::ContactEnd end);

}  // namespace clatter::validation

// What `clatter regimes` says.
#pragma once

#include "validation/output/report.hpp"
#include "validation/scene/named_texts.hpp"

namespace clatter::validation {

/// From the flags of `clatter regimes` by name: over, from, to, step, count, log, gravity_number, …, digits.
/// @throws BadInput as the command.
[[nodiscard]] Report regimes_report(const NamedTexts& given);

}  // namespace clatter::validation

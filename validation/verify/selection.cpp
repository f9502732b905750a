// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/verify/selection.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "validation/output/bad_input.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation::inline verify {

CheckSelection select_checks(bool quick, const std::vector<std::string>& only) {
  if (quick && !only.empty()) throw BadInput("--quick: excludes --only; give one of them, not both");
  std::vector<std::string> ids;
  for (const Check& check : all_checks()) ids.push_back(check.id);
  for (const std::string& id : only) static_cast<void>(read_name_option("--only", id, ids));
  CheckSelection selection;
  for (const Check& check : all_checks()) {
    const bool named = std::find(only.begin(), only.end(), check.id) != only.end();
    if (only.empty() ? check.quick || !quick : named) selection.checks.push_back(&check);
  }
  const std::size_t count = selection.checks.size();
  selection.words = only.empty() ? fmt::format("{} set: {} checks of {}", quick ? "quick" : "full", count, ids.size())
                                 : fmt::format("{} checks by name", count);
  return selection;
}

}  // namespace clatter::validation::inline verify

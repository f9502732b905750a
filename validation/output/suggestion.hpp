// SPDX-License-Identifier: GPL-3.0-or-later
// What is said behind a name that is not known.
#pragma once

#include <string>
#include <vector>

namespace clatter::validation {

/// "; did you mean steel?"; where the candidates are few and none is near, these: "; there are steel, wood".
/// @param are_listed  the words before it have the candidates already, however many they are
[[nodiscard]] std::string suggestion(const std::string& name, const std::vector<std::string>& candidates,
                                     bool are_listed = false);

}  // namespace clatter::validation

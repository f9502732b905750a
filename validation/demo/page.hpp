// SPDX-License-Identifier: GPL-3.0-or-later
// The page of `clatter demo`, as the build bundled it.
#pragma once

#include <string_view>

namespace clatter::validation::inline demo {

/// One HTML file with everything in it; empty if the build had no Node.js.
[[nodiscard]] std::string_view demo_page();
/// The requests that the page makes for each scene of an offline copy: {"scenes": [{name, title, parameters, angles,
/// requests: [{path, body, key}]}]}; empty as above.
[[nodiscard]] std::string_view demo_requests();

}  // namespace clatter::validation::inline demo

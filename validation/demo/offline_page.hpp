// SPDX-License-Identifier: GPL-3.0-or-later
// A copy of the page that needs no server.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace clatter::validation::inline demo {

/// Names of the scenes that a copy can hold.
[[nodiscard]] std::vector<std::string> offline_scenes();

/// The page with the answers to all requests that it makes for these scenes, so that it makes none.
/// @param progress called with (done, of); false ends the work.  @return "" if it did.
[[nodiscard]] std::string offline_page(const std::vector<std::string>& scenes,
                                       const std::function<bool(std::size_t, std::size_t)>& progress);

}  // namespace clatter::validation::inline demo

// SPDX-License-Identifier: GPL-3.0-or-later
// The story that the page of `clatter demo` tells by itself, also to a browser without JavaScript.
#pragma once

#include <string>

namespace clatter::validation::inline demo {

/// Five steps as HTML, each a heading, a picture as SVG and a text with the models' numbers: the first blow, the
/// second, the doubling, the fold, a phone.  Computed anew by both models.
[[nodiscard]] std::string story_html();

/// The page with the story in its place.  Empty if the build has no page.
/// @throws std::logic_error if the page has no place for it.
[[nodiscard]] std::string page_with_story();

}  // namespace clatter::validation::inline demo

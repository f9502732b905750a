// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as the page of `clatter demo` shows it.
#pragma once

#include <string>

#include "validation/scene/scene.hpp"

namespace clatter::validation::inline demo {

/// The query of the page's address: "?given=1&body=box&angle=10…", the arguments of the scene.  Numbers are shortest
/// round-trip.  @throws BadInput naming the key where the page cannot show it: a mesh, a sweep.
[[nodiscard]] std::string page_query(const Scene& scene);

}  // namespace clatter::validation::inline demo

// A scene as the page of `clatter demo` shows it.
#pragma once

#include <string>

#include "validation/scene/scene.hpp"

namespace clatter::validation {

/// The query of the page's address: "?body=own-rod&angle=10…".  Numbers are shortest round-trip.
/// @throws BadInput naming the key where the page has no control for it: a mesh, a tilt, a sweep, a tangential velocity
///         or spin, or a friction law other than Coulomb's.
[[nodiscard]] std::string page_query(const Scene& scene);

}  // namespace clatter::validation

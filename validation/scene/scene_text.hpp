// SPDX-License-Identifier: GPL-3.0-or-later
// A scene as others read it again: the keys that it has to say, and the text of a file.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "validation/scene/keys.hpp"

namespace clatter::validation {

/// Keys whose values flags alone would not give, in the order of the echo, but for files; those of the body, gravity
/// and restitution in any case.
[[nodiscard]] std::vector<const Key*> said_keys(const Scene& scene);

/// `head`, then the keys under their tables, each as `line` writes it; `name` is the key's within its table.
[[nodiscard]] std::string scene_text(const std::string& head, const std::vector<const Key*>& keys,
                                     const std::function<std::string(const Key& key, const std::string& name)>& line);

}  // namespace clatter::validation

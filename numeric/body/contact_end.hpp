// SPDX-License-Identifier: GPL-3.0-or-later
// Names of the ends of a body.
#pragma once

namespace clatter::numeric {

/// Which ends of the body touched during an impact: by the sign of x′ of the vertices that went into the ground.
enum class ContactEnd { a, b, both, middle };

}  // namespace clatter::numeric

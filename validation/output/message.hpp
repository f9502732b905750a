// SPDX-License-Identifier: GPL-3.0-or-later
// Words to the user, on stderr.
#pragma once

#include <string>

namespace clatter::validation::inline output {

/// Writes "clatter: WORDS" as one line.  Nobody may be there to read (stderr closed, full or hung up), which changes
/// neither the run nor its status.
void say(const std::string& words);

}  // namespace clatter::validation::inline output

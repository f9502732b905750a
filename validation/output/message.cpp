// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/output/message.hpp"

#include <algorithm>
#include <cstdio>

namespace clatter::validation::inline output {

void say(const std::string& words) {
  std::string line = "clatter: " + words;
  std::replace(line.begin(), line.end(), '\n', ' ');
  line += '\n';
  std::fwrite(line.data(), 1, line.size(), stderr);
}

}  // namespace clatter::validation::inline output

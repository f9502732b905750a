// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter demo` of a build that could not make the page.
#include "validation/cli/command.hpp"
#include "validation/output/bad_input.hpp"

namespace clatter::validation::inline cli {

Command demo_command() {
  Command command{.name = "demo", .help = "a page in the browser (not in this build)"};
  command.run = []() -> int {
    throw BadInput("demo: this build has no page; it needs " CLATTER_DEMO_MISSING ": install and build again");
  };
  return command;
}

}  // namespace clatter::validation::inline cli

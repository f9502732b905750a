// `clatter demo` of a build that could not make the page.
#include <memory>

#include "validation/cli/commands.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {

Action add_demo_command(CLI::App& app) {
  app.add_subcommand("demo", "a page to play with, in the browser (not in this build)");
  return []() -> int {
    throw BadInput("demo: this build has no page; it needs " CLATTER_DEMO_MISSING ": install and build again");
  };
}

}  // namespace clatter::validation

#include "validation/cli/program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <stdexcept>

#include "analytic/errors.hpp"
#include "numeric/errors.hpp"
#include "validation/cli/arguments.hpp"
#include "validation/cli/commands.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/message.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/bad_input.hpp"

namespace clatter::validation {
namespace {

enum Status { done = 0, bad_input = 2, not_computed = 3, outside_model = 4 };

int complain(const std::string& what, Status status) {
  say(what);
  return status;
}

int print_text(const std::string& text) {
  Sink sink("");
  sink.write(text);
  sink.commit();
  return done;
}

int parse_and_run(const std::vector<std::string>& given) {
  CLI::App app("impact sequences of falling rigid bodies", "clatter");
  app.footer("Example: clatter sequence --angle 10\nclatter COMMAND --help tells more.");
  app.set_help_flag("--help", "print this help and exit");
  bool show_version = false;
  app.add_flag("--version", show_version, "print the version and exit");
  std::map<std::string, Action> actions;
  actions["sequence"] = add_sequence_command(app);
  actions["angles"] = add_angles_command(app);
  actions["regimes"] = add_regimes_command(app);
  actions["explain"] = add_explain_command(app);
  actions["simulate"] = add_simulate_command(app);
  actions["compare"] = add_compare_command(app);
  actions["sweep"] = add_sweep_command(app);
  actions["verify"] = add_verify_command(app);
  actions["figures"] = add_figures_command(app);
  actions["plan"] = add_plan_command(app);
  actions["tradeoff"] = add_tradeoff_command(app);
  actions["extremes"] = add_extremes_command(app);
  actions["demo"] = add_demo_command(app);
  actions["completion"] = add_completion_command(app);
  actions["man"] = add_man_command(app);
  std::vector<std::string> arguments = checked_arguments(app, given);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11's parse(vector) wants them
  try {
    app.parse(arguments);
  } catch (const CLI::CallForHelp&) {
    const auto chosen = app.get_subcommands();
    return print_text((chosen.empty() ? &app : chosen[0])->help());
  } catch (const CLI::ParseError& error) {
    throw BadInput(error.what());
  }
  if (show_version) return print_text(fmt::format("clatter {}\n", version));
  const auto chosen = app.get_subcommands();
  if (chosen.empty()) throw BadInput("a command is required; clatter --help lists them");
  return actions.at(chosen[0]->get_name())();
}

}  // namespace

int run_program(const std::vector<std::string>& arguments) {
  try {
    return parse_and_run(arguments);
  } catch (const ReaderGone&) {
    return done;
  } catch (const BadInput& error) {
    return complain(error.what(), bad_input);
  } catch (const numeric::MeshError& error) {
    return complain(error.what(), bad_input);
  } catch (const analytic::NumericalError& error) {
    return complain(error.what(), not_computed);
  } catch (const analytic::OutsideModelError& error) {
    return complain(error.what(), outside_model);
  } catch (const std::logic_error& error) {  // domain_error of the library: a scene it refuses
    return complain(error.what(), bad_input);
  } catch (const std::exception& error) {
    return complain(error.what(), not_computed);
  }
}

}  // namespace clatter::validation

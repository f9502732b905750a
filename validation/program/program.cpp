// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/program/program.hpp"

#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/sink.hpp"
#include "validation/scene/failure.hpp"

namespace clatter::validation {
namespace {

int parse_and_run(const std::vector<Command>& commands, const std::vector<std::string>& given) {
  const ParsedLine line = parse_line(commands, given);
  if (line.command && !line.command->run)
    throw BadInput(line.command->name + ": is a command of the whole program, which this one comes before");
  int status = 0;
  if (line.command) status = line.command->run();
  else write_out({}, line.text);
  if (!line.note.empty()) say(line.note);
  return status;
}

}  // namespace

int guarded(const std::function<int()>& run) {
  try {
    return run();
  } catch (const ReaderGone&) {
    return 0;
  } catch (const LeftToNextProgram&) {
    return 75;
  } catch (...) {
    const Failure failure = current_failure();
    say(failure.message);
    return exit_status(failure.kind);
  }
}

int run_program(const std::vector<Command>& commands, const std::vector<std::string>& arguments) {
  const NotedFiles noted;
  return guarded([&] { return parse_and_run(commands, arguments); });
}

}  // namespace clatter::validation

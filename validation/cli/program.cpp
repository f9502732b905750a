#include "validation/cli/program.hpp"

#include <stdexcept>

#include "analytic/errors.hpp"
#include "numeric/errors.hpp"
#include "validation/cli/commands.hpp"
#include "validation/cli/parser.hpp"
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

int parse_and_run(const std::vector<std::string>& given) {
  const ParsedLine line = parse_line(all_commands(), given);
  if (line.command) return line.command->run();
  Sink sink("");
  sink.write(line.text);
  sink.commit();
  return done;
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

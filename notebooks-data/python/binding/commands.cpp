// SPDX-License-Identifier: GPL-3.0-or-later
// Commands of the program that Python calls by their arguments.
#include <pybind11/stl.h>

#include <map>

#include "binding.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/program/program.hpp"

namespace clatter::python {
namespace {

namespace py = pybind11;
using validation::Command;

/// The commands that functions are named after.
const std::map<std::string, Command (*)()>& commands() {
  static const std::map<std::string, Command (*)()> all{
      {"atlas", validation::atlas_command},       {"compare", validation::compare_command},
      {"explain", validation::explain_command},   {"gradient", validation::gradient_command},
      {"ground", validation::ground_command},     {"map", validation::map_command},
      {"plan", validation::plan_command},         {"report", validation::report_command},
      {"sequence", validation::sequence_command}, {"shock", validation::shock_command},
      {"simulate", validation::simulate_command}, {"sweep", validation::sweep_command},
      {"tradeoff", validation::tradeoff_command}};
  return all;
}

/// @throws BadInput for a name that none has
Command made(const std::string& name) {
  Command command = validation::named(commands(), name)();
  command.name = name;
  return command;
}

std::map<std::string, std::vector<std::string>> command_options() {
  std::map<std::string, std::vector<std::string>> options;
  for (const auto& [name, make] : commands()) options[name] = make().option_names();
  return options;
}

/// (report or None, what it says beside that: why it falls short)
py::tuple run_command(const std::string& name, const std::vector<std::string>& words) {
  const auto work = [name, words](const Watch&) {
    const std::vector<Command> commands{made(name)};
    std::vector<std::string> line{name};
    line.insert(line.end(), words.begin(), words.end());
    validation::Caught<validation::Report> caught;
    validation::Caught<std::string> said;
    parse_line(commands, line).command->run();
    return std::pair(std::move(caught.all), std::move(said.all));
  };
  auto [reports, said] = run_interruptible(work);
  return py::make_tuple(reports.empty() ? py::none() : py::cast(kept(std::move(reports.back()))), said);
}

}  // namespace

void add_commands(py::module_& module) {
  module.def("run_command", &run_command, py::arg("name"), py::arg("words"),
             "What a command says, and what it says beside that.");
  module.def("command_options", &command_options, "The options that each command has.");
}

}  // namespace clatter::python

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

/// @throws BadInput for a name that none has
Command made(const std::string& name) {
  static const std::map<std::string, Command (*)()> commands{{"atlas", validation::atlas_command},
                                                             {"ground", validation::ground_command},
                                                             {"map", validation::map_command},
                                                             {"report", validation::report_command},
                                                             {"shock", validation::shock_command}};
  Command command = validation::named(commands, name)();
  command.name = name;
  return command;
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
}

}  // namespace clatter::python

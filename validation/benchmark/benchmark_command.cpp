// SPDX-License-Identifier: GPL-3.0-or-later
// `clatter benchmark list|show|truth|score`: problems with certified answers, and others' answers to them.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "validation/benchmark/benchmark_report.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/scene/failure.hpp"
#include "validation/scene/option_values.hpp"

namespace clatter::validation {
namespace {

struct BenchmarkInput {
  std::string action;
  std::vector<std::string> names;
  std::string law, problem;
  ColumnNames columns;
  std::optional<Requirement> require;
  bool details = false;
  OutputChoice output;
  PlotChoice plot;
};

void only_for(bool is_given, const char* option, const char* action, bool is_used) {
  if (is_given && !is_used) throw BadInput(fmt::format("{}: only for benchmark {}", option, action));
}

const Problem& named_problem(const BenchmarkInput& input) {
  if (input.names.size() != 1) {
    throw BadInput(
        fmt::format("benchmark {}: needs the ID of one problem; clatter benchmark list names them", input.action));
  }
  return problem_named("benchmark " + input.action, input.names.front());
}

int run_list(const BenchmarkInput& input) {
  if (!input.names.empty()) throw BadInput("benchmark list: takes no names");
  if (input.output.style.format == Format::table) write_out(input.output, benchmark_list_text());
  else write_report(input.output, benchmark_list_report());
  return 0;
}

int run_show(const BenchmarkInput& input) {
  const Problem& problem = named_problem(input);
  const bool in_markdown = input.output.style.format == Format::markdown;
  write_report(input.output, in_markdown ? markdown_statement(problem) : benchmark_statement(problem));
  return 0;
}

int run_truth(const BenchmarkInput& input) {
  const Problem& problem = named_problem(input);
  const std::vector<std::string> laws = truth_laws(problem);
  std::string law = laws.front();
  if (law != "any" && !input.law.empty()) law = input.law;
  write_report(input.output, benchmark_truth_report(problem, law));
  return 0;
}

/// Judges what can be read of the files.
void judge_all(const BenchmarkInput& input, std::vector<Submission>& submissions, std::vector<UnreadFile>& unread) {
  Progress progress;
  const std::size_t of = input.names.size();
  for (std::size_t i = 0; i < of; ++i) {
    if (of > 1) progress.show(progress_bar(i, of) + " files" + progress.time_left(i, of));
    try {
      submissions.push_back(judge_file(input.names[i], input.problem, input.columns));
    } catch (const BadInput& error) {
      unread.push_back({input.names[i], error.what()});
    }
  }
}

int run_score(const BenchmarkInput& input) {
  if (input.names.empty()) throw BadInput("benchmark score: needs a FILE or more");
  const Requirement requirement = input.require.value_or(Requirement{});
  PlotFile plot(input.plot);
  if (!input.problem.empty()) static_cast<void>(problem_named("--problem", input.problem));
  std::vector<Submission> submissions;
  std::vector<UnreadFile> unread;
  judge_all(input, submissions, unread);
  bool is_met = true;
  for (const Submission& one : submissions) is_met = meets(one, requirement) && is_met;
  for (const UnreadFile& one : unread) say(one.reason);
  if (submissions.empty()) return exit_status(FailureKind::bad_input);
  name_apart(submissions);
  Report report = score_report("benchmark", submissions, input.details);
  if (!unread.empty()) add_unread(unread, report);
  write_report(input.output, report);
  const Picture picture = score_picture(submissions);
  plot.write(picture, {"clatter benchmark score: " + picture.what});
  if (!unread.empty()) return exit_status(FailureKind::bad_input);
  return is_met ? 0 : check_failed;
}

int run_benchmark(const BenchmarkInput& input) {
  const std::vector<std::string> actions{"list", "show", "truth", "score"};
  if (input.action == "export" || input.action == "describe")
    throw BadInput(
        fmt::format("benchmark '{}': must be one of {}; did you mean show?", input.action, fmt::join(actions, ", ")));
  const std::size_t action = read_name_option("benchmark", input.action, actions);
  only_for(!input.law.empty(), "--law", "truth", action == 2);
  only_for(!input.columns.empty(), "--columns", "score", action == 3);
  only_for(!input.problem.empty(), "--problem", "score", action == 3);
  only_for(input.require.has_value(), "--require", "score", action == 3);
  only_for(input.details, "--details", "score", action == 3);
  only_for(!input.plot.path.empty(), "--plot", "score", action == 3);
  check_files(input.output, plot_files(input.plot));
  switch (action) {
    case 0: return run_list(input);
    case 1: return run_show(input);
    case 2: return run_truth(input);
    default: return run_score(input);
  }
}

}  // namespace

Command benchmark_command() {
  return command_of<BenchmarkInput>(run_benchmark, [](Command& command, BenchmarkInput& input) {
    command.add({.name = "ACTION",
                 .target = &input.action,
                 .type = "list|show|truth|score",
                 .help = "name the problems, state one, its truth, or score files",
                 .required = true});
    command.add({.name = "NAME", .target = &input.names, .type = "FILE", .help = "ID of a problem, or files to score"});
    command.add(read_argument("--law", input.law, read_law, "LAW",
                              "of truth: newton|poisson|stronge, then routh|moreau (newton routh)"));
    command.add(read_argument("--columns", input.columns, read_column_names, "NAME=COLUMN,...",
                              "what the files to score call their columns"));
    command.add_text("--problem", input.problem, "ID", "of the files to score, in place of their lines # problem:");
    command.add(read_argument("--require", input.require, read_requirement, "CLASS",
                              "exact|sharp|good|coarse|incomplete, or a largest error of complete answers: exit status "
                              "1 where a file does worse"));
    command.add_flag("--details", input.details, "of several files to score: all errors, causes and findings of each");
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter benchmark score rod-10.csv --require good\n"
        "Files are CSV, t,x,z,phi,vx,vz,omega of the centre of mass (floor z = 0, phi and omega counter-clockwise), "
        "in space t,x,y,z,q0,q1,q2,q3,vx,vy,vz,wx,wy,wz, or impacts t,place,Pn,Pt,V,Omega, in space "
        "t,place,Px,Py,Pz,Vx,Vy,Vz,Wx,Wy,Wz (velocities after each, as clatter benchmark truth has them), after lines "
        "# problem: ID, and as they apply # engine:, # version:, # step:, # settings:, # law:, "
        "# Omega: clockwise|counter-clockwise (of lists), # ended: nothing approaches, # energy: J.\n"
        "A list may have derivatives, too: dV/dangle, dt/drestitution and the like, per radian, of the angle, speed, "
        "restitution, friction, in space the tilt; none where there is none, as at a fold.";
    command.columns = {{"benchmark-list", benchmark_list_columns},
                       {"benchmark-truth", benchmark_truth_columns},
                       {"benchmark-score", score_columns}};
  });
}

}  // namespace clatter::validation

// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "validation/command/command.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/gnuplot.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/sink.hpp"
#include "validation/report/page.hpp"

namespace clatter::validation {
namespace {

/// @throws BadInput for what is no date
void require_date(const std::string& text) {
  int year = 0, month = 0, day = 0, length = 0;
  const bool is_read = std::sscanf(text.c_str(), "%4d-%2d-%2d%n", &year, &month, &day, &length) == 3;
  const std::chrono::year_month_day date{std::chrono::year{year}, std::chrono::month{static_cast<unsigned>(month)},
                                         std::chrono::day{static_cast<unsigned>(day)}};
  if (!text.empty() && !(is_read && text.size() == 10 && length == 10 && date.ok()))
    throw BadInput(fmt::format("--date '{}': must be a date, YYYY-MM-DD", text));
}

using Form = ReportInput::Form;

/// What a file beside --output has, by its ending.
Form form_of(const std::string& path) {
  for (const auto& [ending, form] : {std::pair{".html", Form::html},
                                     {".csv", Form::csv},
                                     {".json", Form::json},
                                     {".md", Form::markdown},
                                     {".txt", Form::table}}) {
    if (path.ends_with(ending)) return form;
  }
  throw BadInput(fmt::format("--also '{}': must end in .html, .csv, .json, .md or .txt", path));
}

/// What a run of the command writes.
class Written {
 public:
  explicit Written(const ReportInput& input) : input_(input) {
    const bool is_page = input.form == Form::html;
    if (input.is_short && !is_page) throw BadInput("--short: is of the page; leave out --format");
    if (is_page && input.output.empty()) throw BadInput("--output: required, the page's file");
    if (is_page && !input.output.ends_with(".html"))
      throw BadInput(fmt::format("--output '{}': must end in .html", input.output));
    files_.push_back({{"--output", input.output}, input.form, input.is_short});
    for (const std::string& path : input.further) files_.push_back({{"--also", path}, form_of(path), true});
    if (input.row_form != ReportInput::RowForm::by_itself &&
        std::ranges::all_of(files_, [](const File& one) { return one.form == Form::html || one.form == Form::json; }))
      throw BadInput("--rows attitude: is of --format table, csv or markdown; the page has them");
    for (const File& one : files_) {
      note_written(one.file);
      require_writable(one.file);
      if (one.form == Form::html) require_gnuplot("report");
    }
  }

  /// What there is: of fewer cases than were asked for, marked as that, in files beside those that were asked for.
  void write(const std::vector<ReportCase>& cases, std::size_t asked, const Attitudes& attitudes) const {
    const std::vector<const ReportCase*> order = ranked(cases);
    const bool is_one = cases.size() == 1;
    const Report report = is_one ? cases.front().found.report : joined_report(order);
    const std::string lack =
        cases.size() < asked ? fmt::format("INCOMPLETE: interrupted after {} of {} cases", cases.size(), asked) : "";
    const auto path_of = [&](const RunFile& file) {
      const bool is_file = !file.path.empty() && !destination_of(file).is_stream;
      return file.path + (is_file && !lack.empty() ? ".part" : "");
    };
    Report rows = report;
    if (!lack.empty()) {
      rows.head.insert(rows.head.begin(), lack);
      rows.remarks.insert(rows.remarks.begin(), lack);
      rows.fields["incomplete"] = lack;
    }
    if (input_.row_form == ReportInput::RowForm::attitude) rows.grid = attitudes_of_cases(order);
    for (const File& one : files_) {
      constexpr Format formats[]{Format::json, Format::table, Format::csv, Format::json, Format::markdown};
      const TextStyle style{.format = formats[static_cast<std::size_t>(one.form)], .bare = input_.is_bare};
      if (&one == &files_.front() && one.form != Form::html) {
        write_report({style, path_of(one.file)}, rows);
        continue;
      }
      Sink sink(path_of(one.file), one.file.option);
      sink.write(one.form == Form::html ? page_of(cases.front(), order, report, attitudes, one.is_short, lack)
                                        : report_text(rows, style));
      sink.commit();
    }
    const std::string found = is_one ? cases.front().found.lead : report.notes.front();
    if (!input_.output.empty())
      say(fmt::format("{}: {}{}", path_of(files_.front().file), lack.empty() ? "" : lack + ": ", found));
    else if (!lack.empty()) say(lack);
  }

 private:
  struct File {
    RunFile file;
    Form form = Form::html;
    bool is_short = false;
  };
  const ReportInput& input_;
  std::vector<File> files_;
};

/// Tells how long the other cases are going to take, where that is long, by the mean of those that ran: of drops, which
/// parts of one scene share, and of worst drops' runs, which each case has [s].  With other friction or another floor
/// one takes many times what another takes, so that it tells it again where it was much too low.
class Forecast {
 public:
  Forecast(const std::vector<ReportCase>& cases, std::ptrdiff_t sweeps) : sweeps_(sweeps), cases_(cases.size()) {
    std::set<std::string> parts;
    for (const ReportCase& one : cases) {
      parts.insert(one.part_name);
      for (const auto& [key, value] : one.varied)
        is_guess_ = is_guess_ || std::string_view(key->name).ends_with("_friction");
    }
    if (parts.size() > 1) of_parts_ = fmt::format(" of {} parts", parts.size());
  }
  void add_sweep(double seconds) {
    sweep_ += seconds;
    ++swept_;
  }
  void add_run(double seconds) {
    run_ += seconds;
    ++done_;
    constexpr double long_wait = 20, much = 1.5;
    const double left =
        static_cast<double>(sweeps_ - swept_) * sweep_ / static_cast<double>(std::max<std::ptrdiff_t>(swept_, 1)) +
        static_cast<double>(cases_ - done_) * run_ / static_cast<double>(done_);
    const double all = sweep_ + run_ + left;
    if (left < long_wait || all < much * told_ || shows_progress()) return;
    told_ = all;
    say(fmt::format("{} of {} cases{} took {:.0f} s: {}{}; fewer --drops and --no-sensitivity are faster", done_,
                    cases_, of_parts_, sweep_ + run_, time_left(left),
                    is_guess_ ? ", a guess, as friction decides how long each takes" : ""));
  }

 private:
  std::ptrdiff_t sweeps_ = 0, swept_ = 0;
  std::size_t cases_ = 0, done_ = 0;
  double sweep_ = 0, run_ = 0, told_ = 0;
  bool is_guess_ = false;
  std::string of_parts_;
};

int run_report(const ReportInput& input) {
  require_date(input.date);
  const Written written(input);
  const CooperativeInterrupt interrupt;
  Attitudes attitudes;
  attitudes.drops = input.drops.value_or(attitudes.drops);
  attitudes.scatter = input.scatter.value_or(attitudes.scatter);
  std::vector<ReportCase> cases = cases_of(input);
  const auto sweeps =
      std::ranges::count_if(cases, [](const ReportCase& one) { return one.begins_sweep && looks_at_all(one.input); });
  RunProgress progress(0, sweeps * attitudes.drops, "drops");
  std::optional<AttitudeSweep> swept;
  long long before = 0;
  int status = 0;
  std::size_t done = 0;
  Forecast forecast(cases, sweeps);
  const auto seconds = [begin = std::chrono::steady_clock::now()] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  };
  for (ReportCase& one : cases) {
    const double begin = seconds();
    if (!looks_at_all(one.input)) {
      swept.reset();
    } else if (one.begins_sweep) {
      swept = sweep_attitudes(one.input, attitudes, one.swept_with, progress, before, interrupt);
      if (!swept) break;
      before += attitudes.drops;
      forecast.add_sweep(seconds() - begin);
    }
    const double swept_at = seconds();
    auto found = findings_of(one.input, one.given, one.is_turned, swept ? &*swept : nullptr, one.view, interrupt);
    if (!found) break;
    one.found = std::move(*found);
    ++done;
    forecast.add_run(seconds() - swept_at);
    status = std::max(status, status_of(one.found.scene, one.found.run));
  }
  const std::size_t asked = cases.size();
  cases.erase(cases.begin() + static_cast<std::ptrdiff_t>(done), cases.end());
  if (done > 0) written.write(cases, asked, attitudes);
  return done < asked ? interrupted_status : status;
}

}  // namespace

Command report_command() {
  return command_of<ReportInput>(run_report, [](Command& command, ReportInput& input) {
    add_shock_options(command, input);
    Argument& scenes = *std::ranges::find(command.arguments, "SCENE", &Argument::name);
    scenes.target = &input.scenes;
    scenes.help += "; of several, floors say, a part for each";
    constexpr const char* group = "Worst attitudes";
    command.add(whole_argument("--drops", input.drops, 0, 1'000'000, "N",
                               "of a box, over its faces, edges and corners (260); 0: none", group));
    command.add(number_argument("--scatter", input.scatter, {0, 180, false, "from 0 to 180 degrees"}, "DEG",
                                "standard deviation of their turns about each axis (3)", group));
    command.add_text(
        "--rank-by", input.rank_by, "COLUMN",
        "of clatter sweep's rows, by which they are ranked (the first probe's margin, else peak or change of velocity; "
        "without loss that of the first landing)",
        group);
    command.add(threads_argument(input.threads, "for them (all cores)", group));
    command.add(choice_argument("--rows", input.row_form, {"auto", "attitude"},
                                "of table and CSV: of several cases one each, or attitude: each face, edge and corner "
                                "of each, behind its scene, e and part (auto)",
                                "Output"));
    command.add_flag("--short", input.is_short, "the page has the answers, the table of cases and a drawing each",
                     "Output");
    command.add_text("--title", input.title, "TEXT", "of the page", "Output");
    command.add_text("--date", input.date, "YYYY-MM-DD", "that it bears (none)", "Output");
    command.add({.name = "--output",
                 .target = &input.output,
                 .type = "FILE",
                 .help = "the page, or its rows or JSON (stdout)",
                 .group = "Output"});
    command.add({.name = "--also",
                 .target = &input.further,
                 .type = "FILE",
                 .help =
                     "another file from the same run: .html the page in short, .csv its rows, .json all of it, .md or "
                     ".txt its table; again for more of them",
                 .group = "Output",
                 .repeats = true});
    command.add(choice_argument("--format", input.form, {"html", "table", "csv", "json", "markdown"},
                                "the page (html), its table of faces, edges and corners, or all of it as JSON",
                                "Output"));
    command.add_flag("--bare", input.is_bare, "CSV without comments", "Output");
    command.columns = {
        {"report", attitude_columns}, {"report-cases", case_columns}, {"report-attitudes", case_attitude_columns}};
    command.footer =
        "Example: clatter report phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --part 300:500 --output "
        "phone.html\n"
        "Example: clatter report phone-damped --impacts 2 --probe camera:0.048,0.016,0.0095 --probe "
        "crystal:-0.03,0,0 --part camera:300:500 --part crystal:1500g:0.5ms --floor-restitution 0.3:0.7:0.2 --drops 52 "
        "--format csv\n"
        "A number of the scene takes several values, 0.3:0.7:0.1 or 0.3,0.5, a name several names, --floor "
        "concrete,wood: each is a case; the answer says for each part how far its margin goes, and what moves it "
        "most.\n"
        "Each worst drop is followed to 4 digits (--digits); an interrupted run leaves its finished cases in "
        "FILE.part.\n"
        "The page has all in itself, asks for nothing from anywhere and prints.  Needs gnuplot.";
  });
}

}  // namespace clatter::validation

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <future>
#include <memory>
#include <vector>

#include "validation/cli/commands.hpp"
#include "validation/cli/options.hpp"
#include "validation/cli/rod_options.hpp"
#include "validation/cli/version.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/output/json.hpp"
#include "validation/output/number.hpp"
#include "validation/output/sink.hpp"

namespace clatter::validation {
namespace {

using analytic::degrees_per_radian;
using analytic::NextImpact;

struct AnglesInput {
  SweepTexts sweep;
  RodTexts rod;
  OutputTexts output;
  std::optional<std::string> digits;
  bool as_printed = false;
};

/// A sweep over θ with everything needed to compute a row of it.
struct Request {
  Sweep sweep;
  analytic::RodParameters rod;
  bool as_printed = false;
  int digits = 6;
};

constexpr int plain_columns = 17;
constexpr int all_columns = plain_columns + 2;
using Row = std::array<double, all_columns>;

std::vector<Column> columns_of(const Request& request) {
  const bool p = request.as_printed;
  return {{"theta_deg", "θ", "°"}, {"beta_deg", "β", "°"}, {"gamma_deg", "γ", "°", !p},
          {"P1", "P₁", "", !p}, {"P2", "P₂", "", !p}, {"P3", "P₃", "", !p},
          {"V1", "V₁", "", false}, {"Omega1", "Ω₁", "", false}, {"V2", "V₂", "", false},
          {"Omega2", "Ω₂", "", false}, {"V3", "V₃", "", false}, {"Omega3", "Ω₃", "", false},
          {"T1", "T₁", "", false}, {"T2", "T₂", "", false},
          {"gamma_minus_theta_deg", "γ − θ", "°", false},
          {"impulse_deficit", "2 − ΣP", "", !p},
          {"impacts", "impacts", ""},
          {"beta_printed_deg", "β printed, g > 0", "°", p},
          {"beta_printed_negative_g_deg", "β printed, g < 0", "°", p}};
}

std::size_t column_count(const Request& request) {
  return request.as_printed ? all_columns : plain_columns;
}

double angle_or_missing(const analytic::ContactAngle& angle) {
  return angle.next == NextImpact::other_end ? angle.angle * degrees_per_radian : NAN;
}

Row row_of(const Request& request, long long i) {
  const double theta = request.sweep.value(i);
  const analytic::Angle angle = analytic::Angle::from_degrees(theta);
  const analytic::ContactAngles a = analytic::contact_angles(angle, request.rod);
  const double beta = angle_or_missing(a.beta);
  const double gamma = angle_or_missing(a.gamma);
  Row row{theta, beta, gamma, a.impulse[0], a.impulse[1], a.impulse[2],
          a.velocity[0], a.angular[0], a.velocity[1], a.angular[1], a.velocity[2], a.angular[2],
          std::isnan(beta) ? NAN : a.beta.time, std::isnan(gamma) ? NAN : a.gamma.time,
          a.gamma_minus_theta * degrees_per_radian, a.impulse_deficit,
          static_cast<double>(a.impacts())};
  if (request.as_printed) {
    const double g = request.rod.gravity_number;
    row[plain_columns] = angle_or_missing(analytic::contact_angle_as_printed(angle, g));
    row[plain_columns + 1] = angle_or_missing(analytic::contact_angle_as_printed(angle, -g));
  }
  return row;
}

std::vector<std::string> head_of(const Request& request) {
  std::vector<std::string> head{
      headline("angles", "contact angles of the first three impacts"),
      rod_summary(request.rod) + fmt::format("; θ from {}° to {}°, {} values",
                                             shortest(request.sweep.from),
                                             shortest(request.sweep.value(request.sweep.count - 1)),
                                             request.sweep.count)};
  return head;
}

std::vector<std::string> notes_of(const Request& request) {
  if (!request.as_printed) return {"An empty cell: that impact does not happen with β, γ ≤ 90°."};
  return {"β: with the gravity term − (g/vₙ²)(…)²(θ+β)²; printed: with the paper's + (g/2vₙ²)(…)²(θ+β)²,"
          " whose sign and factor are wrong, for g of either sign. An empty cell: no impact."};
}

Table table_of(const Request& request) {
  Table table{.head = head_of(request), .columns = columns_of(request), .rows = {},
              .notes = notes_of(request)};
  table.columns.resize(column_count(request));
  for (long long i = 0; i < request.sweep.count; ++i) {
    const Row row = row_of(request, i);
    auto& cells = table.rows.emplace_back();
    for (std::size_t k = 0; k < column_count(request); ++k) {
      cells.push_back(std::isnan(row[k]) ? Cell() : Cell(row[k], request.digits));
    }
    cells[16] = Cell(std::to_string(static_cast<int>(row[16])));
    cells[0] = Cell(shortest(row[0]));
  }
  return table;
}

Json json_of(const Request& request) {
  const auto columns = columns_of(request);
  Json rows = Json::array();
  for (long long i = 0; i < request.sweep.count; ++i) {
    const Row row = row_of(request, i);
    Json item = Json::object();
    for (std::size_t k = 0; k < column_count(request); ++k) {
      item[columns[k].name] = k == 16 ? Json(static_cast<int>(row[k])) : number_or_null(row[k]);
    }
    rows.push_back(item);
  }
  return {{"clatter", version}, {"model", "discrete"},
          {"parameters", {{"gravity_number", request.rod.gravity_number},
                          {"restitution", request.rod.restitution},
                          {"impulse_ratio", request.rod.impulse_ratio}}},
          {"rows", rows}};
}

/// CSV rows [begin, end); empty fields for what does not happen.
std::string csv_block(const Request& request, long long begin, long long end) {
  fmt::memory_buffer out;
  for (long long i = begin; i < end; ++i) {
    const Row row = row_of(request, i);
    for (std::size_t k = 0; k < column_count(request); ++k) {
      if (k > 0) out.push_back(',');
      if (!std::isnan(row[k])) fmt::format_to(std::back_inserter(out), "{}", row[k] + 0.0);
    }
    out.push_back('\n');
  }
  return fmt::to_string(out);
}

void show_progress(long long done, long long count) {
  fmt::print(stderr, "\rclatter: {} of {} rows{}", done, count, done == count ? "\n" : "");
}

/// Blocks of rows, two at a time on two threads, written in order.
int write_csv(const Request& request, const OutputChoice& choice) {
  Sink sink(choice.path);
  Table frame{.head = head_of(request), .columns = columns_of(request), .rows = {}, .notes = {}};
  frame.columns.resize(column_count(request));
  sink.write(table_text(frame, choice.style));
  const CooperativeInterrupt interrupt;
  constexpr long long block = 8192;
  const long long count = request.sweep.count;
  const bool progress = count > 20 * block && shows_progress();
  for (long long begin = 0; begin < count; begin += 2 * block) {
    const long long middle = std::min(begin + block, count);
    const long long end = std::min(middle + block, count);
    auto second = std::async(std::launch::async, csv_block, std::cref(request), middle, end);
    sink.write(csv_block(request, begin, middle));
    sink.write(second.get());
    if (progress) show_progress(end, count);
    if (!interrupt.requested()) continue;
    if (sink.is_file()) return interrupted_status;
    sink.write(fmt::format("# interrupted after {} of {} rows\n", end, count));
    sink.commit();
    return interrupted_status;
  }
  for (const std::string& note : notes_of(request)) sink.write("# " + note + "\n");
  sink.commit();
  return 0;
}

int run_angles(const AnglesInput& input) {
  const Request request{
      .sweep = read_sweep(input.sweep, {0, 90, 5}, {0, 90, false, "from 0 to 90 degrees"}),
      .rod = read_rod(input.rod),
      .as_printed = input.as_printed,
      .digits = input.digits ? read_integer_option("--digits", *input.digits, 1, 17) : 6};
  const OutputChoice choice = read_output(input.output);
  if (choice.style.format == Format::csv) return write_csv(request, choice);
  write_out(choice, choice.style.format == Format::json ? json_text(json_of(request))
                                                        : table_text(table_of(request), choice.style));
  return 0;
}

}  // namespace

Action add_angles_command(CLI::App& app) {
  auto input = std::make_shared<AnglesInput>();
  CLI::App* command = app.add_subcommand("angles", "contact angles and impulses of the thin rod");
  add_sweep_options(*command, input->sweep, "angle theta in degrees (0 to 90 by 5)");
  add_rod_options(*command, input->rod);
  command->add_flag("--as-printed", input->as_printed,
                    "beta by the paper's printed gravity term beside the corrected one")->group("Rod");
  add_output_options(*command, input->output);
  add_text(*command, "--digits", input->digits, "N", "significant digits in tables (6)")->group("Output");
  command->footer("Example: clatter angles --from 0 --to 60 --step 2.5 --gravity-number 0.1");
  return [input] { return run_angles(*input); };
}

}  // namespace clatter::validation

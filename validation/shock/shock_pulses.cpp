// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/shock_pulses.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "validation/output/number.hpp"

namespace clatter::validation {
namespace {

constexpr PulseShape shapes[] = {PulseShape::rectangle, PulseShape::half_sine};
constexpr const char* shape_words[] = {"rectangle", "half sine"};
constexpr const char* pulse_names[] = {"rectangle", "half_sine"};

double relative(double error, double value) { return std::fabs(error / value); }

/// By the continuous model; not finite where an impact has several touches.
double restitution_of(const ShockRun& run, int impact) {
  return run.continuous->planned.run.impacts.at(static_cast<std::size_t>(impact) - 1).value.restitution;
}

/// Along a boundary, from short pulses to the longest one shown: change of velocity and peak in g.
std::vector<std::pair<double, double>> boundary_points(const FragilePart& part, PulseShape shape, double last) {
  constexpr int count = 160;
  constexpr double shortest_turns = 0.01;
  const DamageBoundary boundary = damage_boundary(part, shape);
  const double critical_peak = boundary.critical_acceleration / standard_gravity;
  if (!(part.frequency > 0)) {  // two lines; the upright one as high as blows are
    constexpr double high = 1e3;
    std::vector<std::pair<double, double>> lines{{std::max(last, 2 * boundary.critical_velocity), critical_peak}};
    if (boundary.critical_velocity > 0)
      lines.insert(lines.begin(),
                   {{boundary.critical_velocity, high * critical_peak}, {boundary.critical_velocity, critical_peak}});
    else lines.insert(lines.begin(), {last * 1e-3, critical_peak});
    return lines;
  }
  const double turns_at_largest =
      part.frequency * boundary.corner_velocity / (pulse_area(shape) * boundary.critical_acceleration);
  std::vector<std::pair<double, double>> points;
  for (int i = 0; i <= count; ++i) {
    const double turns = shortest_turns * std::pow(turns_at_largest / shortest_turns, i / double{count});
    const double peak = part.fragility / pulse_response(shape, turns);
    points.emplace_back(pulse_area(shape) * peak * turns / part.frequency, peak / standard_gravity);
  }
  points.emplace_back(std::max(last, 2 * boundary.corner_velocity), critical_peak);
  return points;
}

}  // namespace

std::vector<Column> pulse_columns() {
  std::vector<Column> columns{
      word_column("probe", "probe", "name of the point"),
      {"n", "n", "", "number of the impact, from 1"},
      word_column("model", "model", "continuous, or measured: of a record"),
      {"delta_v", "|ΔV|", "m/s", "size of the change of the point's velocity"},
      {"peak_g", "peak", "g", "largest size of the specific force, in units of 9.80665 m/s²"},
      {"pulse_duration", "T", "s", "of the half sine with this change of velocity and peak: π |ΔV|/(2 peak)"},
      {"height_without_rebound", "h, e = 0", "m", "of fall with this change of velocity if the body did not rebound"},
      {"height", "h", "m", "of fall with this change of velocity and the impact's own restitution"},
      word_column(
          "condition", "B110",
          "mildest service condition of JESD22-B110B, H, G, B, F, A, E, D or C, that covers both; -: beyond all"),
      {"margin_rectangle", "rectangle", "",
       "fragility over the part's acceleration under a rectangle of this |ΔV| and "
       "peak: at most 1, it fails"},
      {"margin_half_sine", "half sine", "", "the same under the half sine"},
      {"margin_history", "itself", "",
       "the same under the blow's own history, which may have several humps; of a part known by a test the oscillator "
       "with its damage boundary"},
      word_column("part", "part", "whose margins these are, as --part takes it"),
      {"restitution", "e", "", "of the impact, by the continuous model", false}};
  for (const std::size_t of : {3U, 4U, 5U, 6U, 7U, 9U, 10U, 11U}) columns.push_back(error_column(columns[of]));
  columns.push_back({"response_g", "answer", "g",
                     "largest acceleration of a part without a limit, under either pulse and the blow's own history"});
  return columns;
}

Cell condition_cell(const Estimated& velocity, const Estimated& peak) {
  if (velocity.is_known() && peak.is_known())
    return Cell(std::string(1, covering_condition(velocity.value, peak.value)));
  return {Value(), "?"};
}

Cell known_or_empty(const Estimated& number, int digits) {
  return number.is_known() ? measured_cell(number, digits) : Cell(Value(), "?");
}

/// @param part  null: none
Row pulse_row(const Pulse& pulse, int digits, const FragilePart* part) {
  const Estimated &velocity = pulse.velocity, &peak = pulse.peak;
  const double of_v = relative(velocity.error, velocity.value), of_a = relative(peak.error, peak.value);
  const TestPulse half_sine = equivalent_pulse(velocity.value, peak.value);
  Row row{Cell(pulse.probe), Cell(pulse.impact), Cell(pulse.model)}, errors;
  const auto add = [&](double value, double of_value) {
    const Estimated number{value, std::fabs(value) * of_value};
    row.push_back(std::isfinite(value) ? known_or_empty(number, digits) : Cell());
    errors.emplace_back(std::isfinite(value) ? error_or_nothing(number) : Value());
  };
  if (!pulse.predictable) row[1].shown = fmt::format("{}?", pulse.impact);
  for (const Estimated& size : {velocity, peak * (1 / standard_gravity)}) {
    row.push_back(measured_cell(size, digits));
    errors.emplace_back(error_or_nothing(size));
  }
  add(half_sine.duration, of_v + of_a);
  add(half_sine.height(0), 2 * of_v);
  add(half_sine.height(pulse.restitution), 2 * of_v);
  row.push_back(condition_cell(velocity, peak));
  // ln of a response changes by no more than ln of f T does.
  const bool has_limit = part && part->has_limit();
  for (const PulseShape shape : shapes)
    add(has_limit ? margin(*part, shape, velocity.value, peak.value) : std::nan(""), of_v + 2 * of_a);
  const Estimated response =
      (part && pulse.row ? pulse.row->response_of(*part) : std::nullopt).value_or(Estimated{std::nan(""), 0});
  const bool is_felt = std::isfinite(response.value);
  const double of_response = is_felt ? relative(response.error, response.value) : 0;
  add(is_felt && has_limit ? part->oscillator()->fragility / response.value : std::nan(""), of_response);
  row.push_back(part ? Cell(part_text(*part)) : Cell());
  row.emplace_back(pulse.restitution, 4);
  if (!std::isfinite(pulse.restitution)) row.back() = Cell();
  row.insert(row.end(), errors.begin(), errors.end());
  row.emplace_back();
  if (part && !has_limit) {
    const double least = blow_margin(*part, velocity.value, peak.value, is_felt ? response.value : 0).value;
    const double answer = part->response_at(least) / standard_gravity;
    row.back() = known_or_empty({answer, answer * std::fmax(of_v + 2 * of_a, of_response)}, digits);
  }
  return row;
}

namespace {

bool are_mixed(const std::vector<Pulse>& pulses) {
  return std::ranges::any_of(pulses, [&](const Pulse& pulse) { return pulse.model != pulses.front().model; });
}

}  // namespace

Grid pulse_grid(const std::vector<Pulse>& pulses, int digits, const std::vector<FragilePart>& parts) {
  Grid grid{pulse_columns(), {}, 3};
  const bool has_history = std::ranges::any_of(pulses, [&](const Pulse& pulse) {
    return pulse.row &&
           std::ranges::any_of(parts, [&](const auto& part) { return pulse.row->response_of(part).has_value(); });
  });
  const bool has_limit = std::ranges::any_of(parts, &FragilePart::has_limit);
  for (Column& column : grid.columns) {
    if (column.name == "part") column.shown = parts.size() > 1;
    else if (column.name == "model") column.shown = are_mixed(pulses);
    else if (column.name == "margin_history") column.shown = has_history && has_limit;
    else if (column.name.starts_with("margin") && !has_limit) column.shown = false;
    else if (column.name == "response_g")
      column.shown = std::ranges::any_of(parts, std::not_fn(&FragilePart::has_limit));
  }
  for (const Pulse& pulse : pulses) {
    const auto is_here = [&](const FragilePart& part) { return part.is_at(pulse.probe); };
    if (std::ranges::none_of(parts, is_here)) grid.rows.push_back(pulse_row(pulse, digits, nullptr));
    for (const FragilePart& part : parts) {
      if (is_here(part)) grid.rows.push_back(pulse_row(pulse, digits, &part));
    }
  }
  return grid;
}

std::string least_margin_words(const Grid& grid, const std::vector<FragilePart>& parts) {
  const auto of = [&](const Row& row, const char* name) -> const Value& {
    return row[static_cast<std::size_t>(std::ranges::find(grid.columns, name, &Column::name) - grid.columns.begin())]
        .value;
  };
  const auto margin_of = [&](const Row& row) {
    double least = std::nan("");
    for (const char* const name : {"margin_rectangle", "margin_half_sine", "margin_history"})
      if (const double* const number = of(row, name).number()) least = std::fmin(least, *number);
    return least;
  };
  const Row* worst = nullptr;
  for (const Row& row : grid.rows) {
    if (std::isfinite(margin_of(row)) && (!worst || margin_of(row) < margin_of(*worst))) worst = &row;
  }
  if (parts.empty() || !worst) return "";
  const std::string model = of(*worst, "model").text();
  const bool is_mixed =
      std::ranges::any_of(grid.rows, [&](const Row& row) { return of(row, "model").text() != model; });
  const bool is_one = parts.size() == 1, survives = margin_of(*worst) > 1;
  return fmt::format("{}{}: {} at {} {}, margin {} in impact {}{}", is_one ? "verdict" : "least margin of ",
                     is_one ? "" : fmt::format("{} parts", parts.size()), of(*worst, "part").text(),
                     of(*worst, "probe").text(), survives ? "survives" : "fails", significant(margin_of(*worst), 4),
                     of(*worst, "n").text(), is_mixed ? ", " + model : "");
}

std::vector<Pulse> pulses_of(const ShockRun& run) {
  std::vector<Pulse> pulses;
  if (!run.continuous) return pulses;
  for (std::size_t probe = 0; probe < run.probes.size(); ++probe) {
    for (const ShockRow& blow : run.continuous->rows) {
      if (blow.probe != probe) continue;
      pulses.push_back({run.probes[probe].name,
                        blow.impact,
                        {blow.value.delta_v_size, blow.error.delta_v_size},
                        {blow.value.peak_size, blow.error.peak_size},
                        restitution_of(run, blow.impact),
                        blow.predictable,
                        &blow,
                        "continuous"});
    }
  }
  return pulses;
}

namespace {

std::string boundary_words(const FragilePart& part) {
  if (!part.has_limit())
    return fmt::format("{}: ranked by what it answers with; --part {}:G gives a limit of G, and margins",
                       words_of(part), part_text(part));
  if (part.kind == FragilePart::Kind::at_place) {
    return fmt::format("{}: its margin is that over the peak; what rings in it is left out", words_of(part));
  }
  if (part.kind == FragilePart::Kind::tested) {
    const DamageBoundary boundary = damage_boundary(part, shapes[0]);
    return fmt::format(
        "damage boundary (ASTM D3332) of {}: V_c = 2AT/π = {} m/s, A_c = A = {} g, in place of its two tests; one "
        "pulse "
        "does not tell the part's frequency: V_c is that of a part up to {:.3g} Hz, 1/(4 T), A_c that of one far "
        "above; "
        "humps are judged by the oscillator that has both, of {:.3g} Hz, which fails at {} g",
        words_of(part), significant(boundary.critical_velocity, 6),
        significant(boundary.critical_acceleration / standard_gravity, 6), 1 / (4 * part.duration),
        part.oscillator()->frequency, significant(part.oscillator()->fragility / standard_gravity, 6));
  }
  std::string words = fmt::format("damage boundary (ASTM D3332) of {}, undamped: V_c = {} m/s", words_of(part),
                                  significant(damage_boundary(part, shapes[0]).critical_velocity, 6));
  for (std::size_t i = 0; i < 2; ++i) {
    const DamageBoundary boundary = damage_boundary(part, shapes[i]);
    words += fmt::format("; {}: A_c = {} g from {} m/s on, |ΔV| alone decides up to {:.3g} ms", shape_words[i],
                         significant(boundary.critical_acceleration / standard_gravity, 6),
                         significant(boundary.corner_velocity, 6),
                         1e3 * boundary.corner_velocity / (pulse_area(shapes[i]) * boundary.critical_acceleration));
  }
  return words;
}

}  // namespace

std::vector<std::string> pulse_notes(const std::vector<FragilePart>& parts, const std::vector<Probe>& probes,
                                     const std::optional<LowPass>& filter) {
  const std::string milder = filter ? fmt::format(" (filtered, {}: milder than unfiltered)", filter->name()) : "";
  std::vector<std::string> notes;
  std::string unbound, names;
  for (const FragilePart& part : parts) {
    if (part.probe.empty()) unbound += (unbound.empty() ? "" : ", ") + part_text(part);
  }
  for (const Probe& probe : probes) names += (names.empty() ? "" : ", ") + probe.name;
  if (!unbound.empty() && probes.size() > 1)
    notes.push_back(fmt::format("{}: judged at each of {}; --part {}:{} is one at {} alone", unbound, names,
                                probes.front().name, part_text(parts.front()), probes.front().name));
  for (const FragilePart& part : parts) notes.push_back(boundary_words(part) + milder);
  std::string ladder = fmt::format(
      "B110: mildest condition of JESD22-B110B that covers |ΔV| and peak{}, - beyond all; half sines, 2AT/π, height "
      "without rebound:",
      milder);
  for (const ServiceCondition& one : service_conditions()) {
    ladder += fmt::format("{} {} {} g {} ms {:.3f} m/s {:.3f} m", one.name == 'H' ? "" : ";", one.name,
                          significant(one.pulse.acceleration / standard_gravity, 4),
                          significant(1e3 * one.pulse.duration, 3), one.pulse.velocity(), one.pulse.height(0));
  }
  notes.push_back(ladder);
  notes.emplace_back("a body that rebounds with e has the same change of velocity from a height of 1/(1 + e)² of that");
  return notes;
}

namespace {

Value boundary_value(const FragilePart& part) {
  Value boundary(Value::Fields{{"frequency", part.frequency > 0 ? Value(part.frequency) : Value()},
                               {"fragility", part.fragility},
                               {"tested_duration", part.duration > 0 ? Value(part.duration) : Value()}});
  for (std::size_t i = 0; i < 2; ++i) {
    const DamageBoundary of_shape = damage_boundary(part, shapes[i]);
    boundary[pulse_names[i]] = Value::Fields{{"critical_velocity", of_shape.critical_velocity},
                                             {"critical_acceleration", of_shape.critical_acceleration},
                                             {"corner_velocity", of_shape.corner_velocity}};
  }
  return boundary;
}

}  // namespace

Value pulse_fields(const Grid& grid, const std::vector<FragilePart>& parts) {
  Value::List conditions;
  for (const ServiceCondition& one : service_conditions()) {
    conditions.emplace_back(Value::Fields{{"name", std::string(1, one.name)},
                                          {"peak_g", one.pulse.acceleration / standard_gravity},
                                          {"duration", one.pulse.duration},
                                          {"velocity", one.pulse.velocity()},
                                          {"height_without_rebound", one.pulse.height(0)}});
  }
  Value fields(Value::Fields{{"blows", row_objects(grid)}, {"service_conditions", conditions}});
  if (parts.size() == 1 && parts.front().has_limit()) fields["damage_boundary"] = boundary_value(parts.front());
  if (!parts.empty()) fields["message"] = least_margin_words(grid, parts);
  if (parts.size() < 2) return fields;
  for (const FragilePart& part : parts) {
    if (!part.has_limit()) continue;
    Value boundary = boundary_value(part);
    boundary["part"] = part_text(part);
    fields["damage_boundaries"].push_back(boundary);
  }
  return fields;
}

std::optional<PicturePanel> boundary_panel(const std::vector<Pulse>& pulses, const FragilePart& part) {
  if (!part.has_limit() || std::ranges::none_of(pulses, [&](const Pulse& pulse) { return part.is_at(pulse.probe); }))
    return std::nullopt;
  PicturePanel panel{.columns = {{"velocity", "m/s", "change of velocity"}}};
  panel.plot.x_label = words_of(part) + ": change of velocity [m/s]";
  panel.plot.y_label = "peak [g]";
  panel.plot.logarithmic_x = panel.plot.logarithmic_y = true;
  double last = 0;
  for (const Pulse& pulse : pulses) last = std::max(last, 1.5 * pulse.velocity.value);
  const auto add = [&](const std::string& legend, FigureCurve::Style style,
                       const std::vector<std::pair<double, double>>& points) {
    const std::string name = fmt::format("a{}", panel.columns.size());
    panel.columns.push_back({name, "g", legend});
    for (auto& row : panel.rows) row.push_back(no_number);
    for (const auto& [velocity, acceleration] : points) {
      panel.rows.emplace_back(panel.columns.size(), no_number);
      panel.rows.back().front() = velocity;
      panel.rows.back().back() = acceleration;
    }
    panel.plot.curves.push_back({.x = "velocity", .y = name, .legend = legend, .style = style});
  };
  if (!(part.frequency > 0)) {
    add("fails above and right of this", FigureCurve::Style::line, boundary_points(part, shapes[0], last));
  } else {
    for (std::size_t i = 0; i < 2; ++i) {
      add(fmt::format("{} fails the part above and right of this", shape_words[i]),
          i == 0 ? FigureCurve::Style::line : FigureCurve::Style::dashed, boundary_points(part, shapes[i], last));
    }
  }
  std::vector<std::pair<double, double>> later;
  for (const Pulse& pulse : pulses) {
    constexpr int most_marks = 4;  // a legend has an end
    if (!part.is_at(pulse.probe)) continue;
    const std::pair point{pulse.velocity.value, pulse.peak.value / standard_gravity};
    if (pulse.predictable && pulse.impact <= most_marks)
      add(fmt::format("{}, impact {}{}{}", pulse.probe, pulse.impact, are_mixed(pulses) ? ", " + pulse.model : "",
                      pulse.velocity.is_known() && pulse.peak.is_known() ? "" : ", size not known"),
          FigureCurve::Style::marks, {point});
    else later.push_back(point);
  }
  if (!later.empty()) add("later impacts, and those that cannot be predicted", FigureCurve::Style::points, later);
  return panel;
}

}  // namespace clatter::validation

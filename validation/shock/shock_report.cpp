// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/shock/shock_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/body_properties.hpp"
#include "validation/scene/facet_words.hpp"
#include "validation/scene/names.hpp"
#include "validation/scene/probes.hpp"
#include "validation/shock/shock_history.hpp"
#include "validation/shock/shock_pulses.hpp"

namespace clatter::validation {
namespace {

constexpr const char* axis_names[] = {"x", "y", "z"};

/// A number of a row, of either model.
struct ShockQuantity {
  const char *name, *symbol, *unit, *meaning;
  bool in_discrete;  ///< the discrete model has it, too, as discrete_NAME
  double (*get)(const ShockNumbers&);
};

constexpr ShockQuantity quantities[]{
    {"delta_v_x", "ΔV_x", "m/s", "change of the point's velocity over the impact, world", true,
     [](const ShockNumbers& n) { return n.delta_v.x(); }},
    {"delta_v_y", "ΔV_y", "m/s", "change of the point's velocity over the impact, world", true,
     [](const ShockNumbers& n) { return n.delta_v.y(); }},
    {"delta_v_z", "ΔV_z", "m/s", "change of the point's velocity over the impact, world", true,
     [](const ShockNumbers& n) { return n.delta_v.z(); }},
    {"delta_v", "|ΔV|", "m/s", "its size, which hardly depends on the floor's stiffness", true,
     [](const ShockNumbers& n) { return n.delta_v_size; }},
    {"peak_x", "a_x", "m/s²", "specific force, what an accelerometer reads, when it is largest; body axes", false,
     [](const ShockNumbers& n) { return n.peak.x(); }},
    {"peak_y", "a_y", "m/s²", "specific force, what an accelerometer reads, when it is largest; body axes", false,
     [](const ShockNumbers& n) { return n.peak.y(); }},
    {"peak_z", "a_z", "m/s²", "specific force, what an accelerometer reads, when it is largest; body axes", false,
     [](const ShockNumbers& n) { return n.peak.z(); }},
    {"peak", "peak a", "m/s²", "largest size of the specific force in the contact", false,
     [](const ShockNumbers& n) { return n.peak_size; }},
    {"peak_g", "peak", "g", "the same in units of 9.80665 m/s²", false,
     [](const ShockNumbers& n) { return n.peak_size / standard_gravity; }},
    {"peak_time", "at", "s", "when, after the touch-down", false, [](const ShockNumbers& n) { return n.peak_time; }},
    {"width", "width", "s", "of the pulse about the peak, at a tenth of its height, within the contact", false,
     [](const ShockNumbers& n) { return n.width; }},
    {"angular_velocity_change_x", "Δω_x", "rad/s", "change of the body's angular velocity, world", true,
     [](const ShockNumbers& n) { return n.delta_omega.x(); }},
    {"angular_velocity_change_y", "Δω_y", "rad/s", "change of the body's angular velocity, world", true,
     [](const ShockNumbers& n) { return n.delta_omega.y(); }},
    {"angular_velocity_change_z", "Δω_z", "rad/s", "change of the body's angular velocity, world", true,
     [](const ShockNumbers& n) { return n.delta_omega.z(); }},
    {"angular_velocity_change", "|Δω|", "rad/s", "its size", true,
     [](const ShockNumbers& n) { return n.delta_omega_size; }},
    {"angular_acceleration_peak", "peak α", "rad/s²", "largest angular acceleration of the body in the contact", false,
     [](const ShockNumbers& n) { return n.peak_alpha; }}};

Column column_of(const ShockQuantity& quantity, bool discrete) {
  Column column{quantity.name, quantity.symbol, quantity.unit, quantity.meaning};
  if (discrete) {
    column.name = "discrete_" + column.name;
    column.heading = "discrete";
    column.meaning = std::string(quantity.name) + " by the discrete model";
  }
  return column;
}

const std::vector<std::string>& shown_of(bool both, bool continuous) {
  static const std::vector<std::string> alone{"probe",  "n",           "start", "delta_v",
                                              "peak_g", "sensitivity", "width", "angular_velocity_change"},
      compared{"probe",
               "n",
               "start",
               "delta_v",
               "discrete_delta_v",
               "peak_g",
               "sensitivity",
               "width",
               "angular_velocity_change"},
      discrete{"probe",
               "n",
               "start",
               "discrete_delta_v",
               "discrete_delta_v_x",
               "discrete_delta_v_z",
               "discrete_angular_velocity_change"};
  return both ? compared : continuous ? alone : discrete;
}

/// The continuous model's row of this impact and probe, or none.
const ShockRow* continuous_row(const ShockRun& run, int impact, std::size_t probe) {
  if (!run.continuous) return nullptr;
  const std::vector<ShockRow>& rows = run.continuous->rows;
  const auto found = std::find_if(rows.begin(), rows.end(),
                                  [&](const ShockRow& row) { return row.impact == impact && row.probe == probe; });
  return found == rows.end() ? nullptr : &*found;
}

int last_impact(const ShockRun& run) {
  int last = 0;
  if (run.continuous && !run.continuous->rows.empty()) last = run.continuous->rows.back().impact;
  if (!run.discrete.empty() && run.parted.from == 0) last = std::max(last, run.discrete.back().impact);
  return last;
}

/// Sizes against which numbers count as zero: of the same kind, over all rows.
double size_of(const ShockRun& run, const ShockQuantity& quantity) {
  const bool is_velocity = std::string_view(quantity.unit) == "m/s",
             is_rate = std::string_view(quantity.unit) == "rad/s";
  double size = 0;
  for (const auto* rows : {&run.rows(), &run.discrete}) {
    for (const ShockRow& row : *rows) {
      size = std::max(size, is_velocity                                 ? row.value.delta_v_size
                            : is_rate                                   ? row.value.delta_omega_size
                            : std::string_view(quantity.unit) == "m/s²" ? row.value.peak_size
                                                                        : 0);
    }
  }
  return size;
}

void add_numbers(const ShockRun& run, const ShockRow* row, bool discrete, Row& cells, Row& errors) {
  for (const ShockQuantity& quantity : quantities) {
    if (discrete && !quantity.in_discrete) continue;
    if (!row) {
      cells.emplace_back();
      errors.emplace_back();
      continue;
    }
    const Estimated number{quantity.get(row->value), quantity.get(row->error)};
    cells.push_back(known_cell(number, {run.scene.accuracy.digits, size_of(run, quantity)}));
    errors.emplace_back(error_or_nothing(number));
  }
}

void add_sensitivity(const ShockRow* row, Row& cells, Row& errors) {
  if (!row || !row->sensitivity) {
    cells.emplace_back();
    errors.emplace_back();
    return;
  }
  cells.push_back(known_cell(*row->sensitivity, {3, 1}));
  if (!row->sensitivity->is_known()) cells.back().value = Value();
  errors.emplace_back(error_or_nothing(*row->sensitivity));
}

/// How deep the body goes in the impact, which is no matter of the probe.
void add_indentation(const ShockRun& run, int impact, Row& cells, Row& errors) {
  const auto place = static_cast<std::size_t>(impact - 1);
  if (!run.continuous || place >= run.continuous->planned.run.impacts.size()) {
    cells.emplace_back();
    errors.emplace_back();
    return;
  }
  const numeric::ImpactRecord& row = run.continuous->planned.run.impacts[place];
  const Estimated depth{row.value.indentation, row.error.indentation};
  cells.push_back(known_cell(depth, {run.scene.accuracy.digits, 0}));
  errors.emplace_back(error_or_nothing(depth));
}

Row row_of(const ShockRun& run, int impact, std::size_t probe) {
  const ShockRow* const continuous = continuous_row(run, impact, probe);
  const ShockRow* const discrete = run.discrete_row(impact, probe);
  const ShockRow* const first = continuous ? continuous : discrete;
  const double last = run.rows().empty() ? 0 : run.rows().back().start;
  Row cells{Cell(run.probes[probe].name), Cell(impact)}, errors;
  if (!first->predictable) cells[1].shown = fmt::format("{}?", impact);
  const Estimated start{first->start, first->start_error};
  cells.push_back(known_cell(start, {run.scene.accuracy.digits, last}));
  errors.emplace_back(error_or_nothing(start));
  cells.push_back(continuous ? Cell(continuous->duration, run.scene.accuracy.digits) : Cell());
  add_numbers(run, continuous, false, cells, errors);
  add_sensitivity(continuous, cells, errors);
  add_indentation(run, impact, cells, errors);
  add_numbers(run, discrete, true, cells, errors);
  cells.push_back(continuous ? Cell(continuous->closure, 2) : Cell());
  cells.emplace_back(first->predictable);
  cells.insert(cells.end(), errors.begin(), errors.end());
  return cells;
}

Grid impacts_of(const ShockRun& run) {
  Grid grid{shock_columns(), {}, 2};
  const auto& shown = shown_of(run.continuous && !run.discrete.empty(), run.continuous.has_value());
  const bool has_pad = run.continuous && (run.scene.world.ground.is_pad() || run.scene.pad.thickness);
  for (Column& column : grid.columns) {
    column.shown = std::find(shown.begin(), shown.end(), column.name) != shown.end();
    if (column.name == "indentation") column.shown = has_pad;
    if (column.name == "sensitivity" && run.request.filter) column.shown = false;
    if (run.continuous) continue;
    for (const ShockQuantity& quantity : quantities) {  // nothing stands beside them to tell them from
      if (column.name == std::string("discrete_") + quantity.name) column.heading = quantity.symbol;
    }
  }
  for (std::size_t probe = 0; probe < run.probes.size(); ++probe) {
    for (int impact = 1; impact <= last_impact(run); ++impact) grid.rows.push_back(row_of(run, impact, probe));
  }
  return grid;
}

std::string blows_word(const Spectrum& spectrum) {
  if (spectrum.blows == Blows::flat) return "flat";
  return spectrum.impacts == 1 ? "1" : fmt::format("1-{}", spectrum.impacts);
}

/// What is required at a point, and 20 lg of the point over that.
Row required_cells(const ResponsePoint& point, const ShockView& view) {
  const auto asked = view.required ? view.required->at(point.frequency) : std::nullopt;
  if (!asked) return {Cell(), Cell()};
  return {Cell(*asked / standard_gravity, 4), measured_cell(decibels_over(*asked, point), 3)};
}

Row point_row(const NamedSpectrum& named, const ResponsePoint& point, int digits, const ShockView& view) {
  const ResponseExtremes whole = point.whole();
  const Spectrum& spectrum = *named.spectrum;
  const Estimated v{whole.pseudo_velocity.maximax(), point.pseudo_velocity_error};
  const Estimated a{whole.acceleration.maximax(), point.acceleration_error};
  Row cells{Cell(named.probe), Cell(named.axis), Cell(named.model), Cell(blows_word(spectrum)),
            Cell(point.frequency, 4)};
  for (const Estimated& number : {v, a, a * (1 / standard_gravity)}) cells.push_back(measured_cell(number, digits));
  for (const ResponseExtremes* part : {&whole, &point.primary, &point.residual}) {
    for (const Extremes* extremes : {&part->pseudo_velocity, &part->acceleration}) {
      cells.emplace_back(extremes->high, digits);
      cells.emplace_back(extremes->low, digits);
    }
  }
  cells.emplace_back(error_or_nothing(v));
  cells.emplace_back(error_or_nothing(a));
  for (const Cell& cell : required_cells(point, view)) cells.push_back(cell);
  return cells;
}

NamedSpectrum named(const ShockRun& run, const Spectrum& spectrum) {
  return {run.probes[spectrum.probe].name, spectrum.continuous ? "continuous" : "discrete", axis_names[spectrum.axis],
          &spectrum};
}

std::vector<NamedSpectrum> named_spectra(const ShockRun& run) {
  std::vector<NamedSpectrum> all;
  for (const Spectrum& spectrum : run.spectra) all.push_back(named(run, spectrum));
  return all;
}

/// Which spectra stand beside one another for readers, in their order.
struct ShownSpectrum {
  bool continuous;
  Blows blows;
};
constexpr std::array<ShownSpectrum, 4> main_spectra{
    {{true, Blows::impact_1}, {true, Blows::first}, {true, Blows::all}, {true, Blows::flat}}};

std::string part_words(const Spectrum& spectrum) {
  if (spectrum.blows == Blows::flat) return "flat drop";
  return spectrum.impacts == 1 ? "impact 1" : fmt::format("impacts 1 to {}", spectrum.impacts);
}

/// The spectra of a probe in the model that comes first, each once.
std::vector<NamedSpectrum> shown_spectra(const ShockRun& run, std::size_t probe) {
  std::vector<NamedSpectrum> shown;
  for (const ShownSpectrum& one : main_spectra) {
    const Spectrum* const found = run.spectrum(probe, run.continuous.has_value(), one.blows);
    if (found) shown.push_back(named(run, *found));
  }
  return shown;
}

std::vector<std::vector<NamedSpectrum>> shown_spectra(const ShockRun& run) {
  std::vector<std::vector<NamedSpectrum>> shown;
  for (std::size_t probe = 0; probe < run.probes.size(); ++probe) shown.push_back(shown_spectra(run, probe));
  return shown;
}

/// The spectrum of most impacts of each probe, in the model that comes first.
std::vector<NamedSpectrum> compared_spectra(const ShockRun& run) {
  std::vector<NamedSpectrum> compared;
  for (std::size_t probe = 0; probe < run.probes.size(); ++probe) {
    if (const Spectrum* const whole = run.whole(probe, run.continuous.has_value()))
      compared.push_back(named(run, *whole));
  }
  return compared;
}

/// "impact 1", with the model where not all are of one.
std::string words_of(const NamedSpectrum& one, const std::vector<NamedSpectrum>& among) {
  const bool is_other = one.model != among.front().model;
  return part_words(*one.spectrum) +
         (is_other ? fmt::format(", {}", one.model == "discrete" ? "discrete model" : one.model) : "");
}

/// The largest pseudo-velocity [m/s] or acceleration [g] of a point of a spectrum.
Estimated maximax(const ResponsePoint& point, bool is_acceleration) {
  const ResponseExtremes whole = point.whole();
  if (!is_acceleration) return {whole.pseudo_velocity.maximax(), point.pseudo_velocity_error};
  return Estimated{whole.acceleration.maximax(), point.acceleration_error} * (1 / standard_gravity);
}

/// A few frequencies of a probe's spectra, a line each.
void add_spectrum_notes(const ShockRun& run, std::size_t probe, std::vector<std::string>& notes) {
  const std::vector<NamedSpectrum> shown = shown_spectra(run, probe);
  if (shown.empty()) return;
  const std::string where = fmt::format("{} along {}", run.probes[probe].name, shown.front().axis);
  const auto& points = shown.front().spectrum->points;
  const std::size_t step = std::max<std::size_t>(1, (points.size() - 1) / 3);
  for (std::size_t i = 0; i < points.size(); i += step) {
    std::string words = fmt::format("{}, oscillator of {} Hz, {}: pseudo-velocity", where,
                                    significant(points[i].frequency, 4), quality_words(run.request.quality));
    for (const NamedSpectrum& one : shown) {
      const Spectrum& spectrum = *one.spectrum;
      words += fmt::format("{} {} m/s by {}", &one == &shown.front() ? "" : ",",
                           significant(spectrum.points[i].whole().pseudo_velocity.maximax(), 4),
                           spectrum.blows == Blows::flat ? "a flat drop" : part_words(spectrum));
    }
    notes.push_back(words);
  }
  // Beside spectra of other blows that bound says nothing.
  const bool strikes_others = run.continuous && run.parted.from > 0 && run.parted.from <= 2;
  if (run.envelopes.size() > probe && run.envelopes[probe] && !strikes_others) {
    notes.push_back(
        fmt::format("{}: the first two impacts of the discrete model, whatever the time between them: at "
                    "most {} m/s",
                    where, significant(run.envelopes[probe]->pseudo_velocity, 4)));
  }
}

/// Where the spectrum of all impacts exceeds a severity.
std::string severity_words(const ShockRun& run, std::size_t probe, double severity) {
  const Spectrum* const spectrum = run.whole(probe, run.continuous.has_value());
  if (!spectrum) return "";
  double low = 0, high = 0;
  for (const ResponsePoint& point : spectrum->points) {
    if (!(point.whole().pseudo_velocity.maximax() > severity)) continue;
    if (low == 0) low = point.frequency;
    high = point.frequency;
  }
  const std::string& name = run.probes[probe].name;
  if (low == 0) return fmt::format("{}: nowhere above the severity of {} m/s", name, shortest(severity));
  return fmt::format("{}: above the severity of {} m/s from {} to {} Hz", name, shortest(severity), significant(low, 3),
                     significant(high, 3));
}

std::vector<std::string> notes_of(const ShockRun& run, const ShockView& view) {
  std::vector<std::string> notes;
  if (view.rows == ShockRows::pulses || !view.parts.empty())
    notes = pulse_notes(view.parts, run.probes, run.request.filter);
  if (run.continuous && view.rows == ShockRows::impacts && !run.request.filter) {
    const numeric::Ground& ground = run.scene.world.ground;
    notes.push_back(
        fmt::format("peaks are properties of the floor: ∂ ln(peak)/∂ ln {} held, stands beside them; |ΔV| hardly is",
                    ground.is_half_space() ? "E*, dissipation"
                    : ground.is_pad()      ? "pressure of the pad, its curve's depths and dissipation"
                                           : "k_G, c_G/k_G"));
  }
  for (std::size_t probe = 0; probe < run.probes.size(); ++probe) {
    if (view.rows == ShockRows::impacts) add_spectrum_notes(run, probe, notes);
    if (view.severity) notes.push_back(severity_words(run, probe, *view.severity));
  }
  for (const std::string& words : required_words(compared_spectra(run), view, run.request.quality))
    notes.push_back(words);
  if (!run.discrete_reason.empty()) notes.push_back("no discrete model beside it: " + run.discrete_reason);
  if (run.parted.from > 0) {
    notes.push_back(
        fmt::format("from impact {} on the discrete model strikes other blows, which --model discrete "
                    "shows: {}",
                    run.parted.from, run.parted.reason));
  }
  if (run.continuous) {
    for (const std::string& warning : run.continuous->planned.warnings) notes.push_back("!: warning: " + warning);
    const numeric::Simulation& simulation = run.continuous->planned.run;
    notes.push_back(other_law_remark(run.scene, simulation));
    if (run.scene.impact.restitution && !notes.back().empty())
      notes.push_back("the floor's own restitution is --floor-restitution, in both models");
  }
  const auto [outcome, message] = run.ending();
  notes.push_back(
      fmt::format("{}: {}{}", outcome, message, run.ends_at_limit() ? "; later ones may be harder (--impacts)" : ""));
  std::erase(notes, "");
  return notes;
}

Value point_value(const ResponsePoint& point) {
  const ResponseExtremes whole = point.whole();
  const auto fields = [](const Extremes& primary, const Extremes& residual, const Extremes& all, double error) {
    return Value::Fields{
        {"maximax", all.maximax()},     {"error_estimate", std::isfinite(error) ? Value(rounded_up(error)) : Value()},
        {"positive", all.high},         {"negative", all.low},
        {"primary", primary.maximax()}, {"residual", residual.maximax()}};
  };
  return Value::Fields{{"frequency", point.frequency},
                       {"pseudo_velocity", fields(point.primary.pseudo_velocity, point.residual.pseudo_velocity,
                                                  whole.pseudo_velocity, point.pseudo_velocity_error)},
                       {"acceleration", fields(point.primary.acceleration, point.residual.acceleration,
                                               whole.acceleration, point.acceleration_error)}};
}

Value envelopes_value(const ShockRun& run) {
  Value::List list;
  for (std::size_t i = 0; i < run.envelopes.size(); ++i) {
    if (!run.envelopes[i]) continue;
    list.emplace_back(Value::Fields{{"probe", run.probes[i].name},
                                    {"pseudo_velocity", run.envelopes[i]->pseudo_velocity},
                                    {"acceleration_over_omega", run.envelopes[i]->acceleration_over_omega}});
  }
  return list;
}

/// How the model that comes first ended.
void add_outcome(const ShockRun& run, Report& report) {
  const auto [outcome, message] = run.ending();
  report.fields["outcome"] = outcome;
  report.fields["message"] = message;
  if (run.continuous) {
    report.fields["warnings"] = run.continuous->planned.warnings;
    const std::string facets = facet_words(run.scene, run.continuous->planned.run);
    if (!facets.empty()) report.fields["warnings"].push_back(facets);
    report.fields["shortfall"] = text_or_nothing(shortfall(run.scene, run.continuous->planned));
  } else {
    report.fields["shortfall"] = text_or_nothing(shortfall(run.scene, *run.discrete_run));
  }
}

/// A curve to compare with, over the frequencies of the panel's rows.
void add_line(const std::string& name, const char* unit, const auto& at, PicturePanel& panel) {
  panel.columns.push_back({name, unit, name});
  for (auto& row : panel.rows) row.push_back(at(row.front()));
  panel.plot.curves.push_back({.x = "frequency", .y = name, .legend = name, .style = FigureCurve::Style::dotted});
}

/// What each probe reads along the body's axes, a panel each.
std::vector<PicturePanel> history_panels(const ShockRun& run, double rate) {
  const Grid grid = shock_history_grid(run, rate);
  std::vector<PicturePanel> panels;
  for (const Probe& probe : run.probes) {
    PicturePanel& panel = panels.emplace_back(PicturePanel{.columns = {{"time", "s", "after the first touch-down"}}});
    panel.plot.y_label = probe.name + " [g]";
    std::vector<std::size_t> places{0};
    for (const char* const axis : axis_names) {
      const std::string name = probe.name + "_" + axis;
      places.push_back(
          static_cast<std::size_t>(std::ranges::find(grid.columns, name, &Column::name) - grid.columns.begin()));
      panel.columns.push_back({axis, "g", probe.name + " along " + axis});
      panel.plot.curves.push_back({.x = "time", .y = axis, .legend = axis});
    }
    for (const Row& row : grid.rows) {
      std::vector<double>& numbers = panel.rows.emplace_back();
      for (const std::size_t place : places) {
        const double* const number = row[place].value.number();
        const double unit = place == 0 ? 1 : standard_gravity;
        numbers.push_back(number ? *number / unit : no_number);
      }
    }
  }
  if (!panels.empty()) panels.back().plot.x_label = "time after the first touch-down [s]";
  return panels;
}

std::string probe_words(const std::vector<Probe>& probes) {
  std::string words;
  for (const Probe& probe : probes) words += (words.empty() ? "probes: " : "; ") + place_words(probe);
  return words + ", body frame";
}

}  // namespace

std::vector<Column> shock_columns() {
  std::vector<Column> columns{word_column("probe", "probe", "name of the point"),
                              {"n", "n", "", "number of the impact, from 1"},
                              {"start", "t", "s", "time of touch-down, after that of impact 1"},
                              {"duration", "contact", "s", "how long anything touches"}};
  std::vector<Column> errors{error_column(columns[2])};
  const auto add = [&](const Column& column) {
    columns.push_back(column);
    errors.push_back(error_column(column));
  };
  for (const ShockQuantity& quantity : quantities) add(column_of(quantity, false));
  add({"sensitivity", "∂", "",
       "∂ ln(peak)/∂ ln k_G with c_G/k_G held: 1/2 for a face, 1/3 for an edge, 1/4 for a corner that lands alone; of "
       "a "
       "half-space ∂/∂ ln E*: 1/2 for a face, 2/5 for a ball, 1/3 for a corner"});
  add({"indentation", "depth", "m", "greatest depth of a point of the body below the ground"});
  for (const ShockQuantity& quantity : quantities) {
    if (quantity.in_discrete) add(column_of(quantity, true));
  }
  columns.push_back({"closure", "", "", "distance of ∫a dt from ΔV, over that, with a from the forces"});
  columns.push_back({"predictable", "", "", "whether errors have not grown so far that another sequence may follow"});
  columns.insert(columns.end(), errors.begin(), errors.end());
  return columns;
}

std::vector<Column> spectrum_columns() {
  std::vector<Column> columns{
      word_column("probe", "probe", "name of the point"),
      word_column("axis", "axis", "of the body, along which the base moves"),
      word_column("model", "model", "of the impacts"),
      word_column("blows", "blows", "impacts that are in it: 1, 1-2, …, or flat: one impact at 0°"),
      {"frequency", "f", "Hz", "undamped natural frequency of the oscillator"},
      {"pseudo_velocity", "ω|z|", "m/s", "largest relative displacement times ω, during the impacts or after them"},
      {"acceleration", "|a|", "m/s²", "largest absolute acceleration of the oscillator's mass"},
      {"acceleration_g", "|a|", "g", "the same in units of 9.80665 m/s²"}};
  for (const char* part : {"", "primary_", "residual_"}) {
    const std::string when = *part == '\0' ? "" : *part == 'p' ? ", until the last impact ends" : ", after it";
    for (const auto& [name, unit] : {std::pair{"pseudo_velocity", "m/s"}, {"acceleration", "m/s²"}}) {
      for (const char* sign : {"positive", "negative"}) {
        columns.push_back({fmt::format("{}{}_{}", part, name, sign), "", unit,
                           fmt::format("{} value of {}{}", *sign == 'p' ? "largest" : "least", name, when), false});
      }
    }
  }
  columns.push_back(error_column(columns[5]));
  columns.push_back(error_column(columns[6]));
  columns.push_back({"required_g", "required", "g", "acceleration by --required"});
  columns.push_back({"over_required", "over it", "dB", "20 lg of the acceleration over that"});
  return columns;
}

Grid spectrum_grid(const std::vector<NamedSpectrum>& spectra, int digits, const ShockView& view) {
  Grid grid{spectrum_columns(), {}, 5};
  for (Column& column : grid.columns) {
    if (column.name.ends_with("required_g") || column.name == "over_required") column.shown = view.required.has_value();
  }
  for (const NamedSpectrum& one : spectra) {
    for (const ResponsePoint& point : one.spectrum->points) grid.rows.push_back(point_row(one, point, digits, view));
  }
  return grid;
}

std::vector<NamedSpectrum> wholes_of(const std::vector<NamedSpectrum>& spectra) {
  std::vector<NamedSpectrum> wholes;
  for (const NamedSpectrum& one : spectra) {
    if (one.spectrum->blows == Blows::flat) continue;
    const auto same = std::ranges::find_if(
        wholes, [&](const NamedSpectrum& other) { return other.model == one.model && other.probe == one.probe; });
    if (same == wholes.end()) wholes.push_back(one);
    else if (one.spectrum->impacts > same->spectrum->impacts) *same = one;
  }
  return wholes;
}

std::vector<std::string> required_words(const std::vector<NamedSpectrum>& spectra, const ShockView& view,
                                        double quality) {
  std::vector<std::string> all;
  for (const NamedSpectrum& one : spectra) {
    if (!view.required) break;
    const auto margin = margin_over(*view.required, *one.spectrum);
    all.push_back(fmt::format("{} along {}{}, {}, {}, beside {}: {}", one.probe, one.axis,
                              spectra.size() > 1 ? ", " + one.model : "", part_words(*one.spectrum),
                              quality_words(quality), view.required->path,
                              margin ? margin->words() : "no frequency in common"));
  }
  return all;
}

void add_spectrum_fields(const std::vector<NamedSpectrum>& compared, const ShockRequest& request, const ShockView& view,
                         Report& report) {
  if (request.filter) {
    report.fields["filter"] = Value::Fields{{"design_frequency", request.filter->design},
                                            {"cut_off", request.filter->cut_off()},
                                            {"words", request.filter->words()}};
  }
  if (!view.required) return;
  const auto known = [](std::optional<bool> is) { return is ? Value(*is) : Value(); };
  const auto end = [](const SpectrumMargin::End& at) {
    return Value::Fields{{"decibels", at.decibels.value},
                         {"error_estimate", error_or_nothing(at.decibels)},
                         {"frequency", at.frequency}};
  };
  Value::List list;
  for (const NamedSpectrum& one : compared) {
    const auto margin = margin_over(*view.required, *one.spectrum);
    if (!margin) continue;
    list.emplace_back(Value::Fields{{"probe", one.probe},
                                    {"axis", one.axis},
                                    {"model", one.model},
                                    {"blows", blows_word(*one.spectrum)},
                                    {"least", end(margin->least)},
                                    {"most", end(margin->most)},
                                    {"reached", known(margin->is_reached())},
                                    {"kept", known(margin->is_kept())}});
  }
  report.fields["required"] = Value::Fields{{"file", view.required->path}, {"spectra", list}};
}

Grid spectrum_digest(const std::vector<std::vector<NamedSpectrum>>& shown, int digits, const ShockView& view) {
  Grid digest{{word_column("probe", "probe", ""), {"frequency", "f", "Hz"}}, {}, 2};
  if (shown.empty()) return digest;
  for (const char* unit : {"m/s", "g"}) {
    for (const NamedSpectrum& one : shown.front())
      digest.columns.push_back({words_of(one, shown.front()), words_of(one, shown.front()), unit});
  }
  if (view.required) {
    const std::string of = words_of(wholes_of(shown.front()).front(), shown.front());
    digest.columns.push_back({"required", "required", "g"});
    digest.columns.push_back({"over it", of + " over it", "dB"});
  }
  for (const std::vector<NamedSpectrum>& of_probe : shown) {
    for (std::size_t i = 0; !of_probe.empty() && i < of_probe.front().spectrum->points.size(); ++i) {
      Row row{Cell(of_probe.front().probe), Cell(of_probe.front().spectrum->points[i].frequency, 4)};
      for (const bool is_acceleration : {false, true}) {
        for (const NamedSpectrum& one : of_probe)
          row.push_back(measured_cell(maximax(one.spectrum->points[i], is_acceleration), std::min(digits, 4)));
      }
      if (view.required) {
        for (const Cell& cell : required_cells(wholes_of(of_probe).front().spectrum->points[i], view))
          row.push_back(cell);
      }
      digest.rows.push_back(row);
    }
  }
  return digest;
}

Value spectrum_values(const std::vector<NamedSpectrum>& spectra, double quality) {
  Value::List list;
  for (const NamedSpectrum& one : spectra) {
    Value::List points;
    for (const ResponsePoint& point : one.spectrum->points) points.push_back(point_value(point));
    list.emplace_back(Value::Fields{{"probe", one.probe},
                                    {"axis", one.axis},
                                    {"model", one.model},
                                    {"blows", blows_word(*one.spectrum)},
                                    {"quality", quality},
                                    {"points", points}});
  }
  return list;
}

std::vector<PicturePanel> spectrum_panels(const std::vector<NamedSpectrum>& shown, const ShockView& view) {
  std::vector<PicturePanel> panels;
  if (shown.empty()) return panels;
  for (const bool is_acceleration : {false, true}) {
    PicturePanel panel{.columns = {{"frequency", "Hz", "natural frequency"}}};
    panel.plot.logarithmic_x = panel.plot.logarithmic_y = true;
    panel.plot.y_label = is_acceleration ? "largest acceleration [g]"
                                         : fmt::format("{} along {} [m/s]", shown.front().probe, shown.front().axis);
    for (const ResponsePoint& point : shown.front().spectrum->points) panel.rows.push_back({point.frequency});
    for (const NamedSpectrum& one : shown) {
      const std::string name = fmt::format("v{}", panel.columns.size());
      const std::string legend = words_of(one, shown);
      panel.columns.push_back({name, is_acceleration ? "g" : "m/s", legend});
      for (std::size_t i = 0; i < panel.rows.size(); ++i)
        panel.rows[i].push_back(maximax(one.spectrum->points[i], is_acceleration).value);
      panel.plot.curves.push_back(
          {.x = "frequency",
           .y = name,
           .legend = legend,
           .style = one.model == shown.front().model ? FigureCurve::Style::line : FigureCurve::Style::dashed});
    }
    if (view.severity && !is_acceleration)
      add_line(
          "severity", "m/s", [&](double) { return *view.severity; }, panel);
    if (view.required && is_acceleration) {
      const auto asked = [&](double frequency) {
        const auto value = view.required->at(frequency);
        return value ? *value / standard_gravity : no_number;
      };
      add_line("required", "g", asked, panel);
    }
    panels.push_back(std::move(panel));
  }
  panels.back().plot.x_label = "natural frequency [Hz]";
  return panels;
}

std::string quality_words(double quality) {
  return std::isfinite(quality) ? fmt::format("Q = {}", shortest(quality)) : "undamped";
}

Report shock_report(const ShockRun& run, const ShockView& view) {
  constexpr const char* titles[] = {"what each impact does to points of the body",
                                    "response spectra at points of the body",
                                    "each impact as a test pulse, at points of the body"};
  const bool continuous = run.continuous.has_value();
  Report report = begun_report("shock", titles[static_cast<std::size_t>(view.rows)]);
  const Model model = continuous ? Model::continuous : Model::discrete;
  report.head = scene_head(run.scene, model);
  const std::string facets = continuous ? facet_words(run.scene, run.continuous->planned.run) : "";
  if (!facets.empty()) report.head.push_back(facets);
  report.head.push_back(probe_words(run.probes));
  if (run.request.filter)
    report.head.push_back(fmt::format("peak, width{} and spectra are filtered: {}; |ΔV|{} as computed",
                                      view.rows == ShockRows::pulses ? ", T" : "", run.request.filter->words(),
                                      view.parts.empty() ? " is" : " and a part's response to the blow itself are"));
  if (const std::string far = probe_doubts(run.scene, run.probes); !far.empty())
    report.head.insert(report.head.begin(), far);
  report.notes = notes_of(run, view);
  const Grid impacts = impacts_of(run);
  const Grid pulses = pulse_grid(pulses_of(run), run.scene.accuracy.digits, view.parts);
  if (const std::string least = least_margin_words(pulses, view.parts); !least.empty()) report.notes.push_back(least);
  report.grid = view.rows == ShockRows::pulses ? pulses : impacts;
  if (view.rows == ShockRows::spectra) {
    report.grid = spectrum_grid(named_spectra(run), run.scene.accuracy.digits, view);
    report.digest = spectrum_digest(shown_spectra(run), run.scene.accuracy.digits, view);
  }
  if (view.rate) {
    report.grid = shock_history_grid(run, *view.rate);
    report.digest.reset();
    report.fields["history"] = row_objects(report.grid);
  }
  report.fields["model"] = continuous ? "continuous" : "discrete";
  report.fields["scene"] = scene_value(run.scene, model);
  report.fields["scene"][probe_table] = probe_fields(run.probes);
  report.fields["body"] = body_value(run.scene, model);
  report.fields["impacts"] = row_objects(impacts);
  report.fields["spectra"] = spectrum_values(named_spectra(run), run.request.quality);
  report.fields["envelopes"] = envelopes_value(run);
  report.fields["pulses"] = pulse_fields(pulses, view.parts);
  add_spectrum_fields(compared_spectra(run), run.request, view, report);
  add_outcome(run, report);
  report.fields["discrete_reason"] = text_or_nothing(run.discrete_reason);
  if (run.parted.from > 0)
    report.fields["parted"] = Value::Fields{{"from", run.parted.from}, {"reason", run.parted.reason}};
  return report;
}

Picture shock_picture(const ShockRun& run, const ShockView& view, std::optional<std::size_t> of_probe) {
  Picture picture{.what = fmt::format("Response spectra, {}", quality_words(run.request.quality)),
                  .scene = run.scene.summary(run.continuous ? Model::continuous : Model::discrete)};
  if (view.rate && run.continuous) {
    picture.what = fmt::format("Specific forces at the probes, body axes, at {} Hz", shortest(*view.rate));
    picture.panels = history_panels(run, *view.rate);
    return picture;
  }
  for (std::size_t probe = 0; probe < run.probes.size(); ++probe) {
    if (of_probe && probe != *of_probe) continue;
    std::vector<NamedSpectrum> shown = shown_spectra(run, probe);
    const Spectrum* const discrete = run.whole(probe, false);
    if (!shown.empty() && run.continuous && discrete && run.parted.are_one(discrete->impacts))
      shown.push_back(named(run, *discrete));
    for (PicturePanel& panel : spectrum_panels(shown, view)) picture.panels.push_back(std::move(panel));
  }
  for (const FragilePart& part : view.parts) {
    if (auto panel = boundary_panel(pulses_of(run), part)) picture.panels.push_back(std::move(*panel));
  }
  return picture;
}

}  // namespace clatter::validation

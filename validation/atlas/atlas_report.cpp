// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/atlas/atlas_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analytic/base/angle.hpp"
#include "validation/output/number.hpp"
#include "validation/run/scene_value.hpp"

namespace clatter::validation {
namespace {

using analytic::degrees_per_radian;
using namespace analytic::near_flat;

constexpr std::size_t most_atlas_rows = 10'000;
constexpr std::size_t most_shown = 24;

const TwoContacts& two_of(const Atlas& atlas) { return std::get<TwoContacts>(atlas.body.contacts); }

/// "121/49 = 2.469388", "2", or the number alone.
std::string number_words(double number) {
  const std::string fraction = as_fraction(number);
  if (fraction.empty()) return significant(number, 10);
  return fraction == shortest(std::round(number)) ? fraction : fraction + " = " + significant(number, 7);
}

const char* name_of(End end) { return end == End::a ? "a" : "b"; }

bool is_symmetric(const Atlas& atlas) {
  const TwoContacts& two = two_of(atlas);
  return std::fabs(two.arm_a - two.arm_b) <= 1e-12 * (two.arm_a + two.arm_b);
}

/// The largest velocity change of a struck corner, over all tilts, and where.
struct Amplification {
  double value = 0, share = 0, second = 0;
  std::size_t impact = 0;
};

Amplification amplification_of(const TiltSectors& tilts) {
  Amplification most;
  for (const TiltSector& sector : tilts.sectors) {
    const std::size_t i = sector.hardest();
    const double value = sector.strikes[i].approach;
    if (value > most.value * (1 + 1e-12)) most = {value, 0, most.second, i + 1};
    if (value >= most.value * (1 - 1e-12) && i + 1 == most.impact) most.share += sector.share();
    if (sector.strikes.size() > 1) most.second = std::fmax(most.second, sector.strikes[1].approach);
  }
  return most;
}

Amplification amplification_of(const Atlas& atlas) {
  if (!atlas.in_plane()) return amplification_of(atlas.tilts);
  Amplification most;
  for (const auto* strikes : {&atlas.first_a, &atlas.first_b}) {
    for (std::size_t i = 0; i < strikes->size(); ++i) {
      const double value = (*strikes)[i].approach;
      if (value > most.value * (1 + 1e-12)) most = {value, 0, most.second, i + 1};
    }
    if (strikes->size() > 1) most.second = std::fmax(most.second, (*strikes)[1].approach);
  }
  return most;
}

std::string critical_words(const Atlas& atlas) {
  if (!atlas.critical) {
    return atlas.in_plane()
               ? "never infinitely many impacts, at any restitution e > 0"
               : "infinitely many impacts: none found, at 127 restitutions e > 0 and 16 directions of the tilt";
  }
  const auto& [e, error, cycle] = *atlas.critical;
  std::string turns;
  for (const int corner : cycle) turns += fmt::format("{}{}", turns.empty() ? "" : " ", corner + 1);
  const std::string shown = error > 1e-12 ? significant(e, 3) : significant(e, 12);
  return atlas.in_plane() ? fmt::format("infinitely many impacts if and only if e <= e_c = {}", shown)
                          : fmt::format("infinitely many impacts up to e_c = {}, where corners {} strike in turn",
                                        shown, turns.empty() ? "in no cycle" : turns);
}

/// "P₁ : P₂ : P₃ = ½ : 1 : ½" of impulses that are fractions; else empty.
std::string ratio_words(const std::vector<PlanarStrike>& strikes) {
  std::string names, values;
  if (strikes.size() > 9) return "";
  for (std::size_t i = 0; i < strikes.size(); ++i) {
    const std::string value = as_fraction(strikes[i].impulse);
    if (value.empty()) return "";
    const std::string index{"₁₂₃₄₅₆₇₈₉", i * 3, 3};
    names += (i == 0 ? "P" : " : P") + index;
    values += (i == 0 ? "" : " : ") + value;
  }
  return names + " = " + values + ", in units of m|v|";
}

std::string count_words(const std::optional<long long>& count) {
  return count ? std::to_string(*count) : "infinitely many";
}

std::vector<std::string> plane_notes(const Atlas& atlas) {
  std::vector<std::string> notes;
  const std::string ratio = atlas.count_a ? ratio_words(atlas.first_a) : "";
  if (!ratio.empty()) notes.push_back(ratio);
  const std::string other =
      is_symmetric(atlas) ? "" : fmt::format(" if a strikes first, {} if b does", count_words(atlas.count_b));
  notes.push_back(fmt::format("impacts: {}{}; wedge of {}°", count_words(atlas.count_a), other,
                              significant(wedge_angle(two_of(atlas)) * degrees_per_radian, 10)));
  return notes;
}

std::vector<std::string> space_notes(const Atlas& atlas) {
  std::size_t fewest = most_atlas_rows, most = 0;
  bool goes_on = false;
  for (const TiltSector& sector : atlas.tilts.sectors) {
    fewest = std::min(fewest, sector.strikes.size());
    most = std::max(most, sector.strikes.size());
    goes_on = goes_on || sector.goes_on;
  }
  const std::string range = (fewest == most ? "" : fmt::format("{} to ", fewest)) + (goes_on ? "at least " : "");
  std::vector<std::string> notes{
      fmt::format("impacts: {}{}, in {} sectors of the tilt's direction", range, most, atlas.tilts.sectors.size())};
  if (const double open = atlas.tilts.open_share; open > 1e-12) {
    notes.push_back(fmt::format("{} of the directions, in sectors below 1e-9 rad, are left out", significant(open, 2)));
  }
  return notes;
}

/// The velocity change of the corner that is struck over that of the flat drop, (1 + e)|v|.
std::vector<std::string> amplification_words(const Atlas& atlas) {
  const Amplification most = amplification_of(atlas);
  std::string share;
  if (most.share > 0) share = fmt::format(", for {} % of the directions", significant(100 * most.share, 4));
  return {
      fmt::format("second impact: at most {} times the velocity change of the flat drop", number_words(most.second)),
      fmt::format("largest: {} times, at impact {}{}", number_words(most.value), most.impact, share)};
}

Report atlas_frame(const Atlas& atlas) {
  Report report = begun_report("atlas", "clattering close to flat");
  report.head = {
      atlas.name + ": " + atlas.body.words,
      fmt::format("e = {}; no gravity, no friction, the limit of no tilt", shortest(atlas.body.restitution))};
  report.fields["model"] = "discrete";
  report.fields["limit"] = "near-flat";
  report.fields["body"] = atlas.name;
  report.fields["restitution"] = atlas.body.restitution;
  if (atlas.scene) report.fields["scene"] = scene_value(*atlas.scene, Model::discrete);
  const Amplification most = amplification_of(atlas);
  report.fields["amplification"] =
      Value::Fields{{"value", most.value}, {"impact", most.impact}, {"second", most.second}};
  report.fields["critical_restitution"] = atlas.critical ? Value(atlas.critical->restitution) : Value();
  if (atlas.critical) report.fields["critical_restitution_error"] = atlas.critical->error;
  return report;
}

void add_plane_rows(const Atlas& atlas, Report& report) {
  report.grid.columns = atlas_plane_columns();
  report.grid.leading = 2;
  for (const auto* strikes : {&atlas.first_a, &atlas.first_b}) {
    if (strikes == &atlas.first_b && is_symmetric(atlas)) continue;
    for (std::size_t i = 0; i < strikes->size(); ++i) {
      const PlanarStrike& strike = (*strikes)[i];
      report.grid.rows.push_back({Cell(strikes == &atlas.first_a ? "a" : "b"), Cell(i + 1), Cell(name_of(strike.end)),
                                  Cell(strike.approach, 10), Cell(strike.impulse, 10),
                                  Cell(as_fraction(strike.impulse))});
    }
  }
  report.fields["wedge_angle_deg"] = wedge_angle(two_of(atlas)) * degrees_per_radian;
  report.fields["impacts"] = atlas.count_a ? Value(*atlas.count_a) : Value();
  report.fields["impacts_b_first"] = atlas.count_b ? Value(*atlas.count_b) : Value();
}

void add_space_rows(const Atlas& atlas, Report& report) {
  report.grid.columns = atlas_space_columns();
  for (const TiltSector& sector : atlas.tilts.sectors) {
    std::string order, approaches, impulses;
    for (const CornerStrike& strike : sector.strikes) {
      const char* const gap = order.empty() ? "" : " ";
      order += fmt::format("{}{}", gap, strike.corner + 1);
      approaches += gap + shortest(strike.approach);
      impulses += gap + shortest(strike.impulse);
    }
    const CornerStrike& hardest = sector.strikes[sector.hardest()];
    const std::size_t count = sector.strikes.size();
    report.grid.rows.push_back({Cell(sector.from * degrees_per_radian, 7), Cell(sector.to * degrees_per_radian, 7),
                                Cell(sector.share(), 4),
                                sector.goes_on ? Cell(Value(count), fmt::format("≥ {}", count)) : Cell(count),
                                Cell(order, count > 12 ? order.substr(0, 24) + "…" : order),
                                count > 1 ? Cell(sector.strikes[1].approach, 7) : Cell(), Cell(hardest.approach, 7),
                                Cell(sector.hardest() + 1), Cell(approaches), Cell(impulses), Cell(sector.goes_on)});
  }
}

/// The widest sectors, in order, where there are many.
void shorten(Report& report) {
  if (report.grid.rows.size() <= 2 * most_shown) return;
  Grid digest = report.grid;
  const bool is_plane = digest.columns.front().name == "first";
  if (!is_plane) {
    const auto width = [](const Row& row) { return -*row[2].value.number(); };
    std::ranges::stable_sort(digest.rows, {}, width);
  }
  digest.rows.resize(most_shown);
  if (!is_plane) std::ranges::stable_sort(digest.rows, {}, [](const Row& row) { return *row[0].value.number(); });
  report.notes.push_back(fmt::format("{} of {} rows, {}; --format csv has all", most_shown, report.grid.rows.size(),
                                     is_plane ? "the first" : "the widest sectors"));
  report.digest = std::move(digest);
}

}  // namespace

std::string as_fraction(double number) {
  constexpr int most_parts = 200;
  for (int parts = 1; parts <= most_parts; ++parts) {
    const double whole = std::round(number * parts);
    if (!(std::fabs(number * parts - whole) <= 1e-11 * parts) || !(std::fabs(whole) < 1e6)) continue;
    if (parts == 1) return shortest(whole);
    return parts == 2 && whole == 1 ? "½" : fmt::format("{}/{}", shortest(whole), parts);
  }
  return "";
}

Atlas make_atlas(FlatBody body, const std::string& name, const std::optional<Scene>& scene) {
  Atlas atlas{.body = std::move(body), .name = name, .scene = scene};
  const double e = atlas.body.restitution;
  if (const auto* const two = std::get_if<TwoContacts>(&atlas.body.contacts)) {
    atlas.first_a = strikes(*two, e, End::a, most_atlas_rows);
    atlas.first_b = strikes(*two, e, End::b, most_atlas_rows);
    atlas.count_a = strike_count(*two, e, End::a);
    atlas.count_b = strike_count(*two, e, End::b);
    const double critical = critical_restitution(*two);
    if (critical > 0) atlas.critical = {critical, 1e-15, {0, 1}};
  } else {
    const auto& footprint = std::get<Footprint>(atlas.body.contacts);
    atlas.tilts = tilt_sectors(footprint, e);
    atlas.critical = critical_restitution(footprint);
  }
  return atlas;
}

std::vector<Column> atlas_plane_columns() {
  return {word_column("first", "first", "the end that strikes first"),
          {"impact", "impact", "", "number of the impact"},
          word_column("end", "end", "that strikes: a the left contact, b the right one"),
          {"approach", "Δv/Δv₀", "", "velocity change of the end over that of the flat drop, (1 + e)|v|"},
          {"impulse", "P/(m|v|)", "", "normal impulse in units of m|v|"},
          word_column("fraction", "fraction", "the impulse as a fraction, where it is one")};
}

std::vector<Column> atlas_space_columns() {
  std::vector<Column> columns{
      {"tilt_from_deg", "tilt from", "°", "direction in which the body is higher: where the sector begins"},
      {"tilt_to_deg", "to", "°", "where it ends"},
      {"share", "share", "", "of all directions"},
      {"impacts", "impacts", "", "how many there are"},
      word_column("order", "order", "the corners in the order in which they strike"),
      {"second", "second", "", "velocity change of the second corner over that of the flat drop, (1 + e)|v|"},
      {"largest", "largest", "", "the largest of them"},
      {"at", "at", "", "number of the impact that has it"},
      word_column("approaches", "", "velocity change at each impact over that of the flat drop"),
      word_column("impulses", "", "impulse of each impact in units of m|v|"),
      {"goes_on", "", "", "whether there are more impacts than are listed"}};
  for (std::size_t i = 8; i < columns.size(); ++i) columns[i].shown = false;
  return columns;
}

Report atlas_report(const Atlas& atlas) {
  Report report = atlas_frame(atlas);
  if (atlas.in_plane()) add_plane_rows(atlas, report);
  else add_space_rows(atlas, report);
  report.fields["rows"] = row_objects(report.grid);
  report.notes = atlas.in_plane() ? plane_notes(atlas) : space_notes(atlas);
  for (const std::string& words : amplification_words(atlas)) report.notes.push_back(words);
  report.notes.push_back(critical_words(atlas));
  if (!atlas.in_plane()) {
    report.fields["open_share"] = atlas.tilts.open_share;
    if (atlas.critical) {
      Value::List cycle;
      for (const int corner : atlas.critical->cycle) cycle.emplace_back(corner + 1);
      report.fields["critical_cycle"] = cycle;
    }
  }
  shorten(report);
  return report;
}

namespace {

constexpr std::size_t drawn_strikes = 6;

std::string strike_column(std::size_t i) { return fmt::format("impact_{}", i + 1); }

void add_strike_columns(PicturePanel& panel, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    panel.columns.push_back({strike_column(i), "1", fmt::format("velocity change at impact {}", i + 1)});
    panel.plot.curves.push_back(
        {.x = panel.columns.front().name, .y = strike_column(i), .legend = fmt::format("impact {}", i + 1)});
  }
}

/// Two rows for each sector, at its ends, and one without numbers.
PicturePanel tilt_panel(const Atlas& atlas) {
  PicturePanel panel{.columns = {{"tilt_deg", "°", "direction of the tilt"}, {"impacts", "1", "number of impacts"}},
                     .rows = {},
                     .plot = {.title = "",
                              .x_label = "direction in which the body is higher [°]",
                              .y_label = "velocity change/(1 + e)|v|",
                              .curves = {},
                              .y = {0, no_number}}};
  add_strike_columns(panel, drawn_strikes);
  for (const TiltSector& sector : atlas.tilts.sectors) {
    std::vector<double> row{0, static_cast<double>(sector.strikes.size())};
    for (std::size_t i = 0; i < drawn_strikes; ++i) {
      row.push_back(i < sector.strikes.size() ? sector.strikes[i].approach : no_number);
    }
    for (const double end : {sector.from, sector.to}) {
      row[0] = end * degrees_per_radian;
      panel.rows.push_back(row);
    }
    std::fill(row.begin() + 1, row.end(), no_number);  // no line leads to the next sector's numbers
    panel.rows.push_back(row);
  }
  panel.plot.x = {atlas.tilts.sectors.front().from * degrees_per_radian,
                  atlas.tilts.sectors.back().to * degrees_per_radian};
  return panel;
}

/// Strikes one after the other.
PicturePanel strike_panel(const Atlas& atlas) {
  PicturePanel panel{.columns = {{"impact", "1", "number of the impact"}, {"impulse", "1", "impulse"}},
                     .rows = {},
                     .plot = {.title = "",
                              .x_label = "impact",
                              .y_label = "P/(m|v|)",
                              .curves = {{.x = "impact", .y = "impulse", .style = FigureCurve::Style::sticks}},
                              .y = {0, no_number},
                              .whole_x = true}};
  for (std::size_t i = 0; i < atlas.first_a.size(); ++i) {
    panel.rows.push_back({static_cast<double>(i + 1), atlas.first_a[i].impulse});
  }
  panel.plot.x = {0, static_cast<double>(atlas.first_a.size()) + 1};
  return panel;
}

/// Second and largest velocity change of the same contacts with a radius of gyration of another size.
std::vector<double> at_gyration(const Atlas& atlas, double factor) {
  Atlas other{.body = atlas.body, .name = "", .scene = {}};
  if (atlas.in_plane()) {
    auto& two = std::get<TwoContacts>(other.body.contacts);
    two.gyration *= factor;
    other.first_a = strikes(two, atlas.body.restitution, End::a, drawn_strikes);
    other.first_b = strikes(two, atlas.body.restitution, End::b, drawn_strikes);
  } else {
    auto& footprint = std::get<Footprint>(other.body.contacts);
    footprint.mobility /= factor * factor;
    other.tilts = tilt_sectors(footprint, atlas.body.restitution, drawn_strikes);
  }
  const Amplification most = amplification_of(other);
  return {factor, most.second, most.value};
}

PicturePanel shape_panel(const Atlas& atlas) {
  constexpr int points = 60;
  PicturePanel panel{.columns = {{"gyration", "1", "radius of gyration over the body's"},
                                 {"second", "1", "velocity change of the second corner"},
                                 {"largest", "1", "the largest velocity change"}},
                     .rows = {},
                     .plot = {.title = "",
                              .x_label = "radius of gyration over that of the body",
                              .y_label = "velocity change/(1 + e)|v|",
                              .curves = {{.x = "gyration", .y = "second", .legend = "second impact, at most"},
                                         {.x = "gyration", .y = "largest", .legend = "largest of the first six"}},
                              .x = {0.5, 2}}};
  for (int i = 0; i <= points; ++i) panel.rows.push_back(at_gyration(atlas, 0.5 * std::pow(4, i / (1. * points))));
  return panel;
}

}  // namespace

Picture atlas_picture(const Atlas& atlas) {
  return {.what = "Clattering close to flat",
          .scene = {fmt::format("{}, e = {}", atlas.name, shortest(atlas.body.restitution))},
          .panels = {atlas.in_plane() ? strike_panel(atlas) : tilt_panel(atlas), shape_panel(atlas)}};
}

}  // namespace clatter::validation

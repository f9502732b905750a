// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "analytic/base/angle.hpp"
#include "analytic/base/errors.hpp"
#include "analytic/near_flat/footprint.hpp"
#include "analytic/near_flat/two_contacts.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/number.hpp"
#include "validation/output/picture.hpp"
#include "validation/output/report.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/run/scene_value.hpp"

namespace clatter::validation {
namespace {

/// In the plane the contacts from left to right; in space the corners counter-clockwise as seen from above.
using FlatContacts = std::variant<analytic::near_flat::TwoContacts, analytic::near_flat::Footprint>;

struct FlatBody {
  FlatContacts contacts;
  std::string words;  ///< "two contacts, …", "face of 4 corners …"
  double restitution = 1;
};

using analytic::near_flat::Footprint;
using analytic::near_flat::TwoContacts;
using analytic::space::Vector3;

constexpr double in_face = 1e-7;  // of the reach: corners of a file have seven digits

/// Corners turned by the attitude, the lowest first.
std::vector<Vector3> turned_corners(const analytic::space::Body& body, const analytic::space::Quaternion& attitude) {
  if (!body.rims.empty()) throw analytic::OutsideModelError("a round end lands on a rim, which has no corners");
  std::vector<Vector3> corners;
  for (const Vector3& vertex : body.vertices) corners.push_back(attitude * vertex);
  const auto lowest =
      std::ranges::min_element(corners, [](const Vector3& a, const Vector3& b) { return a.z() < b.z(); });
  if (corners.size() < 3) throw analytic::OutsideModelError("the body has no face to land on");
  std::iter_swap(corners.begin(), lowest);
  return corners;
}

/// Upward normal of the plane through the lowest corner that comes down first, and then about the edge.
Vector3 landing_normal(const std::vector<Vector3>& corners, double reach) {
  const Vector3& pivot = corners.front();
  const auto slope = [&](const Vector3& p) {
    const double run = (p - pivot).head<2>().norm();
    return run > in_face * reach ? (p - pivot).z() / run : INFINITY;
  };
  const auto second = std::min_element(corners.begin() + 1, corners.end(),
                                       [&](const Vector3& a, const Vector3& b) { return slope(a) < slope(b); });
  const Vector3 edge = (*second - pivot).normalized();
  const Vector3 across = Vector3::UnitZ().cross(edge).normalized(), up = edge.cross(across);
  double least = INFINITY;
  Vector3 normal = up;
  for (const Vector3& p : corners) {
    const double run = (p - pivot).dot(across), rise = (p - pivot).dot(up);
    if (!(std::fabs(run) > in_face * reach) || !(rise / std::fabs(run) < least)) continue;
    least = rise / std::fabs(run);
    normal = (run * up - rise * across).normalized() * (run > 0 ? 1 : -1);
  }
  if (!std::isfinite(least)) throw analytic::OutsideModelError("the body has no face to land on");
  return normal;
}

TwoContacts landing_contacts(const analytic::PlanarBody& body, const analytic::Angle& inclination) {
  std::vector<analytic::ContactPoint> points;
  for (int i = 0; i < body.vertex_count; ++i)
    points.push_back(body.contact_point(i, inclination.sine, inclination.cosine));
  std::ranges::sort(points, {}, &analytic::ContactPoint::normal);
  const analytic::ContactPoint low = points.front();
  const auto slope = [&](const analytic::ContactPoint& p) {
    return std::atan2(p.normal - low.normal, std::fabs(p.tangential - low.tangential));
  };
  const analytic::ContactPoint other = *std::min_element(
      points.begin() + 1, points.end(), [&](const auto& a, const auto& b) { return slope(a) < slope(b); });
  const double x = other.tangential - low.tangential, z = other.normal - low.normal;
  const double length = std::hypot(x, z), sign = x < 0 ? -1 : 1;
  const double place = sign * (low.tangential * x + low.normal * z) / length;
  const double left = std::min(place, place + sign * length);
  return {-left, left + length, std::sqrt(body.gyration_square)};
}

/// The face of a body's hull on which it comes to lie when it is turned least about its lowest corner and then about
/// the edge that comes down: axis x along that of the body (or y where x is upright).
/// @param attitude  body to world
/// @throws OutsideModelError for a body with rims, whose footprint is no polygon, or without a face
Footprint landing_face(const analytic::space::Body& body, const analytic::space::Quaternion& attitude) {
  const std::vector<Vector3> corners = turned_corners(body, attitude);
  const double reach = body.reach();
  const Vector3 normal = landing_normal(corners, reach);
  analytic::space::Matrix3 frame;  // columns: axes of the footprint
  Vector3 x = attitude * Vector3::UnitX();
  if (std::fabs(x.dot(normal)) > 0.99) x = attitude * Vector3::UnitY();
  frame.col(0) = (x - x.dot(normal) * normal).normalized();
  frame.col(1) = normal.cross(frame.col(0));
  frame.col(2) = normal;
  Footprint found;
  for (const Vector3& corner : corners) {
    if (std::fabs((corner - corners.front()).dot(normal)) > in_face * reach) continue;
    found.corners.emplace_back(frame.col(0).dot(corner), frame.col(1).dot(corner));
  }
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const auto& corner : found.corners) middle += corner / static_cast<double>(found.corners.size());
  std::ranges::sort(found.corners, {}, [&](const Eigen::Vector2d& r) {
    const double angle = std::atan2(r.y() - middle.y(), r.x() - middle.x());
    return angle < -3.14159265 ? -angle : angle;  // −π is π
  });
  const analytic::space::Matrix3 turn = frame.transpose() * attitude.toRotationMatrix();
  found.mobility = analytic::near_flat::slope_mobility(body.mass, turn * body.inertia * turn.transpose());
  found.mobility = ((found.mobility + found.mobility.transpose()) / 2).eval();
  return found;
}

/// The contacts of a scene: a rod's in the plane, and with `in_plane` those of any outline; else the landing face.
/// @throws as landing_face(), DiscreteBody; OutsideModelError for a restitution that changes with the speed
FlatBody flat_body(const Scene& scene, bool in_plane) {
  const analytic::ImpactLaw law = discrete_law(scene).law;
  if (law.law == analytic::RestitutionLaw::viscoelastic) {
    throw analytic::OutsideModelError(
        "close to flat strikes have one restitution, and damped ground has another for each speed: give --restitution");
  }
  DiscreteBody body(scene);
  FlatBody found{.contacts = TwoContacts(), .words = "", .restitution = law.restitution};
  if (in_plane || scene.body.shape == BodyScene::Shape::rod) {
    const auto& outline = body.outline();
    if (!outline) throw analytic::OutsideModelError("the body has no outline in the plane y = 0");
    const TwoContacts two = landing_contacts(*outline, analytic::Angle::from_degrees(scene.angle_deg));
    found.words = fmt::format("two contacts, a = {} m and b = {} m from the centre of mass, radius of gyration {} m",
                              significant(two.arm_a, 6), significant(two.arm_b, 6), significant(two.gyration, 6));
    found.contacts = two;
    return found;
  }
  const Footprint face = landing_face(body.in_space(), scene.touch_attitude());
  found.words = fmt::format("face of {} corners [m]:", face.corners.size());
  for (std::size_t i = 0; i < face.corners.size() && i < 12; ++i) {
    found.words += fmt::format("{} {} ({}, {})", i == 0 ? "" : ",", i + 1, significant(face.corners[i].x(), 4),
                               significant(face.corners[i].y(), 4));
  }
  found.contacts = face;
  return found;
}

/// A thin uniform plate in the form of a triangle; all of them are one and the same close to flat.
FlatBody flat_triangle(double restitution) {
  analytic::space::Matrix3 inertia = analytic::space::Matrix3::Zero();
  inertia.diagonal() << 1. / 18, 1. / 18, 1. / 9;  // of the right triangle with legs 1, mass 1
  inertia(0, 1) = inertia(1, 0) = 1. / 36;
  return {.contacts = Footprint{.corners = {{-1. / 3, -1. / 3}, {2. / 3, -1. / 3}, {-1. / 3, 2. / 3}},
                                .mobility = analytic::near_flat::slope_mobility(1, inertia)},
          .words = "thin uniform triangle of any form, corners 1 to 3",
          .restitution = restitution};
}

/// A body with its strikes.
struct Atlas {
  FlatBody body;
  std::string name;                                                     ///< as given, for heads
  std::optional<Scene> scene;                                           ///< that the body is of
  std::vector<analytic::near_flat::PlanarStrike> first_a{}, first_b{};  ///< in the plane, 10 000 at most
  std::optional<long long> count_a{}, count_b{};                        ///< nothing: infinitely many
  analytic::near_flat::TiltSectors tilts{};                             ///< in space
  std::optional<analytic::near_flat::CriticalRestitution> critical{};

  [[nodiscard]] bool in_plane() const { return body.contacts.index() == 0; }
};

std::vector<Column> atlas_plane_columns();
std::vector<Column> atlas_space_columns();
std::string as_fraction(double number);

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
  if (const double open = atlas.tilts.open_share; open > 1e-12)
    notes.push_back(fmt::format("{} of the directions, in sectors below 1e-9 rad, are left out", significant(open, 2)));
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

/// "121/49" of a number that is a fraction with a denominator up to 200 to 1e-11 of it, "½"; else empty.
std::string as_fraction(double number) {
  constexpr int most_parts = 200;
  for (int parts = 1; parts <= most_parts; ++parts) {
    const double whole = std::round(number * parts);
    if (!(std::fabs(number * parts - whole) <= 1e-11 * std::fabs(whole)) || !(std::fabs(whole) < 1e6)) continue;
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

/// In the plane a row per strike, for either end first; in space a row per sector of the tilts.
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
                     .plot = {.x_label = "direction in which the body is higher [°]",
                              .y_label = "velocity change/(1 + e)|v|",
                              .y = {0, no_number}}};
  add_strike_columns(panel, drawn_strikes);
  for (const TiltSector& sector : atlas.tilts.sectors) {
    std::vector<double> row{0, static_cast<double>(sector.strikes.size())};
    for (std::size_t i = 0; i < drawn_strikes; ++i)
      row.push_back(i < sector.strikes.size() ? sector.strikes[i].approach : no_number);
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
                     .plot = {.x_label = "impact",
                              .y_label = "P/(m|v|)",
                              .curves = {{.x = "impact", .y = "impulse", .style = FigureCurve::Style::sticks}},
                              .y = {0, no_number},
                              .whole_x = true}};
  for (std::size_t i = 0; i < atlas.first_a.size(); ++i)
    panel.rows.push_back({static_cast<double>(i + 1), atlas.first_a[i].impulse});
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
                     .plot = {.x_label = "radius of gyration over that of the body",
                              .y_label = "velocity change/(1 + e)|v|",
                              .curves = {{.x = "gyration", .y = "second", .legend = "second impact, at most"},
                                         {.x = "gyration", .y = "largest", .legend = "largest of the first six"}},
                              .x = {0.5, 2}}};
  for (int i = 0; i <= points; ++i) panel.rows.push_back(at_gyration(atlas, 0.5 * std::pow(4, i / (1. * points))));
  return panel;
}

/// Strikes over the directions of the tilt, and over shape: over the radii of gyration, from half to twice the body's.
Picture atlas_picture(const Atlas& atlas) {
  return {.what = "Clattering close to flat",
          .scene = {fmt::format("{}, e = {}", atlas.name, shortest(atlas.body.restitution))},
          .panels = {atlas.in_plane() ? strike_panel(atlas) : tilt_panel(atlas), shape_panel(atlas)}};
}

struct AtlasInput {
  SceneFlags scene;
  bool in_plane = false;
  OutputChoice output;
  PlotChoice plot;
};

/// A body by its name: the flags that it stands for.
struct NamedBody {
  const char *name, *shape, *size;
};
constexpr std::array named_bodies{NamedBody{"rod", "rod", nullptr},
                                  NamedBody{"box", "box", nullptr},
                                  NamedBody{"cube", "box", "1x1x1"},
                                  NamedBody{"square", "box", "1x1x1e-6"},
                                  NamedBody{"rectangle", "box", "2x1x1e-6"},
                                  NamedBody{"phone", "box", "0.10566x0.04394x0.01905"},
                                  NamedBody{"handset", "box", "0.15x0.075x0.008"}};
const char* const triangle = "triangle";

/// Takes the name of a body as flags; what is typed goes before it.  The drop lands flat where nothing says otherwise.
void take_name(SceneFlags& flags) {
  for (const NamedBody& body : named_bodies) {
    if (flags.source != body.name) continue;
    if (is_given(flags, "--body")) throw BadInput(fmt::format("--body: {} is the body already", body.name));
    flags.source.clear();
    flags.texts.at("--body") = body.shape;
    if (body.size && !is_given(flags, "--size")) flags.texts.at("--size") = body.size;
    break;
  }
  if (flags.source == triangle) {
    for (const char* const flag : {"--body", "--size", "--length", "--radius", "--inertia", "--centre", "--mass"}) {
      if (is_given(flags, flag)) throw BadInput(fmt::format("{}: a thin triangle has none that matters", flag));
    }
    flags.source.clear();
  }
  const bool is_turned =
      is_given(flags, "--angle") || is_given(flags, "--attitude") || is_given(flags, "--orientation");
  if (flags.source.empty() && !is_turned) flags.texts.at("--angle") = "0";
}

Atlas atlas_of(const AtlasInput& input) {
  SceneFlags flags = input.scene;
  const std::string name = flags.source;
  take_name(flags);
  const Scene scene = read_scene_flags(flags);
  if (name != triangle) return make_atlas(flat_body(scene, input.in_plane), name.empty() ? "body" : name, scene);
  if (input.in_plane) throw BadInput("--plane: a triangle has no outline in the plane");
  return make_atlas(flat_triangle(discrete_law(scene).law.restitution), name, {});
}

int run_atlas(const AtlasInput& input) {
  const Atlas atlas = atlas_of(input);
  check_files(input.output, plot_files(input.plot));
  PlotFile plot(input.plot);
  const Report report = atlas_report(atlas);
  write_report(input.output, report);
  if (plot.is_wanted()) {
    std::vector<std::string> head{report.title};
    head.insert(head.end(), report.head.begin(), report.head.end());
    plot.write(atlas_picture(atlas), head);
  }
  return 0;
}

}  // namespace

Command atlas_command() {
  return command_of<AtlasInput>(run_atlas, [](Command& command, AtlasInput& input) {
    add_scene_flags(command, input.scene, Model::discrete);
    command.arguments.front().help =
        "rod, box, cube, square, rectangle, triangle, phone (of the cases), handset; or a scene file or the name of a "
        "case";
    command.add_flag("--plane", input.in_plane, "of a box or mesh, tilts in the plane y = 0 alone", "Scene");
    add_output_options(command, input.output);
    add_plot_options(command, input.plot);
    command.footer =
        "Example: clatter atlas handset --restitution 0.5 --plot atlas.svg\n"
        "Of a box or mesh that face lands which the drop's attitude brings down (--orientation 1 to 6 of a box).\n"
        "Gravity, friction and motion of the scene are left out: in the limit of no tilt they change nothing.";
    command.columns = {{"atlas", atlas_space_columns}, {"atlas-plane", atlas_plane_columns}};
  });
}

}  // namespace clatter::validation

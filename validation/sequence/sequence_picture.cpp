// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sequence/sequence_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "analytic/space/flight/free_flight.hpp"
#include "analytic/space/landing/tilted_outcomes.hpp"
#include "analytic/space/sequence/impact_rows.hpp"
#include "validation/output/number.hpp"
#include "validation/run/discrete_scene.hpp"

namespace clatter::validation {
namespace {

namespace space = analytic::space;
using Style = FigureCurve::Style;

constexpr std::size_t most_classes = 7;
constexpr const char* class_colours[most_classes] = {blue, red, green, pink, palette::ochre, palette::sky, "#8c564b"};
constexpr const char* grey = "#bbbbbb";
// Radii of the ring, and of the corners drawn inside it.
constexpr double inner = 0.62, corners_at = 0.42;
constexpr double aspect = 3.4;  // of a panel of three, so that a ring is round

/// Outcomes of one colour.
struct OutcomeClass {
  std::string legend{}, colour{};
  std::vector<space::TiltSector> sectors{};
  double share = 0;

  void add(const space::TiltedOutcome& outcome) {
    sectors.insert(sectors.end(), outcome.sectors.begin(), outcome.sectors.end());
    share += outcome.share;
  }
};

std::string percent(double share) { return significant(100 * share, 2) + " %"; }

/// The largest shares one by one, the others together.
std::vector<OutcomeClass> classes_by_share(const std::vector<space::TiltedOutcome>& outcomes) {
  std::vector<OutcomeClass> classes;
  OutcomeClass others{.colour = grey};
  for (std::size_t i = 0; i < outcomes.size(); ++i) {
    const space::GroupImpact& impact = outcomes[i].impact;
    if (i >= most_classes) {
      others.add(outcomes[i]);
      continue;
    }
    classes.push_back({.legend = fmt::format("{}: Vₙ {} m/s, |Ω| {} rad/s", percent(outcomes[i].share),
                                             significant(impact.velocity_after.z(), 3),
                                             significant(impact.angular_velocity_after.norm(), 3)),
                       .colour = class_colours[i],
                       .sectors = {}});
    classes.back().add(outcomes[i]);
  }
  others.legend = fmt::format("{}: {} further outcomes", percent(others.share),
                              outcomes.size() - std::min(outcomes.size(), most_classes));
  if (!others.sectors.empty()) classes.push_back(std::move(others));
  return classes;
}

/// By equal parts of the range of rebound speeds.
std::vector<OutcomeClass> classes_by_speed(const std::vector<space::TiltedOutcome>& outcomes) {
  const auto speed = [](const space::TiltedOutcome& outcome) { return outcome.impact.velocity_after.z(); };
  const auto [slow, fast] = std::ranges::minmax(outcomes, {}, speed);
  const double low = speed(slow), part = (speed(fast) - low) / most_classes;
  std::vector<OutcomeClass> classes(most_classes);
  for (const space::TiltedOutcome& outcome : outcomes) {
    const double place = part > 0 ? (speed(outcome) - low) / part : 0;
    classes[std::min(static_cast<std::size_t>(place), most_classes - 1)].add(outcome);
  }
  for (std::size_t i = 0; i < most_classes; ++i) {
    const double from = low + static_cast<double>(i) * part;
    classes[i].legend = fmt::format("{}: Vₙ {} to {} m/s", percent(classes[i].share), significant(from, 3),
                                    significant(from + part, 3));
    classes[i].colour = class_colours[i];
  }
  std::erase_if(classes, [](const OutcomeClass& one) { return one.sectors.empty(); });
  return classes;
}

/// Rows of class, x, y; a row without y ends an outline.
class RingRows {
 public:
  void add_sector(double kind, const space::TiltSector& sector) {
    const int parts = 2 + static_cast<int>(sector.width * 30);  // chords of two degrees
    for (const double radius : {1.0, inner}) {
      for (int i = 0; i <= parts; ++i) {
        const int step = radius == 1 ? i : parts - i;
        add_point(kind, radius, sector.from + sector.width * step / parts);
      }
    }
    rows.push_back({kind, 0, no_number});
  }
  void add_point(double kind, double radius, double direction) {
    rows.push_back({kind, radius * std::cos(direction), radius * std::sin(direction)});
  }

  std::vector<std::vector<double>> rows;
};

/// The corners, or the rim, as seen from above, the furthest from the centre of mass at `corners_at`.
void add_corners(const space::ImpactRow& row, double kind, RingRows& ring) {
  const space::Corner& first = row.corners.front();
  if (first.radius > 0) {
    for (int i = 0; i <= 60; ++i) ring.add_point(kind, corners_at, std::numbers::pi * i / 30);
    return;
  }
  double reach = 0;
  for (const space::Corner& corner : row.corners)
    reach = std::fmax(reach, (row.before.attitude * corner.place).head<2>().norm());
  for (const space::Corner& corner : row.corners) {
    const space::Vector3 arm = row.before.attitude * corner.place;
    ring.add_point(kind, corners_at * arm.head<2>().norm() / reach, std::atan2(arm.y(), arm.x()));
  }
}

PicturePanel ring_panel(const space::ImpactRow& row, std::size_t number, const space::OutcomeSet& set) {
  const std::vector<OutcomeClass> classes =
      set.varies ? classes_by_speed(set.outcomes) : classes_by_share(set.outcomes);
  PicturePanel panel{
      .columns = {{"class", "1", "number of the class of outcomes"},
                  {"x", "1", "along x, to the right"},
                  {"y", "1", "along y, into the page"}},
      .plot = {.x_label = fmt::format("impact {}: outcome over the direction in which the tilted body lies "
                                      "higher; x to the right, y upward, from above",
                                      number),
               .y_label = "small tilts",
               .x = {-1.25 * aspect, 1.25 * aspect},
               .y = {-1.25, 1.25},
               .equal_scales = true,
               .no_axes = true,
               .ring = true}};
  RingRows ring;
  const auto add_curve = [&](const std::string& legend, Style style, const std::string& colour) {
    const auto kind = static_cast<double>(panel.plot.curves.size());
    panel.plot.curves.push_back(
        {.x = "x", .y = "y", .legend = legend, .style = style, .where = {{"class", kind}}, .colour = colour});
    return kind;
  };
  for (const OutcomeClass& one : classes) {
    const double kind = add_curve(one.legend, Style::regions, one.colour);
    for (const space::TiltSector& sector : one.sectors) ring.add_sector(kind, sector);
  }
  const bool is_rim = row.corners.front().radius > 0;
  add_corners(row, add_curve(is_rim ? "rim" : "corners", is_rim ? Style::line : Style::marks, ink), ring);
  panel.rows = std::move(ring.rows);
  return panel;
}

/// The ring of the first landing of several corners, or of a level rim, that tilts decide; nothing if there is none.
/// Directions are those in which the tilted corners lie higher, counter-clockwise from x, the view from above.  The
/// seven outcomes with the largest shares have a colour of their own; where they vary with the direction (level rim),
/// seven classes of equal range of the body's rebound speed.
std::optional<PicturePanel> tilt_panel(const space::Drop& drop, std::span<const space::ImpactRow> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (!rows[i].group) continue;
    const space::OutcomeSet set = tilted_outcomes(drop.body, rows[i].before, rows[i].corners, drop.law);
    if (set.outcomes.size() > 1) return ring_panel(rows[i], i + 1, set);
  }
  return std::nullopt;
}

using analytic::ImpactRow;
using analytic::PlanarBody;
using analytic::PlanarVelocity;
using analytic::Sequence;

/// Lowest point of each half of the body [m].
struct EndHeights {
  double a = std::numeric_limits<double>::infinity();
  double b = std::numeric_limits<double>::infinity();
  [[nodiscard]] double lowest() const { return std::min(a, b); }
};

/// The body in free flight through the place of an impact, before (times below 0) or after it:
///     z_j = z + V t − g t²/2 + x_j sin α + z_j′ cos α,   α = α₀ − Ω t.
struct Flight {
  const PlanarBody& body;
  const ImpactRow& row;
  PlanarVelocity velocity;
  double gravity;

  [[nodiscard]] EndHeights at(double t) const {
    const double centre = row.centre_height + t * (velocity.normal - gravity / 2 * t);
    const double angle = row.inclination - velocity.angular * t;
    EndHeights heights;
    for (int j = 0; j < body.vertex_count; ++j) {
      double& end = body.vertices[static_cast<std::size_t>(j)].x < 0 ? heights.a : heights.b;
      end = std::min(end, centre + body.contact_point(j, std::sin(angle), std::cos(angle)).normal);
    }
    return heights;
  }
  /// Time in (0, t] or [t, 0) at which the ground is reached again, where it lies above at t_above and below at t.
  [[nodiscard]] double ground_between(double t_above, double t_below) const {
    for (int i = 0; i < 60; ++i) {
      const double middle = (t_above + t_below) / 2;
      (at(middle).lowest() < 0 ? t_below : t_above) = middle;
    }
    return t_above;
  }
};

class HeightCurve {
 public:
  HeightCurve(const analytic::Drop& drop, const Sequence& sequence, const TimeWindow& window)
      : body_(drop.body), gravity_(drop.gravity), rows_(sequence.rows), whole_(whole_time(sequence)),
        width_(std::min(whole_, window.to - window.from)) {
    add_part(flight(rows_.front(), rows_.front().before), -approach());
    std::reverse(samples_.begin(), samples_.end());
    for (std::size_t i = 0; i + 1 < rows_.size(); ++i)
      add_whole(flight(rows_[i], rows_[i].impact.after), rows_[i + 1].start - rows_[i].start);
    add_part(flight(rows_.back(), rows_.back().impact.after), 0.2 * whole_);
  }
  /// Rows of time, height of end a, height of end b.
  [[nodiscard]] const std::vector<std::vector<double>>& samples() const { return samples_; }

 private:
  [[nodiscard]] Flight flight(const ImpactRow& row, const PlanarVelocity& velocity) const {
    return {body_, row, velocity, gravity_};
  }

  /// From the first impact to the last; of a single one the time in which the body moves by its own size.
  [[nodiscard]] double whole_time(const Sequence& sequence) const {
    const double last = sequence.tail ? sequence.tail->end_time : rows_.back().start;
    if (last > 0) return last;
    const ImpactRow& row = rows_.front();
    const double reach = body_.reach();
    return 5 * reach /
           std::max({std::fabs(row.before.normal), std::fabs(row.impact.after.normal),
                     reach * std::fabs(row.impact.after.angular)});
  }

  /// What is shown of the fall to the first impact: at most from its release on.
  [[nodiscard]] double approach() const {
    const double speed = -rows_.front().before.normal;
    return gravity_ > 0 && speed > 0 ? std::min(0.1 * whole_, speed / gravity_) : 0.1 * whole_;
  }

  /// Points for the share of the picture's width, more for a body that spins.
  [[nodiscard]] int parts(const Flight& flight, double duration) const {
    const double share = std::fabs(duration) / width_, turns = std::fabs(flight.velocity.angular * duration) / 6;
    return static_cast<int>(std::clamp(1000 * share, 6.0, 60.0) + std::min(24 * turns, 3000.0));
  }

  void add(const Flight& flight, double t) {
    const EndHeights heights = flight.at(t);
    samples_.push_back({flight.row.start + t, heights.a, heights.b});
  }

  void add_whole(const Flight& flight, double duration) {
    const int count = parts(flight, duration);
    for (int i = 0; i <= count; ++i) add(flight, duration * i / count);
  }

  /// As far as the body stays above the ground.
  void add_part(const Flight& flight, double duration) {
    const int count = parts(flight, duration);
    const double depth = 1e-9 * body_.reach();  // of what is still rounding
    add(flight, 0);
    for (int i = 1; i <= count; ++i) {
      const double t = duration * i / count;
      if (flight.at(t).lowest() < -depth) {
        if (i > 1) add(flight, flight.ground_between(duration * (i - 1) / count, t));
        return;
      }
      add(flight, t);
    }
  }

  PlanarBody body_;
  double gravity_;
  const std::vector<ImpactRow>& rows_;
  double whole_, width_;  ///< time of the sequence, and of the picture
  std::vector<std::vector<double>> samples_;
};

PicturePanel height_panel(const analytic::Drop& drop, const Sequence& sequence, const TimeWindow& window) {
  PicturePanel panel{
      .columns = {{"time", "s", "time since the first impact"},
                  {"a", "m", "height of the lowest point of end a"},
                  {"b", "m", "height of the lowest point of end b"},
                  {"end", "m", "time at which the impacts end"}},
      .rows = clipped(HeightCurve(drop, sequence, window).samples(), window),
      .plot = {.y_label = "lowest point [m]",
               .curves = {{.x = "time", .y = "a", .legend = "end a"}, {.x = "time", .y = "b", .legend = "end b"}},
               .y = {0, no_number}}};
  if (!sequence.tail) return panel;
  double highest = 0;
  for (const auto& row : panel.rows) highest = std::max({highest, row[1], row[2]});
  for (const double height : {0.0, highest})
    panel.rows.push_back({sequence.tail->end_time, no_number, no_number, height});
  panel.plot.curves.push_back({.x = "time", .y = "end", .legend = "the impacts end", .style = Style::dashed});
  return panel;
}

/// Column of the impulse: 1 for end a, 2 for end b, 3 for both.
std::size_t side_of(const PlanarBody& body, const ImpactRow& row) {
  std::size_t side = 0;
  for (int j = 0; j < body.vertex_count; ++j) {
    if (row.vertices >> j & 1) side |= body.vertices[static_cast<std::size_t>(j)].x < 0 ? 1u : 2u;
  }
  return side;
}

PicturePanel impulse_panel(const PlanarBody& body, const Sequence& sequence) {
  PicturePanel panel{
      .columns = {{"time", "s", "time since the first impact"},
                  {"a", "N·s", "normal impulse at end a"},
                  {"b", "N·s", "normal impulse at end b"},
                  {"both", "N·s", "normal impulse at both ends"},
                  {"rest", "N·s", "sum of the normal impulses of all further impacts"}},
      .plot = {.x_label = "time since the first impact [s]", .y_label = "normal impulse [N·s]", .y = {0, no_number}}};
  bool is_used[5] = {};
  for (const ImpactRow& row : sequence.rows) {
    auto& numbers = panel.rows.emplace_back(std::vector<double>{row.start, no_number, no_number, no_number, no_number});
    numbers[side_of(body, row)] = row.impact.normal_impulse;
    is_used[side_of(body, row)] = true;
  }
  if (sequence.tail) {
    panel.rows.push_back({sequence.tail->end_time, no_number, no_number, no_number, sequence.tail->normal_impulse});
    is_used[4] = true;
  }
  const char* const legends[] = {"", "at end a", "at end b", "at both ends", "all further impacts"};
  for (std::size_t i = 1; i < 5; ++i) {
    if (!is_used[i] && i > 2) continue;  // a and b keep their colours
    panel.plot.curves.push_back(
        {.x = "time", .y = panel.columns[i].name, .legend = legends[i], .style = Style::sticks});
  }
  return panel;
}

// In space.

using SpaceSequence = space::Sequence;

/// From the first impact to the last, with a fifth of that after it.
double shown_time(const SpaceSequence& sequence, const space::Body& body) {
  const double last = sequence.tail ? sequence.tail->end_time : sequence.rows.back().start;
  const space::Impact& impact = sequence.rows.back().impact;
  const double reach = body.reach();
  const double speed = std::max(impact.velocity_after.norm(), reach * impact.angular_velocity_after.norm());
  return last > 0 ? 1.2 * last : 5 * reach / speed;
}

/// Height of the hull's lowest point [m].
double lowest_point(const space::Body& body, const space::State& state) {
  double lowest = std::numeric_limits<double>::infinity();
  const auto height = [&](const space::Vector3& place) { return (state.attitude * place).z(); };
  for (const auto& vertex : body.vertices) lowest = std::min(lowest, height(vertex));
  for (const auto& rim : body.rims)
    lowest =
        std::min(lowest, height(rim.centre) - rim.radius * std::sqrt(std::max(0.0, 1 - std::pow(height(rim.axis), 2))));
  const space::Vector3 up = state.attitude.conjugate() * space::Vector3::UnitZ();
  for (const auto& [centre, semiaxes] : body.ellipsoids)
    lowest = std::min(lowest, height(centre) - semiaxes.cwiseProduct(up).norm());
  return state.position.z() + lowest;
}

/// Rows of time, height of the centre of mass, height of the lowest point.
std::vector<std::vector<double>> space_heights(const space::Drop& drop, const SpaceSequence& sequence) {
  const space::PrincipalAxes principal(drop.body.inertia);
  const double end = shown_time(sequence, drop.body), depth = 1e-9 * drop.body.reach();  // of what is still rounding
  std::vector<std::vector<double>> samples;
  for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
    const space::ImpactRow& row = sequence.rows[i];
    const bool is_last = i + 1 == sequence.rows.size();
    const double duration = (is_last ? end : sequence.rows[i + 1].start) - row.start;
    space::State after = row.before;
    after.velocity = row.impact.velocity_after;
    after.angular_velocity = row.impact.angular_velocity_after;
    const space::FreeFlight flight(principal, after, drop.gravity);
    const double turns = after.angular_velocity.norm() * duration / 6;
    const int count = static_cast<int>(std::clamp(1000 * duration / end, 6.0, 60.0) + std::min(24 * turns, 3000.0));
    for (int k = 0; k <= count; ++k) {
      const space::State state = flight.at(duration * k / count);
      const double low = lowest_point(drop.body, state);
      if (is_last && k > 0 && low < -depth) return samples;
      samples.push_back({row.start + duration * k / count, state.position.z(), std::max(low, 0.0)});
    }
  }
  return samples;
}

PicturePanel space_height_panel(const space::Drop& drop, const SpaceSequence& sequence, const TimeWindow& window) {
  return {.columns = {{"time", "s", "time since the first impact"},
                      {"centre", "m", "height of the centre of mass"},
                      {"lowest", "m", "height of the lowest point"}},
          .rows = clipped(space_heights(drop, sequence), window),
          .plot = {.y_label = "height [m]",
                   .curves = {{.x = "time", .y = "centre", .legend = "centre of mass"},
                              {.x = "time", .y = "lowest", .legend = "lowest point"}},
                   .y = {0, no_number}}};
}

/// Who strikes in each impact, and where there are more than a legend takes, that somebody does.
std::vector<std::string> striking_corners(const Run& run) {
  constexpr std::size_t most = 8;
  std::vector<std::string> names;
  for (const Impact& impact : run.impacts) {
    const bool is_end = impact.corners.find_first_not_of("ab ") == std::string::npos;  // of a rod or a disc
    const std::string one = (is_end ? "end " : "corner ") + impact.corners;
    names.push_back(impact.touches == 1 ? one : is_end ? "both ends" : "several corners");
  }
  if (std::set<std::string>(names.begin(), names.end()).size() > most) names.assign(names.size(), "a corner");
  return names;
}

PicturePanel space_impulse_panel(const Run& run) {
  PicturePanel panel{
      .columns = {{"time", "s", "time since the first impact"}},
      .plot = {.x_label = "time since the first impact [s]", .y_label = "normal impulse [N·s]", .y = {0, no_number}}};
  const std::vector<std::string> names = striking_corners(run);
  std::vector<std::string> legends(names);
  std::sort(legends.begin(), legends.end());
  legends.erase(std::unique(legends.begin(), legends.end()), legends.end());
  if (run.tail) legends.emplace_back("all further impacts");
  for (const std::string& legend : legends) {
    panel.columns.push_back({fmt::format("impulse_{}", panel.columns.size()), "N·s", "normal impulse: " + legend});
    panel.plot.curves.push_back(
        {.x = "time", .y = panel.columns.back().name, .legend = legend, .style = Style::sticks});
  }
  const auto add = [&](double time, const std::string& legend, double normal) {
    auto& numbers = panel.rows.emplace_back(panel.columns.size(), no_number);
    numbers[0] = time;
    numbers[1 + static_cast<std::size_t>(std::find(legends.begin(), legends.end(), legend) - legends.begin())] = normal;
  };
  for (std::size_t i = 0; i < names.size(); ++i)
    add(run.impacts[i].value.start, names[i], run.impacts[i].value.impulse[2]);
  if (run.tail) add(run.tail->sum.value.start, legends.back(), run.tail->sum.value.impulse[2]);
  return panel;
}

/// Body, drop and impact.
std::vector<std::string> words_of(const Scene& scene) {
  std::vector<std::string> words = scene.summary(Model::discrete);
  words.push_back(law_words(scene, {}));
  return words;
}

/// No impulse may fall into the window; its axis has a range all the same.
void show_window(Picture& picture, const TimeWindow& window) {
  for (PicturePanel& panel : picture.panels) panel.plot.x = {window.from, window.to};
  double largest = 0;
  for (const auto& row : picture.panels[1].rows)
    for (std::size_t i = 1; i < row.size(); ++i) largest = std::fmax(largest, row[i]);
  picture.panels[1].plot.y = {0, 1.05 * largest};
}

/// The last impact, or the end of infinitely many, is not on the frame.
void show_all(Picture& picture, double end) {
  const auto& samples = picture.panels[0].rows;
  const auto [first, last] = std::minmax_element(samples.begin(), samples.end(),
                                                 [](const auto& one, const auto& other) { return one[0] < other[0]; });
  const double room = 0.02 * ((*last)[0] - (*first)[0]);
  for (PicturePanel& panel : picture.panels) panel.plot.x = {(*first)[0], std::max((*last)[0], end + room)};
}

}  // namespace

Picture sequence_picture(const PreparedScene& prepared, const DiscreteRun& found, const TimeWindow& window) {
  const Run& run = found.run;
  Picture picture{.what = "Impact sequence, discrete model", .scene = words_of(prepared.scene)};
  if (const auto* const drop = std::get_if<analytic::Drop>(&prepared.drop)) {
    const auto& sequence = std::get<Sequence>(found.sequence);
    picture.panels = {height_panel(*drop, sequence, window), impulse_panel(drop->body, sequence)};
  } else {
    const auto& in_space = std::get<SpaceSequence>(found.sequence);
    picture.panels = {space_height_panel(std::get<space::Drop>(prepared.drop), in_space, window),
                      space_impulse_panel(run)};
  }
  if (window.is_all()) show_all(picture, (run.tail ? run.tail->sum : run.impacts.back()).value.start);
  else show_window(picture, window);
  if (const auto* const drop = std::get_if<space::Drop>(&prepared.drop)) {
    auto tilts = tilt_panel(*drop, std::get<SpaceSequence>(found.sequence).rows);
    if (tilts) picture.panels.push_back(std::move(*tilts));
  }
  return picture;
}

}  // namespace clatter::validation

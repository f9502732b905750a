// SPDX-License-Identifier: GPL-3.0-or-later
#include "analytic/space/landing/tilted_outcomes.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <tuple>
#include <utility>
#include <vector>

#include "analytic/base/errors.hpp"
#include "analytic/space/landing/level_rim.hpp"
#include "analytic/space/landing/simultaneous.hpp"

namespace clatter::analytic::space {

namespace {

constexpr double full_turn = 2 * std::numbers::pi;

/// One end of a sector of tilts, after the same strikes as the other.
struct Tilt {
  Vector2 rise;                 ///< g, of no fixed length
  std::vector<double> heights;  ///< of the corners, >= 0
};

/// (1 − s) a + s b.
Tilt between(const Tilt& a, const Tilt& b, double s) {
  Tilt tilt{(1 - s) * a.rise + s * b.rise, a.heights};
  for (std::size_t i = 0; i < tilt.heights.size(); ++i) tilt.heights[i] = (1 - s) * a.heights[i] + s * b.heights[i];
  return tilt;
}

/// Tilts that have given the same strikes so far.
struct Sector {
  Tilt from, to;  ///< counter-clockwise, less than half a turn apart
  StrikingBody struck;

  [[nodiscard]] double width() const {
    const Vector2 &a = from.rise, &b = to.rise;
    return std::atan2(cross(a, b), a.dot(b));
  }
  [[nodiscard]] double middle() const {
    const Vector2 sum = from.rise.normalized() + to.rise.normalized();
    return std::atan2(sum.y(), sum.x());
  }
};

/// Collects the outcomes of the sectors.
class OutcomeCollection {
 public:
  /// @param reach  largest distance of a touching point from the centre of mass [m]
  OutcomeCollection(const State& before, double reach)
      : reach_(reach), scale_(before.velocity.norm() + before.angular_velocity.norm() * reach) {}

  /// Whether they are one outcome: 1e-6 of the velocities.
  [[nodiscard]] bool same(const GroupImpact& a, const GroupImpact& b) const {
    return (a.velocity_after - b.velocity_after).norm() +
               reach_ * (a.angular_velocity_after - b.angular_velocity_after).norm() <=
           1e-6 * scale_;
  }
  /// @param outcome  of one sector
  void add(TiltedOutcome outcome) {
    for (std::size_t i = 0; i < found_.size(); ++i) {
      if (!same(found_[i].impact, outcome.impact)) continue;
      const double share = found_[i].share + outcome.share;
      std::vector<TiltSector> sectors = std::move(found_[i].sectors);
      sectors.push_back(outcome.sectors.front());
      if (outcome.share > widest_[i]) {
        widest_[i] = outcome.share;
        found_[i] = std::move(outcome);
      }
      found_[i].share = share;
      found_[i].sectors = std::move(sectors);
      return;
    }
    widest_.push_back(outcome.share);
    found_.push_back(std::move(outcome));
  }
  [[nodiscard]] std::vector<TiltedOutcome> take() {
    std::ranges::stable_sort(found_, std::greater{}, &TiltedOutcome::share);
    return std::move(found_);
  }

 private:
  double reach_, scale_;
  std::vector<TiltedOutcome> found_;
  std::vector<double> widest_;  ///< share of each outcome's widest sector
};

/// Follows the strikes of all tilts, the widest sector first.
class SectorSearch {
 public:
  SectorSearch(const StrikingBody& struck, std::span<const Corner> touching, const TiltEffort& most,
               OutcomeCollection& found)
      : touching_(touching), most_(most), found_(found), speeds_(touching.size(), 1.0) {
    double reach = 0;
    slow_ = 1e-10 * struck.impact().approach_speed;
    for (const Corner& corner : touching) {
      arms_.push_back(struck.arm(corner.place));
      reach = std::fmax(reach, arms_.back().norm());
      slow_ = std::fmax(slow_, struck.rounding(arms_.back()));
    }
    near_ = least_width * reach;
    constexpr int parts = 3;  // each less than half a turn
    for (int i = 0; i < parts; ++i) {
      const Sector part{tilt(i * full_turn / parts), tilt((i + 1) % parts * full_turn / parts), struck};
      split(part, [this](Sector& sector, std::size_t lowest) { return put_down(sector, lowest); });
    }
  }

  /// @returns the share of the directions that are not followed to the end
  double search() {
    while (!waiting_.empty() && !is_spent()) {
      auto widest = waiting_.extract(std::prev(waiting_.end()));
      follow(widest.mapped());
    }
    for (const auto& [width, sector] : waiting_) open_ += width;
    return open_ / full_turn;
  }

 private:
  static constexpr double least_width = 1e-9;  ///< [rad]

  /// Heights above the centre of mass, but for a constant.
  [[nodiscard]] Tilt tilt(double direction) const {
    Tilt tilt{{std::cos(direction), std::sin(direction)}, {}};
    for (const Vector3& arm : arms_) tilt.heights.push_back(tilt.rise.dot(arm.head<2>()));
    return tilt;
  }
  void wait(Sector sector) {
    const double width = sector.width();
    if (width >= least_width) waiting_.emplace(width, std::move(sector));
    else open_ += std::fmax(width, 0.0);
  }
  /// Strikes until none approaches or the order of the corners splits the sector.
  void follow(Sector& sector) {
    while (find_approach(sector.struck)) {
      if (is_spent()) return wait(std::move(sector));
      const std::size_t first = first_at(sector.from, sector.to);
      if (first_cut(sector, first, 0).at < 1) {
        return split(sector, [this](Sector& part, std::size_t i) { return strike(part, i); });
      }
      if (!strike(sector, first)) return void(open_ += sector.width());
    }
    GroupImpact impact = sector.struck.result();
    impact.is_whole = impact.order.size() == 1;
    const double width = sector.width();
    found_.add({.tilt_direction = sector.middle(),
                .share = width / full_turn,
                .sectors = {{std::atan2(sector.from.rise.y(), sector.from.rise.x()), width}},
                .impact = std::move(impact)});
  }

  /// Sets speeds_ to those of the corners that approach, 0 for the others; whether any does.
  bool find_approach(const StrikingBody& struck) {
    bool any = false;
    for (std::size_t i = 0; i < arms_.size(); ++i) {
      const double speed = -struck.velocity(arms_[i]).z();
      speeds_[i] = speed > slow_ ? speed : 0;
      any = any || speeds_[i] > 0;
    }
    return any;
  }

  [[nodiscard]] double time(const Tilt& tilt, std::size_t i) const { return tilt.heights[i] / speeds_[i]; }

  /// The first corner at one end of a sector; of several the one that is first beside it, then the fastest.
  [[nodiscard]] std::size_t first_at(const Tilt& tilt, const Tilt& then) const {
    const auto order = [&](std::size_t i) { return std::tuple(time(tilt, i), time(then, i), -speeds_[i]); };
    std::size_t first = arms_.size();
    for (std::size_t i = 0; i < arms_.size(); ++i) {
      if (speeds_[i] > 0 && (first == arms_.size() || order(i) < order(first))) first = i;
    }
    return first;
  }

  struct Cut {
    double at = 1;         ///< s of (2); 1: none
    std::size_t next = 0;  ///< the first corner from there on
  };

  /// Where another corner comes before `first`, which is the first from `from` on.
  [[nodiscard]] Cut first_cut(const Sector& sector, std::size_t first, double from) const {
    Cut cut;
    for (std::size_t i = 0; i < arms_.size(); ++i) {
      if (!(speeds_[i] > 0) || !(speeds_[i] * (time(sector.to, first) - time(sector.to, i)) > near_)) continue;
      const double d0 = time(sector.from, i) - time(sector.from, first);
      const double at = std::fmax(d0 / (d0 + time(sector.to, first) - time(sector.to, i)), from);
      if (at < cut.at || (at == cut.at && time(sector.to, i) < time(sector.to, cut.next))) cut = {at, i};
    }
    return cut;
  }

  /// Cuts the sector where the first corner changes, and takes the step of the first corner in each part; those in
  /// which it cannot be taken stay open.
  template <class Step>
  void split(const Sector& sector, Step&& step) {
    double from = 0;
    std::size_t first = first_at(sector.from, sector.to);
    const std::vector<double> speeds = speeds_;  // before the step
    for (bool last = false; !last;) {
      const Cut cut = first_cut(sector, first, from);
      last = !(cut.at < 1);
      Sector part{between(sector.from, sector.to, from), between(sector.from, sector.to, cut.at), sector.struck};
      if (step(part, first)) wait(std::move(part));
      else open_ += part.width();
      speeds_ = speeds;
      from = cut.at;
      first = cut.next;
    }
  }

  /// Takes heights above the lowest corner; true.
  bool put_down(Sector& sector, std::size_t lowest) const {
    for (Tilt* tilt : {&sector.from, &sector.to}) {
      const double least = tilt->heights[lowest];
      for (double& height : tilt->heights) height = std::fmax(height - least, 0.0);
    }
    return true;
  }

  /// At the moment when `first` touches the ground, (1), with those that touch it then; false if the strike cannot be
  /// computed.
  bool strike(Sector& sector, std::size_t first) {
    StrikingBody& struck = sector.struck;
    const double from_passed = time(sector.from, first), to_passed = time(sector.to, first);
    level_.clear();
    for (std::size_t i = 0; i < arms_.size(); ++i) {
      double &at_from = sector.from.heights[i], &at_to = sector.to.heights[i];
      at_from = std::fmax(at_from + struck.velocity(arms_[i]).z() * from_passed, 0.0);
      at_to = std::fmax(at_to + struck.velocity(arms_[i]).z() * to_passed, 0.0);
      if (i != first && !(std::fmax(at_from, at_to) <= near_)) continue;
      at_from = at_to = 0;
      level_.push_back(i);
    }
    try {
      if (level_.size() > 1) settle(struck);
      else strike_corner(struck, first);
    } catch (const NumericalError&) {
      return false;
    } catch (const OutsideModelError&) {
      return false;
    }
    return true;
  }

  void strike_corner(StrikingBody& struck, std::size_t i) {
    struck.strike_at(touching_[i].place, {touching_[i].index});
    ++strikes_;
  }

  /// Strikes with those corners as a whole, if pushes alone can do it.
  bool strike_whole(StrikingBody& struck, const std::vector<std::size_t>& group) {
    std::vector<Corner> corners;
    std::vector<int> points;
    for (const std::size_t i : group) {
      corners.push_back(touching_[i]);
      if (speeds_[i] > 0) points.push_back(touching_[i].index);
    }
    const auto whole = rebound_as_a_whole(struck.body(), struck.state(), corners, struck.law());
    ++strikes_;
    if (struck.law().rubs()) ++rubs_;
    if (!whole) return false;
    struck.push({.impulse = whole->impulse,
                 .moment = whole->moment,
                 .path = whole->path,
                 .tilts = whole->tilts,
                 .path_error = whole->path_error},
                points);
    return true;
  }

  /// The corners of level_ strike by the rules of strike_together(), until none of them approaches.
  void settle(StrikingBody& struck) {
    const Vector3 velocity = struck.state().velocity, rate = struck.state().angular_velocity;
    for (const Settled& one : settled_) {
      if (one.level == level_ && one.velocity == velocity && one.rate == rate) return struck.take(one.after);
    }
    settle_once(struck);
    if (!is_spent()) settled_.push_back({level_, velocity, rate, struck});
  }

  void settle_once(StrikingBody& struck) {
    while (!is_spent() && strike_whole(struck, level_)) {
      if (!find_approach(struck)) return;
    }
    StrikeSeries series(12);
    std::vector<std::size_t> fastest;
    while (!is_spent() && find_approach(struck)) {
      if (series.converges(struck)) continue;
      double most = 0;
      for (const std::size_t i : level_) most = std::fmax(most, speeds_[i]);
      if (!(most > 0)) return;
      fastest.clear();
      std::ranges::copy_if(level_, std::back_inserter(fastest),
                           [&](std::size_t i) { return speeds_[i] >= most - slow_; });
      if (fastest.size() == 1 || !strike_whole(struck, fastest)) strike_corner(struck, fastest.front());
    }
  }

  [[nodiscard]] bool is_spent() const { return strikes_ >= most_.strikes || rubs_ >= most_.rubs; }

  /// Corners that were level, and what became of them: other sectors come to the same.
  struct Settled {
    std::vector<std::size_t> level;
    Vector3 velocity, rate;  ///< before
    StrikingBody after;
  };

  std::span<const Corner> touching_;
  TiltEffort most_;
  OutcomeCollection& found_;
  std::vector<Vector3> arms_;
  std::vector<double> speeds_;
  std::multimap<double, Sector> waiting_;  ///< by their widths
  std::vector<std::size_t> level_;         ///< that touch the ground
  double near_;                            ///< heights that are no larger are none [m]
  double slow_;                            ///< approaches that are no slower count [m/s]
  std::vector<Settled> settled_;
  std::size_t strikes_ = 0, rubs_ = 0;
  double open_ = 0;  ///< [rad]
};

/// Directions of the tilt of a level rim.
constexpr int sampled_directions = 64;

void sample_tilts(const LevelRim& rim, OutcomeCollection& found) {
  for (int i = 0; i < sampled_directions; ++i) {
    constexpr double width = full_turn / sampled_directions;
    const double direction = 0.0123 + i * width;
    found.add({.tilt_direction = direction,
               .share = 1.0 / sampled_directions,
               .sectors = {{direction - width / 2, width}},
               .impact = rim.tilted(direction)});
  }
}

/// How far the outcomes are apart.
void find_spread(const GroupImpact& by_rule, OutcomeSet& set) {
  if (set.outcomes.empty()) return;
  const GroupImpact& some = set.outcomes.front().impact;
  OutcomeRange least{some.velocity_after, some.angular_velocity_after, some.energy_loss}, most = least;
  const auto widen = [&](const GroupImpact& a, const GroupImpact& b) {
    set.velocity_spread = std::fmax(set.velocity_spread, (a.velocity_after - b.velocity_after).norm());
    set.angular_velocity_spread =
        std::fmax(set.angular_velocity_spread, (a.angular_velocity_after - b.angular_velocity_after).norm());
  };
  for (const TiltedOutcome& outcome : set.outcomes) {
    const GroupImpact& one = outcome.impact;
    least = {least.velocity.cwiseMin(one.velocity_after), least.angular_velocity.cwiseMin(one.angular_velocity_after),
             std::fmin(least.energy_loss, one.energy_loss)};
    most = {most.velocity.cwiseMax(one.velocity_after), most.angular_velocity.cwiseMax(one.angular_velocity_after),
            std::fmax(most.energy_loss, one.energy_loss)};
    widen(one, by_rule);
    for (const TiltedOutcome& other : set.outcomes) widen(one, other.impact);
  }
  set.range = {most.velocity - least.velocity, most.angular_velocity - least.angular_velocity,
               most.energy_loss - least.energy_loss};
}

}  // namespace

OutcomeSet tilted_outcomes(const Body& body, const State& before, std::span<const Corner> touching,
                           const ImpactLaw& law, const TiltEffort& most) {
  StrikingBody struck(body, before, law);
  double reach = 0;
  for (const Corner& corner : touching) {
    const Vector3 arm = struck.arm(corner.place);
    struck.know_approach(-struck.velocity(arm).z());
    reach = std::fmax(reach, std::hypot(arm.head<2>().norm() + corner.radius, arm.z()));
  }
  OutcomeCollection found(before, reach);
  OutcomeSet set;
  const Corner* const rim = level_rim(touching);
  if (rim) sample_tilts(LevelRim(body, before, *rim, law), found);
  else set.open_share = SectorSearch(struck, touching, most, found).search();
  set.outcomes = found.take();
  set.varies = rim && set.outcomes.size() > 1;
  const GroupImpact by_rule = strike_together(body, before, touching, law);
  for (const TiltedOutcome& outcome : set.outcomes) {
    if (found.same(outcome.impact, by_rule)) set.convention_share += outcome.share;
  }
  find_spread(by_rule, set);
  return set;
}

}  // namespace clatter::analytic::space

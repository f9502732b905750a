// Error bars of impact_sequence() against event simulations of many digits, run to rest.
//
// CLATTER_BARS_SCENES sets another number of scenes, CLATTER_BARS_SEED another beginning; CLATTER_BARS_REPORT=1 prints every
// number outside its bar.

#include <boost/multiprecision/cpp_bin_float.hpp>
#include <boost/test/unit_test.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdlib>
#include <iostream>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "analytic/errors.hpp"
#include "analytic/sequence.hpp"
#include "tests/analytic/oracle/event_oracle.hpp"

namespace {

using namespace clatter::analytic;
namespace oracle = clatter::oracle;
template <unsigned digits>
using Digits = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>, boost::multiprecision::et_off>;
/// Bounces that have shrunk to 1e-26 leave 28 of these digits to heights.
using Real = Digits<80>;
/// Where gravity has no time to act between bounces, heights shrink much faster than speeds.
using LongReal = Digits<240>;

constexpr int most_impacts = 3000;

int setting(const char* name, int otherwise) {
  const char* text = std::getenv(name);
  return text ? std::atoi(text) : otherwise;
}

struct RandomScene {
  Drop drop;
  oracle::EventBody<Real> body;
  int digits = 6;
  double degrees = 0;
  std::string text;
};

RandomScene random_scene(std::mt19937_64& random) {
  const auto uniform = [&](double low, double high) { return std::uniform_real_distribution<>(low, high)(random); };
  const auto one_of = [&](unsigned n) { return static_cast<int>(random() % n); };
  RandomScene scene;
  const double length = std::pow(10, uniform(-1.2, 0.3)), mass = std::pow(10, uniform(-1, 1)), half = uniform(0.02, 0.4) * length;
  const int shape = one_of(10);
  const Real L = length, h = half;
  const auto corners = [&] {
    for (const int side : {-1, 1}) {
      for (const int end : {-1, 1}) scene.body.vertices.push_back({end * L / 2, side * h});
    }
  };
  if (shape < 3) {
    scene.drop.body = make_rod({.mass = mass, .length = length});
    scene.body = {mass, L * L / 12, {{-L / 2, 0}, {L / 2, 0}}};
  } else if (shape < 5) {
    scene.drop.body = make_rod({.mass = mass, .length = length, .radius = half});
    scene.body = {mass, (3 * h * h + L * L) / 12, {}};
    corners();
  } else {
    scene.drop.body = make_box({.mass = mass, .length = length, .width = length, .thickness = 2 * half});
    scene.body = {mass, (4 * h * h + L * L) / 12, {}};
    corners();
  }
  scene.degrees = uniform(0.5, 89.5);
  scene.drop.inclination = Angle::from_degrees(scene.degrees);
  scene.drop.velocity.normal = -uniform(0.5, 5);
  if (one_of(2)) scene.drop.velocity.tangential = uniform(-2, 2);
  if (one_of(2)) scene.drop.velocity.angular = uniform(-5, 5);
  scene.drop.gravity = one_of(8) ? 9.81 * std::pow(10, uniform(-1, 1)) : 0;
  ImpactLaw& law = scene.drop.law;
  law.restitution = one_of(3) ? uniform(0.001, 0.98) : std::pow(10, uniform(-3, -0.01));
  law.law = static_cast<RestitutionLaw>(one_of(3));
  const int friction = one_of(4);
  if (friction == 1) law.friction = FrictionKind::impulse_ratio, law.friction_value = uniform(-0.2, 0.2);
  if (friction > 1) law.friction = FrictionKind::coulomb, law.friction_value = uniform(0.01, 0.8);
  const int digits[] = {3, 6, 9, 12};
  scene.digits = digits[one_of(4)];
  std::ostringstream text;
  text.precision(17);
  text << "shape " << shape << " m " << mass << " L " << length << " half " << half << " deg " << scene.degrees << " v "
       << scene.drop.velocity.normal << ' ' << scene.drop.velocity.tangential << ' ' << scene.drop.velocity.angular << " g "
       << scene.drop.gravity << " e " << law.restitution << " law " << static_cast<int>(law.law) << " friction "
       << static_cast<int>(law.friction) << ' ' << law.friction_value << " digits " << scene.digits;
  scene.text = text.str();
  return scene;
}

template <class To, class From>
oracle::EventState<To> converted(const oracle::EventState<From>& s) {
  return {To(s.inclination), To(s.normal), To(s.tangential), To(s.angular)};
}

template <class R>
oracle::EventSequence<Real> simulated(const RandomScene& scene) {
  const Drop& drop = scene.drop;
  const oracle::EventLaw<R> law{drop.law.restitution, static_cast<oracle::EventRestitution>(drop.law.law),
                                static_cast<oracle::EventFriction>(drop.law.friction), drop.law.friction_value, drop.gravity};
  oracle::EventBody<R> body{R(scene.body.mass), R(scene.body.gyration_square), {}};
  for (const auto& v : scene.body.vertices) body.vertices.push_back({R(v.x), R(v.z)});
  const R angle = R(scene.degrees) * boost::math::constants::pi<R>() / 180;
  oracle::EventSimulation<R> simulation(body, {angle, drop.velocity.normal, drop.velocity.tangential, drop.velocity.angular}, law);
  const oracle::EventSequence<R> found = simulation.run(most_impacts, R(1e-18));
  oracle::EventSequence<Real> sequence{{}, found.end};
  for (const auto& i : found.impacts) {
    sequence.impacts.push_back({i.vertex, Real(i.time), converted<Real>(i.before), converted<Real>(i.after), Real(i.approach),
                                Real(i.separation), Real(i.normal_impulse), Real(i.tangential_impulse),
                                Real(i.energy_before), Real(i.energy_after)});
  }
  return sequence;
}

oracle::EventSequence<Real> exact(const RandomScene& scene) {
  return scene.drop.gravity > 0 && scene.drop.law.restitution > 0.2 ? simulated<Real>(scene) : simulated<LongReal>(scene);
}

Outcome outcome_of(oracle::EventEnd end) {
  switch (end) {
    case oracle::EventEnd::no_further: return Outcome::no_further_impact;
    case oracle::EventEnd::limit: return Outcome::impact_limit;
    case oracle::EventEnd::one_vertex_rests: return Outcome::sustained_contact;
    default: return Outcome::at_rest;
  }
}

struct Tally {
  long rows = 0, predictable = 0, rows_inside = 0, numbers = 0, inside = 0;
  long lost = 0;  ///< ends that neither knows
  long ends = 0, certain_ends = 0, ends_right = 0, certain_right = 0, tails = 0, tails_inside = 0, not_compared = 0;
  std::vector<double> ratios;  ///< bar over error
  std::vector<std::string> outside;
};

/// The bars of one row.
class RowJudge {
 public:
  explicit RowJudge(Tally& tally) : tally_(tally) {}
  void operator()(const char* name, double value, double bar, const Real& truth) {
    const double error = static_cast<double>(abs(Real(value) - truth));
    ++tally_.numbers;
    if (error <= bar) ++tally_.inside;
    else {
      std::ostringstream text;
      text << ' ' << name << ' ' << value << " +- " << bar << " off " << error;
      outside_ += text.str();
    }
    if (error > 0) tally_.ratios.push_back(bar / error);
  }
  [[nodiscard]] const std::string& outside() const { return outside_; }

 private:
  Tally& tally_;
  std::string outside_;
};

void judge_row(const ImpactRow& row, const oracle::EventImpact<Real>& truth, RowJudge& judge) {
  const RowErrors& e = row.error;
  const Impact& i = row.impact;
  using boost::multiprecision::sin, boost::multiprecision::asin;
  judge("start", row.start, e.start, truth.time);
  judge("angle", row.contact_angle, e.contact_angle, asin(abs(sin(truth.before.inclination))));
  judge("approach", i.approach_speed, e.approach_speed, truth.approach);
  judge("restitution", i.restitution(), e.restitution, truth.separation / truth.approach);
  judge("Pn", i.normal_impulse, e.normal_impulse, truth.normal_impulse);
  judge("Pt", i.tangential_impulse, e.tangential_impulse, truth.tangential_impulse);
  judge("Vn", i.after.normal, e.after.normal, truth.after.normal);
  judge("Vt", i.after.tangential, e.after.tangential, truth.after.tangential);
  judge("Omega", i.after.angular, e.after.angular, truth.after.angular);
  judge("E", row.energy_before, e.energy_before, truth.energy_before);
  judge("E'", row.energy_after, e.energy_after, truth.energy_after);
  judge("loss", i.energy_loss, e.energy_loss, truth.energy_before - truth.energy_after);
}

void judge_end(const Sequence& sequence, const oracle::EventSequence<Real>& truth, const RandomScene& scene, Tally& tally) {
  if (truth.end == oracle::EventEnd::out_of_digits && !sequence.end_predictable) {
    ++tally.lost;
    ++tally.ends;
    return;
  }
  const bool right = truth.end != oracle::EventEnd::out_of_digits && sequence.outcome == outcome_of(truth.end);
  ++tally.ends;
  tally.ends_right += right;
  tally.certain_ends += sequence.end_predictable;
  tally.certain_right += sequence.end_predictable && right;
  if (!right) {
    tally.outside.push_back((sequence.end_predictable ? "END " : "uncertain end ") + std::to_string(static_cast<int>(sequence.outcome)) + " not " +
                            std::to_string(static_cast<int>(outcome_of(truth.end))) + " rows " + std::to_string(sequence.rows.size()) + " of " + std::to_string(truth.impacts.size()) + ": " + scene.text);
  }
  if (!sequence.end_predictable || !right || sequence.rows.size() > truth.impacts.size()) return;
  Real sum = 0;
  for (const auto& impact : truth.impacts) sum += impact.normal_impulse;
  RowJudge judge(tally);
  ++tally.tails;
  judge("total", sequence.total_normal_impulse, sequence.total_normal_impulse_error + (sequence.tail ? 4 / (1 - scene.drop.law.restitution) * static_cast<double>(truth.impacts.back().normal_impulse) : 0), sum);
  if (sequence.tail) {
    // What the simulation has left out after its last impact.
    const double e = scene.drop.law.restitution, left = 4 / (1 - e);
    const auto& last = truth.impacts.back();
    const double impulse_left = left * static_cast<double>(last.normal_impulse);
    const double time_left = left * static_cast<double>(last.time - truth.impacts[truth.impacts.size() - 2].time);
    const Tail& tail = *sequence.tail;
    Real normal = 0, tangential = 0;
    for (std::size_t i = sequence.rows.size(); i < truth.impacts.size(); ++i) {
      normal += truth.impacts[i].normal_impulse;
      tangential += truth.impacts[i].tangential_impulse;
    }
    judge("tail end", tail.end_time, tail.end_time_error + time_left, truth.impacts.back().time);
    judge("tail Pn", tail.normal_impulse, tail.normal_impulse_error + impulse_left, normal);
    judge("tail Pt", tail.tangential_impulse, tail.tangential_impulse_error + impulse_left, tangential);
    const double speed_left = impulse_left / scene.drop.body.mass, reach = scene.drop.body.reach();
    judge("tail Vt", tail.after.tangential, tail.after_error.tangential + speed_left, last.after.tangential);
    judge("tail Omega", tail.after.angular, tail.after_error.angular + 20 * speed_left / reach, last.after.angular);
  }
  if (judge.outside().empty()) ++tally.tails_inside;
  else tally.outside.push_back("TAIL" + judge.outside() + ": " + scene.text);
}

void judge_scene(const RandomScene& scene, Tally& tally) {
  Sequence sequence;
  oracle::EventSequence<Real> truth;
  try {
    sequence = impact_sequence(scene.drop, {.impacts = most_impacts, .digits = scene.digits});
    truth = exact(scene);
  } catch (const std::domain_error&) {
    return;  // the first contact recedes
  } catch (const OutsideModelError&) {
    return;
  } catch (const std::exception& error) {
    ++tally.not_compared;
    tally.outside.push_back(std::string("NOT COMPARED ") + error.what() + ": " + scene.text);
    return;
  }
  // The simulation stops within an accumulation, the sequence perhaps later.
  const bool accumulates = outcome_of(truth.end) == Outcome::at_rest || outcome_of(truth.end) == Outcome::sustained_contact;
  const std::size_t ended = accumulates ? truth.impacts.size() : sequence.rows.size();
  for (std::size_t i = 0; i < sequence.rows.size(); ++i) {
    const ImpactRow& row = sequence.rows[i];
    ++tally.rows;
    if (!row.error.predictable || i >= ended) continue;
    ++tally.predictable;
    RowJudge judge(tally);
    const bool same = i < truth.impacts.size() && std::popcount(row.vertices) == 1 &&
                      std::countr_zero(row.vertices) == static_cast<int>(truth.impacts[i].vertex);
    if (same) judge_row(row, truth.impacts[i], judge);
    const std::string wrong = same ? judge.outside() : " another vertex";
    if (wrong.empty()) ++tally.rows_inside;
    else tally.outside.push_back("row " + std::to_string(i + 1) + " of " + std::to_string(sequence.rows.size()) + wrong + ": " + scene.text);
  }
  judge_end(sequence, truth, scene, tally);
}

}  // namespace

BOOST_AUTO_TEST_CASE(rows_lie_within_their_bars_of_a_simulation_of_80_digits_and_every_sequence_ends_as_it_does) {
  std::mt19937_64 random(static_cast<unsigned>(setting("CLATTER_BARS_SEED", 20050914)));
  const int scenes = setting("CLATTER_BARS_SCENES", 40);
  Tally tally;
  while (tally.ends + tally.not_compared < scenes) {
    judge_scene(random_scene(random), tally);
    if (setting("CLATTER_BARS_REPORT", 0)) {
      for (const std::string& line : tally.outside) std::cout << line << '\n';
      tally.outside.clear();
      std::cout.flush();
    }
  }
  std::sort(tally.ratios.begin(), tally.ratios.end());
  const double median = tally.ratios.empty() ? 0 : tally.ratios[tally.ratios.size() / 2];
  std::cout << "rows " << tally.rows << " predictable " << tally.predictable << " inside " << tally.rows_inside << "; numbers "
            << tally.numbers << " inside " << tally.inside << "; median bar/error " << median << "; ends " << tally.ends
            << " right " << tally.ends_right << ", certain " << tally.certain_ends << " right " << tally.certain_right
            << "; tails and totals " << tally.tails << " inside " << tally.tails_inside << ", lost " << tally.lost << "; not compared " << tally.not_compared << '\n';
  for (const std::string& line : tally.outside) std::cout << line << '\n';
  BOOST_TEST(static_cast<double>(tally.rows_inside) >= 0.995 * static_cast<double>(tally.predictable));
  BOOST_TEST(median <= 100);
  BOOST_TEST(tally.certain_right == tally.certain_ends);
  BOOST_TEST(tally.not_compared == 0);
}

#include "validation/tradeoff/tradeoff.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "analytic/contact_angles.hpp"
#include "analytic/sequence.hpp"
#include "validation/compare/discrete_scene.hpp"
#include "validation/compare/quantities.hpp"
#include "validation/output/names.hpp"

namespace clatter::validation {
namespace {

using numeric::Method;
using numeric::Simulation;

constexpr int reference_digits = 12;
constexpr double trusted = 1e-6;  // impacts of the reference whose estimated error is above are left out
constexpr Method adaptive[] = {Method::rk4, Method::rkf45, Method::rkck, Method::rk8pd};
constexpr int first_step_per_contact = 8;  // tvd-rk3: contact time over 8, 16, …
constexpr int step_halvings = 11;
constexpr long evaluations_per_run = 2'000'000;

/// The numbers of each impact, and the sizes that they are relative to.
struct Truth {
  std::vector<Quantities> rows;
  Quantities sizes{};
  double error = 0;
  double contact_time = 0;
};

bool in_plane(const SimulationScene& scene) { return scene.tilt_deg == 0; }

numeric::Options plain(const SimulationScene& scene) {
  numeric::Options options = scene.options;
  options.error_estimates = options.amplification = false;
  options.history = nullptr;
  options.evaluation_limit = evaluations_per_run;
  options.step = 0;
  return options;
}

Quantities sizes_of(const Simulation& run, double radius, double mass) {
  double speed = 0;
  for (const numeric::ImpactRecord& row : run.impacts) {
    const numeric::ImpactNumbers& n = row.value;
    speed = std::max({speed, n.velocity_after.norm(), n.approach_speed, n.angular_velocity_after.norm() * radius});
  }
  const double time = std::max(run.impacts.back().value.start, radius / speed);
  return {time, 90, mass * speed, mass * speed, speed, speed, speed / radius};
}

/// Largest relative distance of the rows; infinite if there are too few or one is no number.
double distance(const std::vector<Quantities>& rows, const Truth& truth) {
  if (rows.size() < truth.rows.size()) return std::numeric_limits<double>::infinity();
  double worst = 0;
  for (std::size_t i = 0; i < truth.rows.size(); ++i) {
    for (std::size_t q = 0; q < quantity_count; ++q) {
      const double off = std::fabs(rows[i][q] - truth.rows[i][q]) / truth.sizes[q];
      if (!(off <= worst)) worst = std::isfinite(off) ? off : std::numeric_limits<double>::infinity();
    }
  }
  return worst;
}

std::vector<Quantities> rows_of(const Simulation& run) {
  std::vector<Quantities> rows;
  for (const numeric::ImpactRecord& record : run.impacts) rows.push_back(quantities(record.value));
  return rows;
}

Truth truth_of(const SimulationScene& scene, const numeric::Body& body) {
  numeric::Options options = plain(scene);
  options.method = Method::rk8pd;
  options.digits = reference_digits;
  options.planar = options.planar || in_plane(scene);
  options.error_estimates = true;
  const Simulation run = numeric::simulate(body, scene.ground, scene.start(body), options);
  Truth truth;
  if (run.impacts.empty()) return truth;
  truth.sizes = sizes_of(run, body.radius(), body.mass());
  truth.contact_time = run.impacts[0].value.duration;
  for (const numeric::ImpactRecord& record : run.impacts) {
    const Quantities error = quantities(record.error);
    double worst = 0;
    for (std::size_t q = 0; q < quantity_count; ++q) worst = std::max(worst, std::fabs(error[q]) / truth.sizes[q]);
    if (!(worst <= trusted)) break;
    truth.error = std::max(truth.error, worst);
    truth.rows.push_back(quantities(record.value));
  }
  return truth;
}

/// Runs `work` until it has been repeated often and long enough; least time.
template <class Work>
void time_it(const TradeoffOptions& options, TradePoint& point, const Work& work) {
  using Clock = std::chrono::steady_clock;
  double total = 0;
  point.seconds = std::numeric_limits<double>::infinity();
  while (point.repeats < options.least_repeats || total < options.least_seconds) {
    const auto begin = Clock::now();
    work();
    const double seconds = std::chrono::duration<double>(Clock::now() - begin).count();
    point.seconds = std::min(point.seconds, seconds);
    total += seconds;
    ++point.repeats;
  }
}

/// The bench: the scene, its truth, and the points so far.
class Bench {
 public:
  Bench(const SimulationScene& scene, const TradeoffOptions& options)
      : scene_(scene), options_(options), body_(scene.make_body()), truth_(truth_of(scene, body_)) {
    if (truth_.rows.empty()) throw std::domain_error("the reference run has no impact that can be trusted");
    scene_.options.impacts = static_cast<int>(truth_.rows.size());
    result_.impacts = scene_.options.impacts;
    result_.reference_error = truth_.error;
    result_.reference = fmt::format("{} model, rk8pd at {} digits",
                                    in_plane(scene) || scene.options.planar ? "planar" : "spatial", reference_digits);
  }

  Tradeoff run() {
    add_closed_form();
    add_discrete();
    for (const Rung rung : {Rung::planar, Rung::spatial}) {
      if (rung == Rung::planar && !in_plane(scene_)) continue;
      for (const Method method : adaptive) {
        for (int digits = 2; digits <= 12; ++digits) add_continuous(rung, method, digits, 0);
      }
      for (int i = 0; i < step_halvings; ++i) {
        add_continuous(rung, Method::tvd_rk3, 0, truth_.contact_time / (first_step_per_contact << i));
      }
    }
    add_meshes();
    mark_front();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool goes_on() {
    if (ended_) return false;
    const std::size_t of = 2 + (in_plane(scene_) ? 2 : 1) * (4 * 11 + step_halvings) + 4;
    ended_ = options_.progress && !options_.progress(result_.points.size(), of);
    return !ended_;
  }

  void add(TradePoint point, const std::function<std::vector<Quantities>()>& work) {
    if (!goes_on()) return;
    try {
      std::vector<Quantities> rows;
      time_it(options_, point, [&] { rows = work(); });
      point.error = distance(rows, truth_);
      if (!std::isfinite(point.error))
        point.failure = fmt::format("only {} of {} impacts", rows.size(), truth_.rows.size());
    } catch (const std::exception& error) {
      point.failure = error.what();
    }
    if (!point.failure.empty()) point.error = std::numeric_limits<double>::quiet_NaN();
    result_.points.push_back(point);
  }

  void add_closed_form() {
    const std::string reason = against_closed_form();
    TradePoint point{.rung = Rung::closed_form, .method = {}, .mesh = {}, .failure = reason};
    if (!reason.empty()) {
      point.error = std::numeric_limits<double>::quiet_NaN();
      result_.points.push_back(point);
      return;
    }
    add(point, [this] { return closed_form_rows(); });
  }

  /// Why Eqs. 9 and 12 do not apply; empty: they do.
  [[nodiscard]] std::string against_closed_form() const {
    if (scene_.body.shape != BodyScene::Shape::rod) return "the closed form is for a rod";
    if (scene_.ground.has_friction() || scene_.ground.damping > 0)
      return "the closed form has no friction and no damping";
    if (scene_.tangential_velocity != 0 || scene_.spin != 0 || !in_plane(scene_))
      return "the closed form starts from a straight fall";
    return truth_.rows.size() > 3 ? "the closed form ends with the third impact" : "";
  }

  [[nodiscard]] std::vector<Quantities> closed_form_rows() const {
    const double speed = -scene_.start(body_).velocity.z(), length = scene_.body.length, mass = scene_.body.mass;
    const analytic::ContactAngles at =
        contact_angles(analytic::Angle::from_degrees(scene_.angle_deg),
                       {.gravity_number = scene_.options.gravity * length / (speed * speed)});
    const double time[] = {0, at.beta.time, at.beta.time + at.gamma.time};
    const double angle[] = {scene_.angle_deg, at.beta.angle * analytic::degrees_per_radian,
                            at.gamma.angle * analytic::degrees_per_radian};
    std::vector<Quantities> rows;
    for (int i = 0; i < at.impacts(); ++i) {
      rows.push_back({time[i] * length / speed, angle[i], at.impulse[i] * mass * speed, 0, at.velocity[i] * speed, 0,
                      at.angular[i] * speed / length});
    }
    return rows;
  }

  void add_discrete() {
    add({.rung = Rung::discrete, .method = {}, .mesh = {}, .failure = {}}, [this] {
      const analytic::Sequence sequence =
          impact_sequence(discrete_drop(scene_, body_), {.impacts = scene_.options.impacts, .amplification = false});
      std::vector<Quantities> rows;
      for (const analytic::ImpactRow& row : sequence.rows) rows.push_back(quantities(row));
      return rows;
    });
  }

  void add_continuous(Rung rung, Method method, int digits, double step) {
    TradePoint point{
        .rung = rung, .method = method_name(method), .digits = digits, .step = step, .mesh = {}, .failure = {}};
    add_run(point, body_, method);
  }

  void add_run(TradePoint& point, const numeric::Body& body, Method method) {
    numeric::Options options = plain(scene_);
    options.method = method;
    if (point.digits > 0) options.digits = point.digits;
    options.step = point.step;
    options.planar = point.rung == Rung::planar;
    long evaluations = 0;
    add(point, [&] {
      const Simulation run = numeric::simulate(body, scene_.ground, scene_.start(body), options);
      evaluations = run.force_evaluations;
      if (run.impacts.size() < truth_.rows.size())
        throw std::runtime_error(std::string(outcome_name(run.outcome)) + ": " + run.message);
      return rows_of(run);
    });
    if (!ended_) result_.points.back().evaluations = evaluations;
  }

  /// Other meshes of the same body, at six digits: a rod's sectors change its shape, a box's elements only its cost.
  void add_meshes() {
    const Rung rung = in_plane(scene_) ? Rung::planar : Rung::spatial;
    for (const int count : {1, 2, 4, 8}) {
      SimulationScene scene = scene_;
      TradePoint point{.rung = rung, .method = method_name(Method::rk8pd), .digits = 6, .mesh = {}, .failure = {}};
      if (scene.body.shape == BodyScene::Shape::rod) {
        scene.body.sectors = 8 * count;
        point.mesh = fmt::format("{} sectors", scene.body.sectors);
      } else if (scene.body.shape == BodyScene::Shape::box) {
        scene.body.nx = scene.body.ny = scene.body.nz = 2 * count;
        scene.body.merge = false;
        point.mesh = fmt::format("{0}x{0}x{0}, unmerged", 2 * count);
      } else {
        return;
      }
      const numeric::Body body = scene.make_body();
      add_run(point, body, Method::rk8pd);
    }
  }

  void mark_front() {
    for (TradePoint& point : result_.points) {
      if (!point.failure.empty()) continue;
      point.pareto = std::none_of(result_.points.begin(), result_.points.end(), [&](const TradePoint& other) {
        return other.failure.empty() && other.seconds <= point.seconds && other.error <= point.error &&
               (other.seconds < point.seconds || other.error < point.error);
      });
    }
  }

  SimulationScene scene_;
  const TradeoffOptions& options_;
  numeric::Body body_;
  Truth truth_;
  Tradeoff result_;
  bool ended_ = false;
};

}  // namespace

const char* rung_name(Rung rung) {
  switch (rung) {
    case Rung::closed_form:
      return "closed form";
    case Rung::discrete:
      return "discrete";
    case Rung::planar:
      return "planar";
    case Rung::spatial:
      return "spatial";
  }
  return "";
}

Tradeoff measure_tradeoff(const SimulationScene& scene, const TradeoffOptions& options) {
  return Bench(scene, options).run();
}

}  // namespace clatter::validation

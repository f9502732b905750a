// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/sweep/sweep_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <iterator>
#include <string_view>

#include "analytic/plane/sequence.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/output/interrupt.hpp"
#include "validation/plan/planned_run.hpp"
#include "validation/run/shortfall.hpp"
#include "validation/scene/failure.hpp"
#include "validation/shock/shock_rows.hpp"
#include "validation/sweep/energy_to_rest.hpp"

namespace clatter::validation {
namespace {

constexpr std::size_t most_waiting_bytes = 64 << 20;
constexpr std::chrono::milliseconds between_ticks{100};

const char* outcome_of(FailureKind kind) {
  switch (kind) {
    case FailureKind::bad_input: return "refused";
    case FailureKind::outside_model: return "outside-model";
    default: return "not-computed";
  }
}

}  // namespace

std::optional<SceneRange> RangeQueue::hand_out() {
  const std::lock_guard lock(mutex_);
  // The rows that the waiting ones wait for are on their way already.
  if (handed_out_ == end_ || bytes_ > most_waiting_bytes) return std::nullopt;
  const SceneRange range{handed_out_, std::min(size_, end_ - handed_out_)};
  handed_out_ += range.count;
  return range;
}

bool RangeQueue::all_handed_out() const {
  const std::lock_guard lock(mutex_);
  return handed_out_ == end_;
}

void RangeQueue::add(const SceneRange& range, RangeRows rows) {
  const std::lock_guard lock(mutex_);
  bytes_ += rows.text.size();
  waiting_.try_emplace(range.first, range, std::move(rows));
}

bool RangeQueue::has_next() const {
  const std::lock_guard lock(mutex_);
  return !broken_ && waiting_.contains(taken_);
}

std::optional<RangeRows> RangeQueue::take() {
  const std::lock_guard lock(mutex_);
  if (broken_ || !waiting_.contains(taken_)) return std::nullopt;
  auto node = waiting_.extract(taken_);
  auto& [range, rows] = node.mapped();
  bytes_ -= rows.text.size();
  taken_ += rows.scenes;
  broken_ = rows.scenes < range.count;
  return std::move(rows);
}

Crew::Crew(RangeQueue& queue, const SweepHooks& hooks) : queue_(queue), hooks_(hooks) {}
Crew::~Crew() { dismiss(); }

void Crew::start(int threads, const MakeCompute& make) {
  working_ = threads;
  for (int i = 0; i < threads; ++i) threads_.emplace_back([this, &make] { work(make); });
}

bool Crew::works() {
  const std::lock_guard lock(mutex_);
  return working_ > 0;
}

bool Crew::write_next() {
  const std::optional<RangeRows> rows = queue_.take();
  if (rows) {
    room_.notify_all();
    hooks_.write(*rows);
  }
  hooks_.tick();
  return rows.has_value();
}

void Crew::wait() {
  std::unique_lock lock(mutex_);
  came_.wait_for(lock, between_ticks, [this] { return queue_.has_next() || working_ == 0; });
}

void Crew::finish() {
  dismiss();
  while (write_next()) continue;
  if (failure_) std::rethrow_exception(failure_);
}

void Crew::work(const MakeCompute& make) {
  try {
    const ComputeRange compute = make([this] { return stops(); });
    while (const std::optional<SceneRange> range = next()) {
      queue_.add(*range, compute(*range));
      const std::lock_guard lock(mutex_);
      came_.notify_one();
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    dismissed_ = true;
  }
  const std::lock_guard lock(mutex_);
  --working_;
  came_.notify_one();
  room_.notify_all();
}

std::optional<SceneRange> Crew::next() {
  std::unique_lock lock(mutex_);
  std::optional<SceneRange> range;
  while (!stops() && !(range = queue_.hand_out()) && !queue_.all_handed_out()) room_.wait_for(lock, between_ticks);
  return range;
}

void Crew::dismiss() {
  dismissed_ = true;
  room_.notify_all();
  threads_.clear();
}

void run_on_threads(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks) {
  Crew crew(queue, hooks);
  crew.start(threads, make);
  while (crew.works()) {
    crew.wait();
    crew.write_next();
  }
  crew.finish();
}

SweepBody make_sweep_body(const SweepPlan& plan, const Scene& scene) {
  if (plan.layout.model == Model::discrete) return {DiscreteBody(scene), nullptr};
  return {{}, std::make_shared<const numeric::Body>(scene.make_body())};
}

SceneRunner::SceneRunner(const SweepPlan& plan, const SweepBody& body, std::function<bool()> stop)
    : plan_(plan), stop_(std::move(stop)), scene_(plan.scene), body_(plan, body) {
  scene_.request.local_slip_with_errors = plan.layout.has("local_slip");
}

RangeRows SceneRunner::operator()(const SceneRange& range) {
  RangeRows rows;
  while (rows.scenes < range.count && !stop_() && append_scene(plan_.range.at(range.first + rows.scenes), rows.text))
    ++rows.scenes;
  return rows;
}

bool SweptBody::renew(const Scene& scene, const std::vector<double>& values) {
  const std::vector<std::size_t>& places = plan_.body_values;
  bool same = !values_.empty();
  for (std::size_t i = 0; same && i < places.size(); ++i) same = values_[i] == values[places[i]];
  if (same || places.empty()) return false;
  values_.clear();  // so that a body that cannot be made is tried again
  body_ = make_sweep_body(plan_, scene);
  for (const std::size_t place : places) values_.push_back(values[place]);
  return true;
}

/// The sequence of the drop, in the plane or in space.
DiscreteSequence SceneRunner::sequence(const DiscreteDrop& drop, bool with_errors) {
  const analytic::SequenceOptions options = sequence_options(scene_, with_errors);
  const auto* const planar = std::get_if<analytic::Drop>(&drop);
  const RowLayout& layout = plan_.layout;
  const bool sums_only =
      layout.rows == RowKind::scene && layout.asked.empty() && layout.probes.empty() && !layout.rests;
  if (planar != nullptr && sums_only) return summed_sequence(*planar, options);
  return std::visit([&](const auto& one) -> DiscreteSequence { return impact_sequence(one, options); }, drop);
}

void SceneRunner::add_face_alone(RowForm& form) {
  Scene followed = scene_;
  followed.until_rest = true;
  const DiscreteDrop drop = body_->discrete->drop(followed);
  const DiscreteSequence found = sequence_to_face(followed, drop, form.errors);
  form.rest = rest_face(followed, drop, found);
  if (form.rest || !form.reason.empty()) return;
  followed.require_digits = false;  // the row's own numbers have been asked for theirs
  const std::string why = shortfall(followed, named_run(followed, found, body_->discrete->centre()));
  if (!why.empty()) form.reason = "rest_face: " + why;
}

bool SceneRunner::append_result(long long index, RowForm& form) {
  body_.renew(scene_, values_);
  if (plan_.layout.model == Model::discrete) {
    const DiscreteDrop drop = body_->discrete->drop(scene_);
    const DiscreteSequence found = sequence(drop, form.errors);
    const Run run = named_run(scene_, found, body_->discrete->centre());
    if (!run.warnings.empty()) {
      plan_.warning->note(index, run.warnings.front());
      form.warning = run.warnings.front().substr(0, run.warnings.front().find(';'));  // behind which is what to do
    }
    if (!plan_.layout.probes.empty()) {
      const auto places = places_from(body_->discrete->centre(), plan_.layout.probes);
      form.shocks = LargestShock::of(discrete_shock(drop, found, places), terms_of(run, false));
    }
    form.energy_loss = energy_lost_with_tail(drop, found);
    form.reason = shortfall(scene_, run);
    if (plan_.layout.rests && scene_.until_rest) form.rest = rest_face(scene_, drop, found);
    else if (plan_.layout.rests) add_face_alone(form);
    append_rows(form, run);
    return true;
  }
  const PlannedRun planned_run = planned(form.shocks);
  if (planned_run.run.outcome == numeric::Outcome::interrupted) return false;
  form.reason = shortfall(scene_, planned_run);
  const Run run = named_run(scene_, planned_run.run);
  if (plan_.layout.has_curve) form.curve_depth = curve_depth(run);
  if (plan_.layout.rests) form.rest = rest_face(scene_, planned_run.run);
  append_rows(form, run);
  return true;
}

LargestShock::Terms SceneRunner::terms_of(const Run& run, bool has_peaks) const {
  return {.layout = plan_.layout,
          .has_peaks = has_peaks,
          .landing_end = run.impacts.empty() ? 0 : landing_end(scene_, run.impacts.front().value.approach_speed)};
}

std::optional<Estimated> SceneRunner::curve_depth(const Run& run) const {
  std::optional<Estimated> deepest;
  for (const Impact& impact : run.impacts) {
    if (!(impact.value.start <= landing_end(scene_, run.impacts.front().value.approach_speed))) break;
    const Estimated depth{impact.value.indentation, impact.error.indentation};
    deepest = deepest ? larger(*deepest, depth) : depth;
  }
  if (deepest) *deepest = *deepest * (1 / scene_.world.ground.kinks.back().depth);
  return deepest;
}

PlannedRun SceneRunner::planned(std::vector<LargestShock>& shocks) {
  const numeric::Observer observer{.progress = [this](int, long) { return !stop_(); }};
  const numeric::Body& body = *body_->solid;
  const std::vector<Probe>& probes = plan_.layout.probes;
  if (probes.empty()) return run_to_digits(scene_, body, observer);
  const std::vector<numeric::Vector3> places = places_from(body_properties(scene_, Model::continuous).centre, probes);
  ContinuousShock shock = continuous_shock(
      scene_, body, places, {.parts = plan_.layout.parts(), .keeps_motion = false, .observer = observer});
  shocks = LargestShock::of(shock.rows, terms_of(run_of(shock.planned.run), true));
  return std::move(shock.planned);
}

RowForm SceneRunner::form_of(const std::string& prefix, CellWriter& out) const {
  const numeric::Request& request = scene_.request;
  const bool both = request.error_estimates && request.amplification;
  return {.out = out,
          .prefix = prefix,
          .layout = plan_.layout,
          .errors = plan_.layout.model == Model::discrete ? both : request.error_estimates,
          .predictions = both,
          .reason = {}};
}

bool SceneRunner::append_scene(long long index, std::string& out) {
  plan_.points.at(index, values_);
  const std::string prefix = row_prefix(index, values_, plan_.packed);
  CellWriter cells(out, plan_.packed);
  RowForm form = form_of(prefix, cells);
  bool is_whole = true;
  const std::optional<Failure> failure = failure_of_scene([&] {
    plan_.put_point(values_, scene_);
    is_whole = append_result(index, form);
  });
  if (!failure) return is_whole;
  form.reason = failure->message;
  append_failure(form, outcome_of(failure->kind));
  return true;
}

bool RunProgress::is_due(Clock::time_point now, long long done) {
  if (now - said_at_ < std::chrono::minutes(1) || 10 * (done - said_) < all_) return false;
  said_at_ = now;
  said_ = done;
  return true;
}

void RunProgress::tick(long long done) {
  const Clock::time_point now = Clock::now();
  if (now - shown_at_ < std::chrono::milliseconds(200)) return;
  shown_at_ = now;
  const auto part = [&](long long of) { return static_cast<std::size_t>(of); };
  const std::string left = progress_.time_left(part(done - first_), part(all_ - first_));
  progress_.show(progress_bar(part(done), part(all_)) + left);
  if (is_due(now, done) && !shows_progress()) say(fmt::format("{} of {} {}{}", done, all_, what_, left));
}

bool is_started_by_mpirun() {
  constexpr const char* counts[] = {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "SLURM_STEP_NUM_TASKS"};
  const auto says_several = [](const char* name) {
    const char* const value = std::getenv(name);
    return value != nullptr && std::string_view(value) != "1";
  };
  return std::any_of(std::begin(counts), std::end(counts), says_several) || std::getenv("PMIX_RANK") != nullptr;
}

MakeCompute runners_of(const SweepPlan& plan, const SweepBody& body) {
  return [&plan, &body](std::function<bool()> stop) -> ComputeRange {
    const auto runner = std::make_shared<SceneRunner>(plan, body, std::move(stop));
    return [runner](const SceneRange& range) { return (*runner)(range); };
  };
}

long long range_size(const SweepPlan& plan) {
  if (plan.layout.model == Model::continuous) return 1;
  return std::clamp(4096 / plan.scene.request.impacts, 1, 512);
}

int run_in_processes(const std::function<int(Ranks& ranks)>& command) {
  Ranks ranks;
  try {
    return command(ranks);
  } catch (const std::exception&) {
    if (ranks.writes()) throw;
    return 0;
  }
}

void add_process_options(Command& command, bool& restart, std::optional<int>& threads) {
  command.add_flag("--restart", restart, "begin anew where FILE.part is there, instead of going on");
  command.add(threads_argument(threads, "computing threads (all cores)"));
}

Argument threads_argument(std::optional<int>& threads, const std::string& help, const std::string& group) {
  return whole_argument("--threads", threads, 1, 1024, "N", help, group);
}

int thread_count(std::optional<int> asked, const Ranks& ranks) {
  if (!asked) return static_cast<int>(std::max(1U, std::thread::hardware_concurrency()));
  if (!ranks.several()) return *asked;
  throw BadInput(fmt::format("--threads {}: must be left out under mpirun, where each process is one thread", *asked));
}

void compute_ranges(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks, Ranks& ranks) {
  if (ranks.several()) ranks.hand_out(queue, make, hooks);
  else run_on_threads(queue, threads, make, hooks);
}

int serve_ranges(const MakeCompute& make, Ranks& ranks) {
  const CooperativeInterrupt interrupt;
  ranks.serve(make([&] { return interrupt.requested(); }));
  return interrupt.requested() ? interrupted_status : 0;
}

}  // namespace clatter::validation

// SPDX-License-Identifier: GPL-3.0-or-later
// How a sweep is run: its scenes one after the other, handed out to threads and processes, their rows put back in
// order.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "numeric/body/body.hpp"
#include "validation/command/command.hpp"
#include "validation/command/options.hpp"
#include "validation/run/discrete_scene.hpp"
#include "validation/sweep/sweep_plan.hpp"

namespace clatter::validation {

/// Rows of the first `scenes` scenes of a range: of all, unless the run was stopped.
struct RangeRows {
  std::string text;
  long long scenes = 0;
};

/// Hands out ranges in order and gives their rows back in order, in whatever order they come in between.  The rows that
/// wait for earlier ones take at most some 64 MB: then nothing is handed out until those have come.  Any thread may
/// call any function.
class RangeQueue {
 public:
  /// @param size scenes of a range, >= 1
  RangeQueue(const SceneRange& all, long long size)
      : end_(all.first + all.count), size_(size), handed_out_(all.first), taken_(all.first) {}

  /// The next range; none if all are handed out, or too many rows wait.
  [[nodiscard]] std::optional<SceneRange> hand_out();
  [[nodiscard]] bool all_handed_out() const;
  void add(const SceneRange& range, RangeRows rows);
  /// The next rows in order, if they are there; none any more after a range that was stopped.
  [[nodiscard]] std::optional<RangeRows> take();
  [[nodiscard]] bool has_next() const;
  /// The first scene whose rows were not taken; for the thread that takes them.
  [[nodiscard]] long long taken() const { return taken_; }
  [[nodiscard]] bool is_complete() const { return taken_ == end_; }

 private:
  mutable std::mutex mutex_;
  long long end_;  ///< one past the last scene
  long long size_;
  long long handed_out_;  ///< first scene not handed out
  long long taken_;       ///< first scene not taken
  bool broken_ = false;
  std::size_t bytes_ = 0;
  std::map<long long, std::pair<SceneRange, RangeRows>> waiting_;
};

/// What a run does with its rows, and when it stops.  All are called by the thread that runs it, but for stop().
struct SweepHooks {
  std::function<void(const RangeRows& rows)> write;  ///< in the order of the scenes
  std::function<void()> tick;                        ///< now and then
  std::function<bool()> stop;                        ///< from any thread; true: an end was asked for
};

using ComputeRange = std::function<RangeRows(const SceneRange&)>;
/// Makes what one thread computes with, from the function that tells it to stop.
using MakeCompute = std::function<ComputeRange(std::function<bool()> stop)>;

/// The threads of one process that compute what a queue hands out; the thread that owns the crew writes.
class Crew {
 public:
  Crew(RangeQueue& queue, const SweepHooks& hooks);
  /// Stops the threads after the scenes that they compute.
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  void start(int threads, const MakeCompute& make);
  [[nodiscard]] bool works();
  [[nodiscard]] bool stops() const { return dismissed_ || hooks_.stop(); }
  /// Writes the next rows and ticks.  @returns whether there were rows.
  bool write_next();
  /// Waits a while for rows, or for the end of the last thread.
  void wait();
  /// Writes what is left.  @throws what a computation threw
  void finish();

 private:
  void work(const MakeCompute& make);
  /// Waits while too many rows do.
  std::optional<SceneRange> next();
  void dismiss();

  RangeQueue& queue_;
  const SweepHooks& hooks_;
  std::mutex mutex_;
  std::condition_variable came_, room_;
  int working_ = 0;
  std::atomic<bool> dismissed_ = false;
  std::exception_ptr failure_;
  std::vector<std::jthread> threads_;
};

/// Computes all ranges on `threads` threads.  What write() or a computation throws ends the run and is thrown on.
void run_on_threads(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks);

/// The body as the sweep's model wants it.
struct SweepBody {
  std::optional<DiscreteBody> discrete;
  std::shared_ptr<const numeric::Body> solid;
};
/// The body of one scene of the plan, swept sizes and all.  @throws as Scene::make_body and DiscreteBody.
[[nodiscard]] SweepBody make_sweep_body(const SweepPlan& plan, const Scene& scene);

/// The body of the scenes that one thread computes, made anew where a swept key makes it another one.
class SweptBody {
 public:
  /// @param body  of all scenes, where no key of the body is swept
  SweptBody(const SweepPlan& plan, const SweepBody& body) : plan_(plan), body_(body) {}

  /// Makes the body of a scene, whose point has these numbers.  @returns whether it is another one than before
  /// @throws as make_sweep_body
  bool renew(const Scene& scene, const std::vector<double>& values);
  [[nodiscard]] SweepBody* operator->() { return &body_; }

 private:
  const SweepPlan& plan_;
  SweepBody body_;
  std::vector<double> values_;  ///< those numbers of the point that body_ was made with
};

/// One thread's part in a sweep.  A scene that the model refuses or cannot compute is a row whose outcome is "refused"
/// (speed and spin do not bring the contact down, a size is out of range, ...), "outside-model" (jamming, ...) or
/// "not-computed".
class SceneRunner {
 public:
  /// @param body of all scenes, where no key of the body is swept
  /// @param stop ends the run when it returns true; asked before each scene and during long ones
  SceneRunner(const SweepPlan& plan, const SweepBody& body, std::function<bool()> stop);
  SceneRunner(const SceneRunner&) = delete;
  SceneRunner& operator=(const SceneRunner&) = delete;

  /// @param range  places among the scenes of the plan
  [[nodiscard]] RangeRows operator()(const SceneRange& range);

 private:
  /// False if it was stopped; then nothing is appended.
  bool append_scene(long long index, std::string& out);
  bool append_result(long long index, RowForm& form);
  [[nodiscard]] DiscreteSequence sequence(const DiscreteDrop& drop, bool with_errors);
  /// Puts in the face that the body comes to lie on, by a sequence of its own, or why that did not tell it.
  void add_face_alone(RowForm& form);
  /// The planned run of the continuous model, and what it does to the layout's probes.
  [[nodiscard]] PlannedRun planned(std::vector<LargestShock>& shocks);
  [[nodiscard]] LargestShock::Terms terms_of(const Run& run, bool has_peaks) const;
  /// The greatest depth into a pad in the first landing, over that of its curve's last point; none without an impact.
  [[nodiscard]] std::optional<Estimated> curve_depth(const Run& run) const;
  [[nodiscard]] RowForm form_of(const std::string& prefix, CellWriter& out) const;

  const SweepPlan& plan_;
  std::function<bool()> stop_;
  Scene scene_;
  SweptBody body_;
  std::vector<double> values_;
};

/// A runner for each thread.
[[nodiscard]] MakeCompute runners_of(const SweepPlan& plan, const SweepBody& body);
/// Scenes handed out at a time: some milliseconds' work.
[[nodiscard]] long long range_size(const SweepPlan& plan);

/// How far a run is, on stderr: on a terminal a line that renews itself, elsewhere one for each tenth that took a
/// minute or more, or each minute that took a tenth.
class RunProgress {
 public:
  using Clock = std::chrono::steady_clock;
  /// @param first  how many of `all` were done before it
  RunProgress(long long first, long long all, std::string what)
      : first_(first), all_(all), said_(first), what_(std::move(what)) {}

  void tick(long long done);
  /// Whether a line is due elsewhere; it counts as said.
  [[nodiscard]] bool is_due(Clock::time_point now, long long done);

 private:
  long long first_, all_, said_;
  std::string what_;
  Clock::time_point said_at_ = Clock::now(), shown_at_ = said_at_;
  Progress progress_;
};

/// Whether mpirun or srun started this process as one of several (variables of PMI, PMIx, OpenMPI and Slurm).
[[nodiscard]] bool is_started_by_mpirun();
/// Under mpirun the program without MPI becomes clatter-mpi, if that lies beside it; else nothing happens.
/// @param words those of main, ended by a null pointer
void become_mpi_program(char** words);

/// This process among those that share a sweep: one, or those that mpirun or srun started (program clatter-mpi).  All
/// compute, one thread each; process 0 hands out the ranges and writes.  Whatever ends process 0 early lets the others
/// end, too.
class Ranks {
 public:
  /// @throws BadInput where each of several processes would compute all scenes: in a program without MPI, and where
  ///         srun started them without the interface that MPI joins them by
  Ranks();
  ~Ranks();
  Ranks(const Ranks&) = delete;
  Ranks& operator=(const Ranks&) = delete;

  [[nodiscard]] bool several() const { return count_ > 1; }
  [[nodiscard]] bool writes() const { return rank_ == 0; }

  /// Process 0 of several: hands out all ranges, computes some itself, takes their rows.
  /// @throws std::runtime_error if the others end before.
  void hand_out(RangeQueue& queue, const MakeCompute& make, const SweepHooks& hooks);
  /// Lets any other process compute until process 0 has nothing more to hand out.
  void serve(const ComputeRange& compute);

 private:
  /// Process 0: takes one message, or looks again a little later.
  void take_message(RangeQueue& queue);
  /// Process 0: gives those that wait a range, or tells them that there is none any more.
  void answer_idle(RangeQueue& queue, bool stop);

  int count_ = 1, rank_ = 0;
  int working_ = 0;        ///< known to process 0: others that have not ended
  std::vector<int> idle_;  ///< likewise: those of them that wait for a range, once for each
};

// How a command shares its work among threads, or among the processes that mpirun started.

/// Runs a command in each process.  Of several processes only the one that writes has something to say, and a status:
/// at another's, mpirun would end it before it has spoken.
int run_in_processes(const std::function<int(Ranks& ranks)>& command);
/// --restart and --threads.
void add_process_options(Command& command, bool& restart, std::optional<int>& threads);
/// --threads.
[[nodiscard]] Argument threads_argument(std::optional<int>& threads, const std::string& help,
                                        const std::string& group = "");
/// How many threads compute: all cores where none were asked for.  @throws BadInput if some were, under mpirun
[[nodiscard]] int thread_count(std::optional<int> asked, const Ranks& ranks);
/// Computes what the queue holds, in the process that writes.
void compute_ranges(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks, Ranks& ranks);
/// The part of a process that does not write.  @returns its exit status
int serve_ranges(const MakeCompute& make, Ranks& ranks);

}  // namespace clatter::validation

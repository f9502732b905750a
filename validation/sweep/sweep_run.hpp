// SPDX-License-Identifier: GPL-3.0-or-later
// Scenes handed out to whoever computes them, and their rows put back in order.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>

namespace clatter::validation::inline sweep {

/// Scenes first, first + 1, …, first + count − 1.
struct SceneRange {
  long long first = 0, count = 0;
};

/// Rows of the first `scenes` scenes of a range: of all, unless the run was stopped.
struct RangeRows {
  std::string text;
  long long scenes = 0;
};

/// Hands out ranges in order and gives their rows back in order, in whatever order they come in between.  The rows that
/// wait for earlier ones take at most some 64 MB: then nothing is handed out until those have come.
class RangeQueue {
 public:
  /// @param size scenes of a range, >= 1
  RangeQueue(const SceneRange& all, long long size)
      : all_(all), size_(size), handed_out_(all.first), taken_(all.first) {}

  /// The next range; none if all are handed out, or too many rows wait.
  [[nodiscard]] std::optional<SceneRange> hand_out();
  [[nodiscard]] bool all_handed_out() const { return handed_out_ == all_.first + all_.count; }
  void add(const SceneRange& range, RangeRows rows);
  /// The next rows in order, if they are there; none any more after a range that was stopped.
  [[nodiscard]] std::optional<RangeRows> take();
  [[nodiscard]] bool has_next() const { return !broken_ && waiting_.contains(taken_); }
  /// The first scene whose rows were not taken.
  [[nodiscard]] long long taken() const { return taken_; }
  [[nodiscard]] bool is_complete() const { return taken_ == all_.first + all_.count; }

 private:
  SceneRange all_;
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

/// Computes all ranges on `threads` threads.  What write() or a computation throws ends the run and is thrown on.
void run_on_threads(RangeQueue& queue, int threads, const MakeCompute& make, const SweepHooks& hooks);

}  // namespace clatter::validation::inline sweep

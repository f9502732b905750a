// SPDX-License-Identifier: GPL-3.0-or-later
// Long work without Python's lock, which Ctrl-C ends at once and which tells how far it is.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <memory>
#include <thread>
#include <utility>

namespace clatter::python {

/// How far work is, and whether it should go on: shared by the thread that works and the one that Python waits on.
class Watch {
 public:
  /// Whether nobody has asked for an end.
  bool operator()() const { return !state_->stop; }
  /// So much of `of` is done.  @returns whether to go on.
  bool tell(std::size_t done, std::size_t of) const {
    state_->of = of;
    state_->done = done;
    return !state_->stop;
  }

  /// Asks for an end.
  void end() const { state_->stop = true; }
  [[nodiscard]] std::size_t done() const { return state_->done; }
  [[nodiscard]] std::size_t of() const { return state_->of; }

 private:
  struct State {
    std::atomic<bool> stop = false;
    std::atomic<std::size_t> done = 0, of = 0;
  };
  std::shared_ptr<State> state_ = std::make_shared<State>();
};

/// One of the threads that work, while it lives.
class WorkingThread {
 public:
  WorkingThread() { ++number(); }
  ~WorkingThread() { --number(); }
  WorkingThread(const WorkingThread&) = delete;
  WorkingThread& operator=(const WorkingThread&) = delete;
  /// How many there are.
  static std::atomic<int>& number() {
    static std::atomic<int> threads = 0;
    return threads;
  }
};

/// To be called when Python is about to end: threads that still work then must not outlive the data that C++ destroys
/// at exit, so the process ends before that, with the same status.
void end_before_destructors();

/// The thread gives way to all others, and nobody waits for it.
void leave_alone(std::thread& thread);

/// Runs `work(watch)` on a thread of its own while other Python threads go on; `watch()` turns false when Python has a
/// signal to handle, Ctrl-C say.  Work that does not ask, or is not done soon after, goes on alone and its result is
/// dropped: so it holds all that it reads, and nothing of Python's.
/// @param progress  None, or a callable that gets (done, of) as often as they change, at most twenty times a second,
///                  and once at the end; what it raises ends the work.
/// @throws what `work` throws, or Python's exception for the signal (KeyboardInterrupt) or from `progress`.
template <class Work>
auto run_interruptible(Work work, const pybind11::object& progress = pybind11::none()) {
  namespace py = pybind11;
  const Watch watch;
  std::size_t told = 0;
  std::exception_ptr raised;
  const auto look = [&] {
    const py::gil_scoped_acquire acquire;
    try {
      if (PyErr_CheckSignals() != 0) throw py::error_already_set();
      const std::size_t done = watch.done();
      if (done == told || progress.is_none()) return;
      told = done;
      progress(done, watch.of());
    } catch (const py::error_already_set&) {
      raised = std::current_exception();
      watch.end();
    }
  };
  std::packaged_task<decltype(work(watch))()> task([work = std::move(work), watch] { return work(watch); });
  auto result = task.get_future();
  constexpr std::chrono::milliseconds poll{50};
  const py::gil_scoped_release release;
  std::thread worker([given = std::move(task)]() mutable {
    const WorkingThread counted;
    auto owned = std::move(given);
    owned();
  });
  while (!raised && result.wait_for(poll) != std::future_status::ready) look();
  if (!raised) look();
  if (result.wait_for(poll) == std::future_status::ready) worker.join();
  else leave_alone(worker);
  if (!raised) return result.get();
  std::rethrow_exception(raised);
}

}  // namespace clatter::python

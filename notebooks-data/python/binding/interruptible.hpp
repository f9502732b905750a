// SPDX-License-Identifier: GPL-3.0-or-later
// Long work without Python's lock, which Ctrl-C can end and which tells how far it is.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <future>
#include <memory>

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

/// Runs `work(watch)` on a thread of its own while other Python threads go on; `watch()` turns false when Python has a
/// signal to handle, Ctrl-C say.
/// @param progress  None, or a callable that gets (done, of) as often as they change, at most twenty times a second,
///                  and once at the end; what it raises ends the work.
/// @throws what `work` throws, or Python's exception for the signal (KeyboardInterrupt) or from `progress`.
template <class Work>
auto run_interruptible(const Work& work, const pybind11::object& progress = pybind11::none()) {
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
  const py::gil_scoped_release release;
  auto result = std::async(std::launch::async, work, watch);
  constexpr std::chrono::milliseconds poll{50};
  while (result.wait_for(poll) != std::future_status::ready) {
    if (!raised) look();
  }
  if (!raised) look();
  if (!raised) return result.get();
  result.wait();
  std::rethrow_exception(raised);
}

}  // namespace clatter::python

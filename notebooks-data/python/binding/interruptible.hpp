// Long work without Python's lock, which Ctrl-C can end.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <chrono>
#include <future>

namespace clatter::python {

/// Runs `work(goes_on)` on a thread of its own while other Python threads go on; `goes_on()` turns false when Python
/// has a signal to handle, Ctrl-C say.
/// @throws what `work` throws, or Python's exception for the signal (KeyboardInterrupt).
template <class Work>
auto run_interruptible(const Work& work) {
  namespace py = pybind11;
  std::atomic<bool> stop = false;
  const auto goes_on = [&stop] { return !stop; };
  const py::gil_scoped_release release;
  auto result = std::async(std::launch::async, work, goes_on);
  constexpr std::chrono::milliseconds poll{50};
  while (result.wait_for(poll) != std::future_status::ready) {
    const py::gil_scoped_acquire acquire;
    if (!stop && PyErr_CheckSignals() != 0) stop = true;
  }
  if (!stop) return result.get();
  result.wait();
  const py::gil_scoped_acquire acquire;
  throw py::error_already_set();
}

}  // namespace clatter::python

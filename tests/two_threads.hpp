// SPDX-License-Identifier: GPL-3.0-or-later
// Work shared out between two threads.
#pragma once

#include <array>
#include <cstddef>
#include <exception>
#include <thread>

namespace clatter::test {

/// work(i, result) for every i < count, each thread with a result of its own; those are merged.
template <class Result, class Work>
Result shared_out(std::size_t count, const Work& work) {
  std::array<Result, 2> results;
  std::array<std::exception_ptr, 2> failures;
  const auto part = [&](std::size_t k) {
    try {
      for (std::size_t i = k; i < count; i += 2) work(i, results[k]);
    } catch (...) {
      failures[k] = std::current_exception();
    }
  };
  std::thread other(part, 1);
  part(0);
  other.join();
  for (const auto& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
  results[0].merge(results[1]);
  return results[0];
}

}  // namespace clatter::test

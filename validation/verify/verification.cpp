// SPDX-License-Identifier: GPL-3.0-or-later
#include "validation/verify/verification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <ctime>
#include <exception>
#include <mutex>
#include <thread>

#include "validation/output/number.hpp"

namespace clatter::validation::inline verify {
namespace {

double thread_seconds() {
  std::timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

std::string judge(const Check& check, const Measured& measured) {
  if (!(measured.error <= check.tolerance)) {
    return fmt::format("the error {} is not within {}", significant(measured.error, 3), shortest(check.tolerance));
  }
  if (measured.answer != check.answer) {
    return fmt::format("the answer is {}, expected was {}", answer_name(measured.answer), answer_name(check.answer));
  }
  return "";
}

CheckResult run(const Check& check, CaseRuns& case_runs) {
  CheckResult result{.check = &check, .measured = {}, .failure = {}, .done = true};
  const double begin = thread_seconds();
  try {
    result.measured = all_measures().at(check.id)(case_runs);
    result.failure = judge(check, result.measured);
  } catch (const CaseRuns::Interrupted&) {
    result.done = false;
  } catch (const std::exception& error) {
    result.failure = error.what();
  }
  result.seconds = thread_seconds() - begin;
  return result;
}

}  // namespace

std::vector<CheckResult> verify_checks(
    const std::vector<const Check*>& checks, CaseRuns& case_runs,
    const std::function<bool(std::size_t, std::size_t, const std::string&)>& progress) {
  std::vector<CheckResult> results(checks.size());
  for (std::size_t i = 0; i < checks.size(); ++i) results[i].check = checks[i];
  std::atomic<std::size_t> next = 0;
  std::atomic<bool> go_on = true;
  std::mutex mutex;
  std::size_t done = 0;
  const auto work = [&] {
    for (std::size_t i; go_on && (i = next++) < checks.size();) {
      // The last in the table take longest, so they come first.
      const std::size_t place = checks.size() - 1 - i;
      CheckResult result = run(*checks[place], case_runs);
      const std::lock_guard lock(mutex);
      results[place] = std::move(result);
      if (!progress(++done, checks.size(), checks[place]->id)) go_on = false;
    }
  };
  std::vector<std::jthread> threads;
  const std::size_t count = std::min<std::size_t>(std::max(1U, std::thread::hardware_concurrency()), checks.size());
  for (std::size_t i = 0; i < count; ++i) threads.emplace_back(work);
  threads.clear();
  return results;
}

}  // namespace clatter::validation::inline verify

// SPDX-License-Identifier: GPL-3.0-or-later
// The table of checks, and the judge.
#include "validation/evidence/check.hpp"
#include "tests/support.hpp"

namespace {

using namespace clatter::validation;
constexpr double none = clatter::test::not_a_number;

const Check& check(const std::string& id) {
  const auto& all = all_checks();
  return *std::find_if(all.begin(), all.end(), [&](const Check& one) { return one.id == id; });
}

CheckResult judged(const Check& one) {
  CaseRuns case_runs;
  return verify_checks({&one}, case_runs, [](std::size_t, std::size_t, const std::string&) { return true; }).at(0);
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_worst_of_no_errors_or_of_one_that_is_no_number_is_no_number) {
  BOOST_TEST((std::isnan(worst_of({})) && std::isnan(worst_of({none, 1, 2})) && std::isnan(worst_of({1, none, 2}))));
  BOOST_TEST(worst_of({0}) == 0);
  BOOST_TEST(worst_of({1, 3, 2}) == 3);
}

BOOST_AUTO_TEST_CASE(an_answer_that_is_not_the_expected_one_fails) {
  Check one = check("C5");
  BOOST_TEST(judged(one).passed());
  one.answer = Finding::holds;
  BOOST_TEST(judged(one).failure.find("refuted") != std::string::npos);
}

BOOST_AUTO_TEST_CASE(a_tolerance_that_is_no_number_fails_and_so_does_a_measurement_that_throws_with_its_reason) {
  Check endless = check("C1"), unknown = check("C1"), strict = check("X3");
  BOOST_TEST(judged(strict).passed());
  strict.tolerance = 1e-9;  // far below the next term of the series that it leaves out
  BOOST_TEST(judged(strict).failure.find("not within") != std::string::npos);
  endless.tolerance = none;
  BOOST_TEST(!judged(endless).passed());
  unknown.id = "C99";
  BOOST_TEST((!judged(unknown).passed() && !judged(unknown).failure.empty()));
}

BOOST_AUTO_TEST_CASE(the_exit_status_tells_passed_failed_and_interrupted_apart) {
  Check strict = check("X3");
  strict.tolerance = 1e-12;
  BOOST_TEST(verify_status(summary_of({judged(check("C1"))})) == 0);
  BOOST_TEST(verify_status(summary_of({judged(check("C1")), judged(strict)})) == 1);
  const CheckResult not_run{.check = &strict, .measured = {}, .failure = {}, .done = false};
  BOOST_TEST(verify_status(summary_of({judged(check("C1")), not_run})) == 130);
}

BOOST_AUTO_TEST_CASE(an_interrupt_leaves_the_rest_not_run) {
  std::vector<const Check*> checks;
  for (const char* id : {"C1", "C2", "C3", "C6", "C7", "X3", "X5", "X6"}) checks.push_back(&check(id));
  CaseRuns case_runs;
  const auto results =
      verify_checks(checks, case_runs, [](std::size_t, std::size_t, const std::string&) { return false; });
  const auto done = std::count_if(results.begin(), results.end(), [](const CheckResult& one) { return one.done; });
  BOOST_TEST(done >= 1);
  BOOST_TEST(done < 8);
}

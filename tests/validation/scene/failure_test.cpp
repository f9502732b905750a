// SPDX-License-Identifier: GPL-3.0-or-later
// Each kind of failure has its own exit status and one line.
#include <boost/test/unit_test.hpp>

#include <iostream>
#include <new>
#include <sstream>
#include <stdexcept>

#include "analytic/base/errors.hpp"
#include "numeric/errors.hpp"
#include "validation/output/bad_input.hpp"
#include "validation/program/program.hpp"
#include "validation/scene/failure.hpp"

using namespace clatter;
using namespace clatter::validation;

namespace {

template <class Error>
Failure failure_of(const Error& error) {
  try {
    throw error;
  } catch (...) {
    return current_failure();
  }
}

template <class Error>
int status_after(const Error& error) {
  return guarded([&]() -> int { throw error; });
}

}  // namespace

BOOST_AUTO_TEST_CASE(bad_input_is_2_no_number_3_outside_the_model_4_and_a_defect_70) {
  BOOST_TEST(status_after(BadInput("x")) == 2);
  BOOST_TEST(status_after(numeric::MeshError("x")) == 2);
  BOOST_TEST(status_after(std::domain_error("x")) == 2);
  BOOST_TEST(status_after(analytic::NumericalError("x")) == 3);
  BOOST_TEST(status_after(numeric::NumericalError("x")) == 3);
  BOOST_TEST(status_after(std::runtime_error("x")) == 3);
  BOOST_TEST(status_after(std::bad_alloc()) == 3);
  BOOST_TEST(status_after(analytic::OutsideModelError("x")) == 4);
  BOOST_TEST(status_after(std::logic_error("x")) == 70);
  BOOST_TEST(status_after(std::invalid_argument("x")) == 70);
  BOOST_TEST(status_after(std::out_of_range("x")) == 70);
  BOOST_TEST(guarded([] { return 130; }) == 130);
}

BOOST_AUTO_TEST_CASE(a_defect_says_that_it_is_one) {
  const Failure failure = failure_of(std::out_of_range("vector::at"));
  BOOST_TEST((failure.kind == FailureKind::defect));
  BOOST_TEST(failure.message == "a defect of the program, please report it: vector::at");
  BOOST_TEST(failure_of(std::domain_error("mass = 0: must be positive")).message == "mass = 0: must be positive");
}

// SPDX-License-Identifier: GPL-3.0-or-later
// The stepping loop takes no memory from the heap.
#include <atomic>
#include <cstdlib>
#include <new>

#include "numeric/motion/free_flight.hpp"
#include "numeric/stepping/contact_run.hpp"
#include "tests/numeric/bodies.hpp"
#include "tests/numeric/support.hpp"

namespace {

std::atomic<long> allocations{0};

}  // namespace

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace {

using namespace clatter::numeric;
using namespace clatter::numeric::test;

/// Counts allocations from the first accepted step to the last.
long allocations_in_contact(Method method, const Ground& ground, const MotionState& touch, const Body& body) {
  ContactSystem system(body, ground, 9.81, false);
  const auto stepper = make_stepper(method);
  ContactRun run(system, *stepper);
  long first = -1, last = -1;
  ContactControl control;
  control.evaluation_limit = 1'000'000;
  const auto count = [&](const ContactInstant&) {
    last = allocations;
    if (first < 0) first = last;
    return true;
  };
  const ContactResult result = run.run(touch, touch_point(body, touch), control, count);
  BOOST_REQUIRE((result.ending == ContactEnding::lift_off));
  return last - first;
}

}  // namespace

BOOST_AUTO_TEST_CASE(the_counter_counts) {
  const long before = allocations;
  ::operator delete(::operator new(1));  // a compiler may leave out new and delete expressions, not these calls
  BOOST_TEST(allocations == before + 1);
}

BOOST_AUTO_TEST_CASE(a_contact_allocates_nothing_while_it_is_stepped) {
  for (const Body& body : {phone(), phone(8, 6, 4, false), rod()}) {
    for (const Ground& ground :
         {Ground{.stiffness = 1e8},
          Ground{.stiffness = 1e8, .damping = 1e7, .static_friction = 0.1, .sliding_friction = 0.075},
          with_friction({.stiffness = 1e8, .friction = FrictionLaw::regularised}, 0.5)}) {
      for (const Method method : {Method::tvd_rk3, Method::rk8pd, Method::rkf45, Method::rk4}) {
        const MotionState touch = touching_state(
            body, {.inclination = 10 * degree, .velocity = {0.2, 0.1, -4}, .spin = 1, .out_of_plane_tilt = 0.1});
        BOOST_TEST(allocations_in_contact(method, ground, touch, body) == 0);
      }
    }
  }
}

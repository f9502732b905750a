// SPDX-License-Identifier: GPL-3.0-or-later
#include "numeric/motion/jacobi_functions.hpp"

#include <boost/math/quadrature/gauss_kronrod.hpp>
#include <boost/math/special_functions/ellint_1.hpp>
#include <boost/math/special_functions/jacobi_elliptic.hpp>

#include "tests/support.hpp"

using clatter::numeric::JacobiFunctions;
using clatter::test::eps;

BOOST_AUTO_TEST_CASE(where_the_modulus_tells_enough_the_functions_are_those_of_boost) {
  for (const double complement : {0.1, 0.3, 0.5, 0.75, 0.96, 1.0}) {
    const JacobiFunctions jacobi(complement);
    const long double k = std::sqrt(1 - static_cast<long double>(complement));
    const double quarter = jacobi.quarter_period();
    BOOST_TEST(std::fabs(quarter - static_cast<double>(boost::math::ellint_1(k))) <= 4 * eps * quarter);
    for (double u = -quarter; u <= quarter; u += quarter / 64) {
      long double cn = 0, dn = 0;
      const long double sn = boost::math::jacobi_elliptic(k, static_cast<long double>(u), &cn, &dn);
      const auto values = jacobi.at(u);
      BOOST_TEST(std::fabs(values.sn - static_cast<double>(sn)) <= 4 * eps);
      BOOST_TEST(std::fabs(values.cn - static_cast<double>(cn)) <= 4 * eps);
      // Boost forms dn as a quotient of two cosines that vanish at K; the identity holds everywhere.
      if (std::fabs(values.cn) > 0.01) BOOST_TEST(std::fabs(values.dn - static_cast<double>(dn)) <= 4 * eps);
      const double square = values.cn * values.cn + complement * values.sn * values.sn;
      BOOST_TEST(std::fabs(values.dn * values.dn - square) <= 4 * eps * square);
    }
  }
}

BOOST_AUTO_TEST_CASE(next_to_the_separatrix_the_functions_are_hyperbolic_up_to_the_quarter_period) {
  // Corrections are of order k'² e^(2u); K = ln(4/k').
  for (const double complement : {1e-34, 1e-60, 1e-120, 1e-200}) {
    const JacobiFunctions jacobi(complement);
    const double quarter = std::log(4) - std::log(complement) / 2;
    BOOST_TEST(std::fabs(jacobi.quarter_period() - quarter) <= 4 * eps * quarter);
    for (double u = -quarter / 2; u <= quarter / 2; u += quarter / 37) {
      const double tolerance = 4 * eps * quarter + complement * std::exp(2 * std::fabs(u));
      const auto values = jacobi.at(u);
      BOOST_TEST(std::fabs(values.sn - std::tanh(u)) <= tolerance);
      BOOST_TEST(std::fabs(values.cn * std::cosh(u) - 1) <= tolerance);
      BOOST_TEST(std::fabs(values.dn * std::cosh(u) - 1) <= tolerance);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_argument_is_the_inverse_of_the_functions) {
  for (const double complement : {1e-200, 1e-34, 1e-8, 0.3, 1.0}) {
    const JacobiFunctions jacobi(complement);
    const double quarter = jacobi.quarter_period();
    for (double u = -quarter; u <= quarter; u += quarter / 50) {
      const auto values = jacobi.at(u);
      const double back = jacobi.argument({.sine = values.sn, .cosine = values.cn});
      BOOST_TEST(std::fabs(back - u) <= 8 * eps * quarter);
    }
  }
}

BOOST_AUTO_TEST_CASE(the_remaining_integral_is_that_of_its_integrand) {
  using Rule = boost::math::quadrature::gauss_kronrod<double, 61>;
  for (const double complement : {1e-34, 1e-4, 0.3, 1.0}) {
    const JacobiFunctions jacobi(complement);
    const double quarter = jacobi.quarter_period();
    for (const double h : {0.0, 0.4, 50.0, 1e12}) {
      const auto integrand = [&](double u) {
        const auto v = jacobi.at(u);
        return v.cn * v.cn / (1 + h * v.sn * v.sn);
      };
      for (const double part : {0.0, 1e-3, 0.3, 0.9}) {
        if (h > 1e6 && part == 0) continue;  // a peak of width 1e-6, too sharp for the rule
        const double u = part * quarter;
        const double expected = Rule::integrate(integrand, u, quarter, 15, 1e-13);
        const double tolerance = 1e-12 * expected;  // of the quadrature
        BOOST_TEST(std::fabs(jacobi.remaining_integral(jacobi.at(u), h) - expected) <= tolerance);
        BOOST_TEST(jacobi.remaining_integral(jacobi.at(-u), h) == jacobi.remaining_integral(jacobi.at(u), h));
      }
    }
  }
}

// SPDX-License-Identifier: GPL-3.0-or-later
// Numbers of many digits.
#pragma once

#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>

namespace clatter::oracle {

template <unsigned digits>
using Decimal =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<digits>, boost::multiprecision::et_off>;
using Digits50 = Decimal<50>;

template <class Real>
Real radians(const Real& degrees) {
  return degrees * boost::math::constants::pi<Real>() / 180;
}

}  // namespace clatter::oracle

// SPDX-License-Identifier: GPL-3.0-or-later
// The main program of every test in C++.
#include <boost/test/unit_test.hpp>

int main(int argc, char** argv) {
  return boost::unit_test::unit_test_main([] { return true; }, argc, argv);
}

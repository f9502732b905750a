#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A project of somebody else builds against the installed libraries, with CMake and with pkg-config; the module of
# Python is imported from there.  Usage: consumer_test.bash BUILD
set -euo pipefail

build=$1
self=$(readlink -f -- "${BASH_SOURCE[0]}")
source=${self%/*}
prefix=$(mktemp -d)
trap 'rm -rf -- "$prefix"' EXIT
cmake --install "$build" --prefix "$prefix" --strip >"$prefix/install.log"

with_cmake() {
  cmake -S "$source" -B "$prefix/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_PREFIX_PATH="$prefix" >"$prefix/log"
  cmake --build "$prefix/consumer" --target all headers >>"$prefix/log" || { cat -- "$prefix/log"; return 1; }
  "$prefix/consumer/analytic_example"
  "$prefix/consumer/space_example"
  "$prefix/consumer/numeric_example"
}

with_pkg_config() {
  local flags library
  flags=$(PKG_CONFIG_PATH=$(dirname -- "$(find "$prefix" -name clatter.pc)") pkg-config --cflags --libs clatter)
  for library in analytic space numeric; do
    # shellcheck disable=SC2086  # the flags are words
    g++ -std=c++20 "$source/${library}_example.cpp" -o "$prefix/$library" $flags
    "$prefix/$library"
  done
}

# A component that is not there ends the configuration with a line that names it.
without_a_component() {
  mkdir "$prefix/unknown"
  printf 'cmake_minimum_required(VERSION 3.25)\nproject(x LANGUAGES CXX)\nfind_package(clatter REQUIRED COMPONENTS shock)\n' \
    >"$prefix/unknown/CMakeLists.txt"
  if cmake -S "$prefix/unknown" -B "$prefix/unknown/build" -DCMAKE_PREFIX_PATH="$prefix" >"$prefix/log" 2>&1; then
    return 1
  fi
  grep -q 'no component shock' "$prefix/log"
}

with_python() {
  local package
  package=$(dirname -- "$(find "$prefix" -path '*/clatter/__init__.py')")
  cd -- "$prefix"  # isolated from the build tree and from where this script is called
  PYTHONPATH=${package%/*} /usr/bin/python3 -B - "$package" <<'PYTHON'
import os
import sys

import clatter

assert os.path.dirname(clatter.__file__) == sys.argv[1], clatter.__file__
assert clatter.sequence(angle=10).outcome == "no-further-impact"
assert os.path.exists(os.path.join(sys.argv[1], "py.typed"))
PYTHON
}

with_cmake
with_pkg_config
without_a_component
with_python
printf 'the installed libraries and the Python module work\n'

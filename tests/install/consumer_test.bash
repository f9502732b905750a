#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# A project of somebody else builds against the installed libraries, with CMake and with pkg-config; the module of
# Python is imported from there.  Usage: consumer_test.bash BUILD
set -euo pipefail

build=$(readlink -f -- "$1")
self=$(readlink -f -- "${BASH_SOURCE[0]}")
source=${self%/*}
prefix=$(mktemp -d)
trap 'rm -rf -- "$prefix"' EXIT
cd -- "$prefix"  # where the examples write
cmake --install "$build" --prefix "$prefix" --strip >"$prefix/install.log"

with_cmake() {
  cmake -S "$source" -B "$prefix/consumer" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS="-Wall -Wextra -Wconversion -Werror" -DCMAKE_PREFIX_PATH="$prefix" >"$prefix/log"
  cmake --build "$prefix/consumer" --target all headers >>"$prefix/log" || { cat -- "$prefix/log"; return 1; }
  "$prefix/consumer/analytic_example"
  "$prefix/consumer/space_example"
  "$prefix/consumer/batch_example"
  "$prefix/consumer/numeric_example"
}

with_pkg_config() {
  local flags library
  flags=$(PKG_CONFIG_PATH=$(dirname -- "$(find "$prefix" -name clatter.pc)") pkg-config --cflags --libs clatter)
  for library in analytic space batch numeric; do
    # shellcheck disable=SC2086  # the flags are words
    g++ -std=c++20 "$source/${library}_example.cpp" -o "$prefix/$library" $flags
    "$prefix/$library"
  done
}

# Whoever has the include path sees clatter/ alone, and no header but the public ones and what they need.
with_one_folder() {
  local folder shown
  folder=$(PKG_CONFIG_PATH=$(dirname -- "$(find "$prefix" -name clatter.pc)") pkg-config --variable=includedir clatter)
  shown=$(cd -- "$folder" && echo *)
  [[ $shown == clatter ]] || { printf 'the include path shows %s\n' "$shown" >&2; return 1; }
  shown=$(cd -- "$folder/clatter" && echo *)
  [[ $shown == 'analytic analytic.hpp numeric numeric.hpp' ]] || { printf 'clatter/ holds %s\n' "$shown" >&2; return 1; }
  [[ ! -e $folder/clatter/analytic/plane/first_root.cpp && ! -e $folder/clatter/analytic/space/landing/level_rim.hpp ]]
}

# What an installed header names, in its text, too, is installed.
with_headers_that_are_there() {
  local folder named missing
  folder=$(dirname -- "$(find "$prefix" -path '*/include/clatter/analytic.hpp')")
  named=$(grep -rhoE '[A-Za-z_]+\.hpp' "$folder" | sort -u)
  [[ $(wc -l <<<"$named") -gt 40 ]]
  missing=$(comm -23 <(printf '%s\n' "$named") <(find "$folder" -name '*.hpp' -printf '%f\n' | sort -u))
  [[ -z $missing ]] || { printf 'installed headers name headers that are not there: %s\n' "$missing" >&2; return 1; }
}

# The project as a part of another, by add_subdirectory or FetchContent, which CPM calls: the examples compile with the
# headers by their documented names.  They are linked with the libraries that are there already, which here would take
# minutes, and which other alignments than those of -march=native are in.
as_a_part() {
  local how example root part=$prefix/part libraries
  root=$(readlink -f -- "$source/../..")
  mapfile -t libraries < <(find "$build" -name 'libclatter_numeric.a' -o -name 'libclatter_analytic.a' | sort -r)
  for how in add_subdirectory FetchContent; do
    rm -rf -- "$part"
    cp -r -- "$source/mine" "$part"
    [[ $how == add_subdirectory ]] || sed -i "s|^add_sub.*|include(FetchContent)\nFetchContent_Declare(clatter SOURCE_DIR $root)\nFetchContent_MakeAvailable(clatter)|" "$part/CMakeLists.txt"
    cp -- "$source/analytic_example.cpp" "$part/main.cpp"
    cmake -S "$part" -B "$part/build" -G Ninja -DCLATTER_SOURCE="$root" -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS="-march=native -Wall -Wextra -Wconversion -Werror" >"$prefix/log" 2>&1 || { cat -- "$prefix/log"; return 1; }
    for example in analytic space batch numeric; do
      cp -- "$source/${example}_example.cpp" "$part/main.cpp"
      cmake --build "$part/build" --target CMakeFiles/mine.dir/main.cpp.o >"$prefix/log" 2>&1 || { cat -- "$prefix/log"; return 1; }
      g++ "$part/build/CMakeFiles/mine.dir/main.cpp.o" -o "$part/mine" "${libraries[@]}" -lgsl -lgslcblas -ldl
      "$part/mine" >/dev/null
    done
    [[ -z $(find "$part/build" -name 'clatter_validation*') ]] || { echo 'a part of another project is the libraries alone' >&2; return 1; }
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
  PYTHONPATH=${package%/*} /usr/bin/python3 -B - "$package" <<'PYTHON'
import os
import sys

import clatter

assert os.path.dirname(clatter.__file__) == sys.argv[1], clatter.__file__
assert clatter.sequence(angle=10).outcome == "no-further-impact"
assert os.path.exists(os.path.join(sys.argv[1], "py.typed"))
PYTHON
  PYTHONPATH=${package%/*} /usr/bin/python3 -B "$source/python_example.py"
}

with_cmake
with_pkg_config
with_one_folder
with_headers_that_are_there
as_a_part
without_a_component
with_python
printf 'the installed libraries and the Python module work\n'

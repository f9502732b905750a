#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests ./clatter and tests/packages.bash in small trees of their own.  PATH
# holds nothing but stand-ins for what installs and compiles, which note every
# call, and links to the few tools that do neither.
set -euo pipefail

self=$(readlink -f -- "${BASH_SOURCE[0]}")
project=${self%/tests/*}
scratch=$(mktemp -d)
trap 'rm -rf -- "$scratch"' EXIT

# ---- stand-ins -------------------------------------------------------------

# The settings of a test are files in $SETTINGS, so that they reach every process.
stub() {  # NAME, body on standard input
  {
    printf '#!/bin/bash\n'
    # shellcheck disable=SC2016  # expanded when the stand-in runs
    printf 'printf "%%s\\n" "%s${*:+ $*}" >>"$SETTINGS/calls"\n' "$1"
    cat
  } >"$bin/$1"
  chmod +x "$bin/$1"
}

make_stubs() {
  local tool
  mkdir -p "$bin"
  for tool in bash cat chmod cp env find flock grep mkdir mv nproc readlink rm sleep tail touch; do
    ln -s "$(command -v "$tool")" "$bin/$tool"
  done
  stub ninja </dev/null
  stub g++ </dev/null
  # A build reads all that it is given and makes noise; it refuses, as CMake
  # does, a folder that was configured for another place.
  stub cmake <<'END'
echo "noise of cmake"; echo "complaint of cmake" >&2
cat >/dev/null
set -e
mkdir -p build/release/validation
case $* in
  *--fresh*) echo "$PWD" >build/release/configured ;;
  --preset*)
    [[ ! -e build/release/configured || $(<build/release/configured) == "$PWD" ]]
    echo "$PWD" >build/release/configured ;;
  --build*)
    made=clatter
    [[ ! $* =~ "--target "(clatter-[a-z]+) ]] || made=${BASH_REMATCH[1]}
    cp "$SETTINGS/program" "build/release/validation/$made"
    [[ ! -e $SETTINGS/save_while_building ]] || touch -d "now + 1 minute" analytic/a.cpp
    [[ ! -e $SETTINGS/build_waits ]] || cat "$SETTINGS/build_waits"
    [[ ! -e $SETTINGS/build_fails ]] ;;
esac
END
  stub dpkg-query <<'END'
grep -qx -- "${*: -1}" "$SETTINGS/installed" && printf installed
END
  # Installing brings the tools that the test has put aside.
  stub apt-get <<'END'
echo "noise of apt-get"; echo "complaint of apt-get" >&2
[[ $* != *update* ]] || { rm -f "$SETTINGS/lists_are_stale"; exit 0; }
[[ ! -e $SETTINGS/interrupted ]] || exit 100
[[ $* != *--fix-broken* ]] || { rm -f "$SETTINGS/lacks_dependency"; exit 0; }
[[ ! -e $SETTINGS/lists_are_stale && ! -e $SETTINGS/install_fails && ! -e $SETTINGS/lacks_dependency ]] || exit 100
for package; do echo "$package" >>"$SETTINGS/installed"; done
shopt -s nullglob
for tool in "$SETTINGS"/uninstalled/*; do mv "$tool" "${BASH_SOURCE[0]%/*}"; done
END
  # What was interrupted is taken up, even where a package still lacks another.
  stub dpkg <<'END'
rm -f "$SETTINGS/interrupted"
[[ ! -e $SETTINGS/lacks_dependency ]]
END
  stub id <<'END'
cat "$SETTINGS/uid"
END
}

# What is launched: shows its folder, its arguments and its input.
write_program() {
  cat >"$settings/program" <<'END'
#!/bin/bash
printf 'in %s\n' "$PWD"
printf '<%s>\n' "$@"
cat
[[ ! -e $SETTINGS/program_waits ]] || {
  exec 8<>"$SETTINGS/program_waits"  # before the test, which waits for `running`, removes it
  touch "$SETTINGS/running"
  exec cat <&8
}
exit "$(cat "$SETTINGS/exit_status")"
END
  chmod +x "$settings/program"
  echo 0 >"$settings/exit_status"
}

# A tree that was never built, on a machine of root's that has every package.
set_up() {
  tree="$scratch/$1/a tree"
  settings=$scratch/$1/settings
  bin=$scratch/$1/bin
  mkdir -p "$tree"/{analytic,validation/cases,tests} "$settings/uninstalled"
  cp "$project/clatter" "$tree"
  cp "$project/tests/packages.bash" "$tree/tests"
  touch "$tree"/{CMakeLists.txt,CMakePresets.json,analytic/a.cpp,analytic/b.cpp}
  make_stubs
  write_program
  echo 0 >"$settings/uid"
  printf '%s\n' libgsl-dev libboost-dev libeigen3-dev libcli11-dev nlohmann-json3-dev libfmt-dev libtomlplusplus-dev librandom123-dev libqhull-dev libassimp-dev \
    >"$settings/installed"
  cd "$scratch/$1"
}

# ---- steps and expectations ------------------------------------------------

with_stubs() { env -i PATH="$bin" SETTINGS="$settings" "$@"; }

launch_as() {  # LAUNCHER ARGS...; leaves $status, the files out and err, and calls
  : >"$settings/calls"
  status=0
  with_stubs "$@" >"$settings/out" 2>"$settings/err" </dev/null || status=$?
}

# Without arguments a command of the whole program.
launch() {
  (($#)) || set -- verify
  launch_as "$tree/clatter" "$@"
}

launch_well() {
  launch "$@"
  expect "exit status" 0 "$status"
}

build_first() {
  launch_well
  age_tree
}

# Built an hour ago, from sources of an hour before: what is saved from now on is newer by any file system's clock.
age_tree() {
  find "$tree" -path "$tree/build" -prune -o -exec touch -d "2 hours ago" {} +
  local stamp
  for stamp in built first_built plane_built; do
    [[ ! -e $tree/build/release/$stamp ]] || touch -d "1 hour ago" "$tree/build/release/$stamp"
  done
}

expect() {  # WHAT WANTED FOUND
  [[ $3 == "$2" ]] && return
  printf '    %s\n      wanted: %s\n      found:  %s\n' "$1" "$2" "$3"
  exit 1
}

calls() { grep -c -- "$1" "$settings/calls" || true; }

expect_calls() {  # COUNT PATTERN
  expect "number of calls '$2' among: $(<"$settings/calls")" "$1" "$(calls "$2")"
}

wait_for() {  # COMMAND..., until it succeeds
  until "$@"; do sleep 0.02; done
}

expect_nothing_done() {
  expect "calls" "" "$(<"$settings/calls")"
  expect "standard error" "" "$(<"$settings/err")"
}

what_is_installed() { sed -n 's/^apt-get .*--no-install-recommends //p' "$settings/calls"; }

expect_no_program() {
  expect "exit status" 3 "$status"
  expect "standard output" "" "$(<"$settings/out")"
}

remove_package() {
  grep -vx -- "$1" "$settings/installed" >"$settings/rest"
  mv "$settings/rest" "$settings/installed"
}

remove_tool() { mv "$bin/$1" "$settings/uninstalled/"; }

leave_in_the_plane() { printf '#!/bin/bash\nexit 75\n' >"$tree/build/release/validation/clatter-plane"; }

become_user() { echo 1000 >"$settings/uid"; }

add_sudo() {
  stub sudo <<'END'
exec "$@"
END
}

# ---- the claims ------------------------------------------------------------

test_first_launch_builds_and_runs() {
  launch_well
  expect_calls 1 "cmake --preset release"
  expect_calls 1 "cmake --build --preset release$"
  expect_calls 0 "apt-get"
  expect "standard error" "clatter: building (first run, a few minutes) ..." \
    "$(<"$settings/err")"
}

test_first_table_takes_the_program_in_the_plane() {
  launch_well sequence
  expect_calls 1 "cmake --build --preset release --target clatter-plane"
  expect "standard error" "clatter: building (first run, a few minutes) ..." "$(<"$settings/err")"
  age_tree
  launch explain
  expect "calls" "" "$(<"$settings/calls")"
}

test_what_the_program_in_the_plane_leaves_takes_the_first_program() {
  launch sequence
  age_tree
  leave_in_the_plane
  launch_well sequence "a b"
  expect_calls 1 "cmake --build --preset release --target clatter-first"
  expect "standard error" "clatter: building (models in space, a few minutes) ..." "$(<"$settings/err")"
  expect "arguments" "<sequence> <a b>" "$(grep '^<' "$settings/out" | paste -sd ' ')"
  age_tree
  launch explain
  expect_nothing_done
}

test_what_can_be_read_once_takes_the_first_program() {
  launch sequence /dev/null
  expect_calls 1 "cmake --build --preset release --target clatter-first"
}

test_status_of_the_program_in_the_plane_is_the_launchers() {
  echo 4 >"$settings/exit_status"
  launch sequence
  expect "exit status" 4 "$status"
}

test_other_commands_build_the_whole_program_which_then_serves_all() {
  launch sequence
  age_tree
  launch simulate
  expect_calls 1 "cmake --build --preset release$"
  expect "standard error" "clatter: building (the whole program, a few minutes) ..." "$(<"$settings/err")"
  age_tree
  launch sequence
  expect_nothing_done
}

test_first_program_is_built_anew_where_a_source_is_newer_than_both() {
  launch sequence
  launch simulate
  age_tree
  touch "$tree/analytic/a.cpp"
  launch sequence
  expect_calls 1 "cmake --build --preset release --target clatter-plane"
}

test_nothing_is_called_when_nothing_changed() {
  build_first
  launch sequence
  expect_nothing_done
}

test_saved_added_and_deleted_sources_and_changed_presets_are_built_once() {
  build_first
  local change
  for change in "touch analytic/a.cpp" "touch validation/cases/new.toml" "rm analytic/b.cpp" "touch CMakePresets.json"; do
    (cd "$tree" && $change)
    launch
    expect_calls 1 "cmake --build"
    launch
    expect_calls 0 "cmake"
    age_tree
  done
}

test_source_saved_during_a_build_is_built_by_the_next_launch() {
  touch "$settings/save_while_building"
  launch
  rm "$settings/save_while_building"
  launch
  expect_calls 1 "cmake --build"
}

test_failed_build_does_not_run_the_stale_program() {
  build_first
  touch "$tree/analytic/a.cpp" "$settings/build_fails"
  launch
  expect_no_program
  expect "the compiler's words in standard error" 1 \
    "$(grep -c -m 1 "complaint of cmake" "$settings/err")"
  launch
  expect_no_program
  rm "$settings/build_fails"
  launch_well
}

test_program_left_by_a_failed_build_is_not_run() {
  build_first
  rm "$tree/build/release/validation/clatter"
  touch "$settings/build_fails"
  launch
  launch
  expect_no_program
}

test_interrupted_build_is_not_taken_for_finished() {
  mkfifo "$settings/build_waits"
  set -m  # a process group of its own, as a terminal gives
  with_stubs "$tree/clatter" >"$settings/out" 2>"$settings/err" </dev/null &
  # Opens once cat reads: a shell whose cp has just ended would go on after the signal.
  exec 8>"$settings/build_waits"
  kill -INT -- "-$!"
  status=0
  wait $! || status=$?
  set +m
  expect "exit status" 130 "$status"
  exec 8>&-
  expect "standard output" "" "$(<"$settings/out")"
  rm "$settings/build_waits"
  launch
  expect_calls 1 "cmake --build"
  expect "exit status" 0 "$status"
}

test_two_launches_at_once_build_once() {
  mkfifo "$settings/build_waits"
  : >"$settings/calls"
  with_stubs "$tree/clatter" one >"$settings/one" 2>"$settings/err" </dev/null &
  with_stubs "$tree/clatter" two >"$settings/two" 2>"$settings/err.two" </dev/null &
  wait_for grep -qs "waiting for another build" "$settings/err" "$settings/err.two"
  echo go >"$settings/build_waits"  # the build of the other reads it
  wait
  expect_calls 1 "cmake --build"
  expect "output of one" 1 "$(grep -c '<one>' "$settings/one")"
  expect "output of two" 1 "$(grep -c '<two>' "$settings/two")"
}

test_running_program_does_not_hold_up_a_build() {
  mkfifo "$settings/program_waits"
  with_stubs "$tree/clatter" >"$settings/one" 2>/dev/null </dev/null &
  wait_for test -e "$settings/running"
  rm "$settings/program_waits"
  age_tree
  touch "$tree/analytic/a.cpp"
  launch
  expect_calls 1 "cmake --build"
  expect "whether the first program still runs" 0 "$(kill -0 $! && echo 0)"
  kill $!
}

test_moved_tree_is_configured_afresh() {
  build_first
  mv "$tree" "$tree moved"
  tree+=" moved"
  launch_well
  expect_calls 1 "cmake --fresh --preset release"
  expect_calls 1 "cmake --build"
}

test_build_folder_that_cannot_be_written_is_named() {
  touch "$tree/build"
  launch
  expect_no_program
  expect "standard error" \
    "clatter: cannot write to $tree/build; copy the folder to a place of your own and start it there" \
    "$(<"$settings/err")"
}

test_arguments_and_exit_status_pass_through() {
  echo 4 >"$settings/exit_status"
  launch plain "two words" "" "*" --flag=$'a\nb'
  expect "exit status" 4 "$status"
  expect "arguments" $'<plain>\n<two words>\n<>\n<*>\n<--flag=a\nb>' \
    "$(tail -n +2 "$settings/out")"
}

test_input_reaches_the_program_whole() {
  expect "output" "<->|line 1|line 2" \
    "$(printf 'line 1\nline 2' | with_stubs "$tree/clatter" - 2>/dev/null |
      tail -n +2 | tr '\n' '|')"
}

test_standard_output_is_the_programs_alone() {
  remove_package libgsl-dev
  launch x
  expect "standard output" "in $PWD"$'\n<x>' "$(<"$settings/out")"
}

test_symbolic_link_finds_the_tree() {
  mkdir elsewhere
  ln -s "../a tree/clatter" elsewhere/drop
  cd elsewhere
  launch_as ./drop x
  expect "exit status" 0 "$status"
  expect "standard output" "in $PWD"$'\n<x>' "$(<"$settings/out")"
}

test_root_installs_all_that_is_missing_at_once() {
  : >"$settings/installed"
  remove_tool cmake
  remove_tool ninja
  remove_tool g++
  launch_well
  expect_calls 1 "apt-get"
  expect "what is installed" "cmake ninja-build g++ libgsl-dev libboost-dev libeigen3-dev libcli11-dev\
 nlohmann-json3-dev libfmt-dev libtomlplusplus-dev librandom123-dev libqhull-dev libassimp-dev" "$(what_is_installed)"
}

test_only_what_is_missing_is_installed() {
  remove_package libfmt-dev
  launch
  expect "what is installed" "libfmt-dev" "$(what_is_installed)"
  expect_calls 0 "apt-get.* update"
}

test_stale_package_lists_are_renewed_once() {
  remove_package libgsl-dev
  touch "$settings/lists_are_stale"
  launch_well
  expect_calls 2 "apt-get.* install .*libgsl-dev"
  expect_calls 1 "apt-get.* update"
}

test_interrupted_installation_is_finished() {
  remove_package libgsl-dev
  touch "$settings/interrupted"
  launch_well
  expect_calls 1 "^dpkg --configure -a"
  expect_calls 0 "apt-get.* --fix-broken"
}

test_interrupted_installation_gets_what_it_lacked() {
  remove_package libgsl-dev
  touch "$settings/interrupted" "$settings/lacks_dependency"
  launch_well
  expect_calls 1 "apt-get.* --fix-broken install"
}

test_failed_installation_builds_nothing() {
  remove_package libgsl-dev
  touch "$settings/install_fails"
  launch
  expect_no_program
  expect_calls 2 "apt-get.* install"
  expect_calls 0 "cmake"
  expect "apt-get's words in standard error" 1 \
    "$(grep -c -m 1 "complaint of apt-get" "$settings/err")"
}

test_user_installs_through_sudo() {
  become_user
  add_sudo
  remove_package libgsl-dev
  launch_well
  expect_calls 1 "sudo env DEBIAN_FRONTEND=noninteractive apt-get"
  expect_calls 1 "^apt-get"
}

test_user_without_sudo_is_told_one_line_to_run() {
  become_user
  remove_package libgsl-dev
  remove_package libfmt-dev
  launch
  expect_no_program
  expect_calls 0 "apt-get"
  expect_calls 0 "cmake"
  expect "line to run" \
    "apt-get update && apt-get install -y --no-install-recommends libgsl-dev libfmt-dev" \
    "$(grep apt-get "$settings/err")"
}

expect_to_come() {  # PACKAGES COMMAND THAT-BRINGS-THEM ARGS...: when first asked for
  local packages=$1 bring=$2
  launch "${@:3}"
  expect "what is installed" "$packages" "$(what_is_installed)"
  $bring
  launch "${@:3}"
  expect "calls" "" "$(<"$settings/calls")"
}

add_gnuplot() { stub gnuplot </dev/null; }
add_hdf5() { touch "$tree/build/release/validation/clatter-hdf5.so"; }

test_gnuplot_comes_when_a_picture_is_first_asked_for() {
  build_first
  launch sequence
  expect_nothing_done
  expect_to_come gnuplot-nox add_gnuplot sequence --plot a.svg
  launch verify --html=a.html
  expect "calls" "" "$(<"$settings/calls")"
}

test_gnuplot_comes_when_a_map_is_first_drawn() {
  local map=(map --over drop.angle_deg=0:60 --over drop.speed=1:2 --output)
  build_first
  launch "${map[@]}" map.npy
  expect "calls" "" "$(<"$settings/calls")"
  expect_to_come gnuplot-nox add_gnuplot "${map[@]}" map.png
}

test_hdf5_comes_when_it_is_first_asked_for() {
  build_first
  expect_to_come libhdf5-dev add_hdf5 sweep rod-sweep --output rows.h5
}

test_mpi_comes_when_it_is_first_asked_for_and_its_program_is_named() {
  build_first
  launch --mpi
  expect "what is installed" "libopenmpi-dev openmpi-bin" "$(what_is_installed)"
  expect_calls 1 "cmake --preset release -DCLATTER_MPI=ON"
  touch "$tree/build/release/validation/clatter-mpi"
  chmod +x "$tree/build/release/validation/clatter-mpi"
  launch --mpi
  expect "calls" "" "$(<"$settings/calls")"
  expect "program" "$tree/build/release/validation/clatter-mpi" "$(<"$settings/out")"
}

test_system_without_dpkg_just_builds() {
  rm "$bin/dpkg-query"
  : >"$settings/installed"
  launch_well
  expect_calls 0 "apt-get"
}

# ---- run them --------------------------------------------------------------

failures=0
for name in $(compgen -A function test_); do
  claim=${name#test_}
  # In the background a failed step ends its test: set -e would sleep in an `if`.
  (set_up "$claim"; "$name") >"$scratch/report" 2>&1 &
  if wait $!; then
    printf 'ok      %s\n' "${claim//_/ }"
  else
    printf 'FAILED  %s\n%s\n' "${claim//_/ }" "$(<"$scratch/report")"
    failures=$((failures + 1))
  fi
done
((failures == 0))

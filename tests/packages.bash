# SPDX-License-Identifier: GPL-3.0-or-later
# The Debian packages that the program and its tests need, and how they get here.
# Sourced by ./clatter and tests/run; the caller sets `speaker`, its name in
# messages, and `log`, the file that takes apt-get's output.

: "${speaker:?}" "${log:?}"

# Each header package brings the library that it belongs to.  libboost-dev is
# Debian's own version (1.74 on Debian 12) and holds Math and Multiprecision.
# shellcheck disable=SC2034  # the lists are read by the callers
program_packages=(cmake ninja-build g++ libgsl-dev libboost-dev libeigen3-dev libcli11-dev
                  nlohmann-json3-dev libfmt-dev libtomlplusplus-dev librandom123-dev libqhull-dev libassimp-dev)
# gnuplot draws pictures.  It comes when it is first asked for: without it all else is there.
# shellcheck disable=SC2034
picture_packages=(gnuplot-nox)
# shellcheck disable=SC2034
hdf5_packages=(libhdf5-dev)
# shellcheck disable=SC2034
mpi_packages=(libopenmpi-dev openmpi-bin)
# shellcheck disable=SC2034
test_packages=(libboost-test-dev python3 python3-numpy python3-matplotlib python3-mpmath)
# What `tests/run --full` alone needs.  Without the shells and groff the tests of completion and man page would be
# skipped; help2man writes the packages' manual pages; emscripten, with Node.js, builds the page of clatter demo from the
# program's sources and those of GSL and Qhull; Chromium and Firefox open it; OpenMPI shares a sweep among processes.
# clang-format holds the form of C++ files; ccache keeps what two trees have in
# common.  The Python module, the figures and the
# notebooks take the line of Python packages.
# shellcheck disable=SC2034
full_packages=(ccache clang-format libgmsh-dev libbenchmark-dev zsh fish groff-base chromium emscripten firefox-esr nodejs npm zopfli "${mpi_packages[@]}"
               "${hdf5_packages[@]}" python3-h5py
               pybind11-dev python3-dev jupyter-nbconvert python3-ipykernel mypy
               python3-venv python3-pandas python3-sphinx furo python3-myst-parser libjs-katex pkg-config dpkg-dev lintian
               mmdebstrap help2man reuse)
# Engines of others that the tests put through the league, the smallest two; validation/benchmark/engines/run installs the
# rest.
# shellcheck disable=SC2034
engine_packages=(chipmunk-dev libbox2d-dev)

say() { printf '%s: %s\n' "$speaker" "$*" >&2; }

show_log() { tail -n 40 -- "$log" >&2; }

has_command() { command -v "$1" >/dev/null; }

# A tool counts from wherever it comes; a library must be Debian's.
is_present() {
  case $1 in
    cmake | g++) has_command "$1" && return ;;
    ninja-build) has_command ninja && return ;;
    npm) has_command "$1" && return ;;
    nodejs) has_command node && return ;;
  esac
  [[ $(dpkg-query -W -f='${db:Status-Status}' "$1" 2>/dev/null) == installed* ]]
}

# Without a terminal nobody can answer questions, so none is asked.
as_root() {
  local command=(env DEBIAN_FRONTEND=noninteractive "$@")
  [[ $(id -u) == 0 ]] || command=(sudo "${command[@]}")
  "${command[@]}" </dev/null >>"$log" 2>&1
}

# Waits while another package manager is at work.
apt_get() { as_root apt-get -y -o DPkg::Lock::Timeout=300 "$@"; }

# apt-get refuses all work on a machine that was stopped while it installed,
# until what was unpacked there is set up; that takes what it depends on.
finish_what_was_interrupted() { as_root dpkg --configure -a || apt_get --fix-broken install || true; }

# Most machines know their packages, so the lists are renewed only when they
# turn out to be missing or stale.
apt_install() {
  local install=(install --no-install-recommends "$@")
  apt_get "${install[@]}" && return
  finish_what_was_interrupted
  apt_get update && apt_get "${install[@]}"
}

can_install() { [[ $(id -u) == 0 ]] || has_command sudo; }

say_what_to_run() {
  say "Debian packages are missing; run this as root, then try again:"
  printf 'apt-get update && apt-get install -y --no-install-recommends %s\n' "$*" >&2
}

# Installs those of the named packages that are missing, in one go.  On a system
# without dpkg it does nothing: CMake will name what it does not find.
install_missing() {
  local package missing=()
  has_command dpkg-query || return 0
  for package; do
    is_present "$package" || missing+=("$package")
  done
  ((${#missing[@]})) || return 0
  if ! can_install; then
    say_what_to_run "${missing[@]}"
    return 1
  fi
  say "installing ${missing[*]} ..."
  apt_install "${missing[@]}" && return
  show_log
  say_what_to_run "${missing[@]}"
  return 1
}

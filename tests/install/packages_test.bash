#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Each way in works from nothing: the wheel in a virtual environment, the Debian packages in a bare system, where they
# are installed, run and purged.  Usage: packages_test.bash  (as root; it completes the release tree)
set -euo pipefail

self=$(readlink -f -- "${BASH_SOURCE[0]}")
root=${self%/tests/install/*}
folder=$(mktemp -d)
trap finish EXIT
cd -- "$root"

# The release tree forgets the virtual environment, which its next build could not run.
finish() {
  [[ ! -e build/release/CMakeCache.txt ]] || cmake --preset release -U 'CLATTER_PYTHON*' >/dev/null || true
  rm -rf -- "$folder"
}

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

test_the_wheel() {
  local wheel
  /usr/bin/python3 -m venv "$folder/venv"
  # On a terminal, where it says how far it is.
  script -qec "$(printf '%q ' "$folder/venv/bin/pip" wheel --no-deps --no-index --config-settings build-dir="$root/build/release" \
    --wheel-dir "$folder" .)" "$folder/terminal"
  grep -q '^clatter: compiling with' "$folder/terminal" || fail "the build says nothing on the terminal"
  wheel=$(echo "$folder"/clatter-*.whl)
  printf 'wheel: %d bytes\n' "$(stat -c %s "$wheel")"
  (($(stat -c %s "$wheel") <= 10000000)) || fail "the wheel is larger than 10 MB"
  check_what_it_is_linked_with "$wheel"
  "$folder/venv/bin/pip" install --no-index "$wheel"
  (cd / && "$folder/venv/bin/python" -I - <<'PYTHON'
import clatter

sequence = clatter.sequence(angle=10)
assert sequence.outcome == "no-further-impact" and len(sequence) == 3, sequence
assert isinstance(sequence.column("impulse_normal")[0], float)
try:
    clatter.angles([10])
except ImportError as error:  # the bare environment has no NumPy
    assert "NumPy" in str(error), error
else:
    raise AssertionError("angles() without NumPy")
assert len(clatter.measured_score("square-drops")) > 5
assert clatter.benchmark_truth("rod-10")[1].place == "b"
PYTHON
  ) || fail "the module from the wheel does not work"
  test_the_extra "$wheel"
}

# Every library that the wheel's are linked with is in it, with its terms, or on every Debian.
check_what_it_is_linked_with() {
  local library needed
  /usr/bin/python3 -m zipfile -e "$1" "$folder/wheel"
  [[ -e $folder/wheel/clatter/libgsl.so.27 && -e $folder/wheel/clatter/licences/libgsl27.txt ]] || fail "GSL or its licence is not in the wheel"
  for library in "$folder"/wheel/clatter/*.so*; do
    for needed in $(objdump -p "$library" | sed -n 's/^ *NEEDED *//p'); do
      [[ -e $folder/wheel/clatter/$needed || $needed =~ ^(ld-linux-x86-64|lib(c|m|gcc_s|stdc\+\+))\.so\. ]] ||
        fail "${library##*/} needs $needed, which is neither in the wheel nor everywhere"
    done
  done
  grep -qE 'R(UN)?PATH +[$]ORIGIN' <(objdump -p "$folder"/wheel/clatter/_clatter*.so) || fail "the module does not look beside itself"
}

# The extra asks for NumPy and matplotlib, here those of the system; with them the notebooks' helpers work.
test_the_extra() {
  if "$folder/venv/bin/pip" install --no-index "$1[plots]" 2>"$folder/refused"; then fail "the extra plots asks for nothing"; fi
  grep -qE 'numpy|matplotlib' "$folder/refused" || fail "pip does not say what the extra lacks: $(cat "$folder/refused")"
  /usr/bin/python3 -m venv --system-site-packages "$folder/plots"
  "$folder/plots/bin/pip" install --no-index "$1[plots]"
  (cd / && "$folder/plots/bin/python" -I - <<'PYTHON'
import clatter.lecture
import clatter.look
from importlib.metadata import files, requires

assert {'numpy; extra == "plots"', 'matplotlib; extra == "plots"'} <= set(requires("clatter")), requires("clatter")
assert any(path.name == "data-licence.txt" for path in files("clatter")), "the licence of the measured drops is missing"
assert clatter.__file__.startswith(__import__("sys").prefix), clatter.__file__
assert clatter.lecture.costs()[0]["scene"], clatter.lecture.costs()[0]
PYTHON
  ) || fail "the notebooks' helpers do not work with the extra plots"
}

make_packages() {
  cmake --preset package
  cmake --build --preset package
  cpack --preset package -B "$folder/packages"
  rm -rf -- "$folder/packages/_CPack_Packages"
  # The address is that of who packages: -DCLATTER_CONTACT.
  lintian --fail-on error --suppress-tags bogus-mail-host,bogus-mail-host-in-debian-changelog "$folder"/packages/*.deb ||
    fail "lintian finds errors"
}

dependencies() {
  dpkg-deb -f "$1" Depends | tr ',' '\n' | sed -E 's/\(.*\)//; s/\|.*//; s/ //g' | grep -vE '^(clatter|clatter-mpi|libclatter-dev|python3-clatter)$'
}

in_chroot() { chroot "$folder/system" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 "$@"; }

# shellcheck source=/dev/null
test_the_packages() {
  local name packages=("$folder"/packages/*.deb) needed sources
  needed=$(for name in "${packages[@]}"; do dependencies "$name"; done | sort -u | paste -sd,)
  mapfile -t sources < <(find /etc/apt/sources.list /etc/apt/sources.list.d -type f -size +0 2>/dev/null | grep -E 'debian|/sources.list$')
  mmdebstrap --quiet --variant=minbase --include="$needed" "$(. /etc/os-release && echo "$VERSION_CODENAME")" \
    "$folder/system" "${sources[@]}"
  cp -- "${packages[@]}" "$folder/system/tmp"
  in_chroot find / -xdev -not -path '/proc/*' -not -path '/var/lib/dpkg/*' -not -path '/var/log/*' | sort >"$folder/before"
  in_chroot bash -c 'dpkg -i /tmp/*.deb' >/dev/null
  in_chroot clatter sequence --angle 10 | grep -q 'Sum of normal impulses' || fail "the packaged program prints no table"
  in_chroot clatter simulate rod-10 --impacts 1 --format json >/dev/null || fail "the packaged program does not simulate"
  in_chroot clatter measured fit square-drops >/dev/null || fail "the packaged program has no measured drops"
  in_chroot sh -c 'clatter benchmark truth rod-10 --format csv >/tmp/run.csv'
  in_chroot clatter benchmark score /tmp/run.csv --require exact >/dev/null ||
    fail "the packaged program does not score its own truth"
  rm -f -- "$folder/system/tmp/run.csv"
  in_chroot clatter sequence /usr/share/clatter/cases/rod-10.toml >/dev/null || fail "an installed case is refused"
  in_chroot python3 -c 'import clatter; assert len(clatter.sequence(angle=10)) == 3' || fail "the packaged module does not work"
  grep -q 'Redistributions in binary form' "$folder/system/usr/share/doc/clatter/copyright" ||
    fail "the package does not tell the licence of the measured drops"
  in_chroot dpkg --purge clatter clatter-mpi libclatter-dev python3-clatter >/dev/null 2>&1
  in_chroot find / -xdev -not -path '/proc/*' -not -path '/var/lib/dpkg/*' -not -path '/var/log/*' | sort >"$folder/after"
  diff "$folder/before" "$folder/after" || fail "files are left after the purge"
}

# In the bare system, which loses the libraries that the wheel brings along.
test_the_wheel_alone() {
  local library
  for library in "$folder"/wheel/clatter/lib*.so*; do
    find "$folder/system/usr/lib" -name "${library##*/}*" -delete
  done
  cp -r -- "$folder/wheel" "$folder/system/tmp/wheel"
  in_chroot env PYTHONPATH=/tmp/wheel python3 -c 'import clatter; assert len(clatter.simulate("phone-damped", impacts=1)) == 1' ||
    fail "the wheel does not run on a bare system"
}

test_the_wheel
make_packages
test_the_packages
test_the_wheel_alone
printf 'wheel and Debian packages work\n'

#!/bin/bash
# Each way in works from nothing: the wheel in a virtual environment, the Debian packages in a bare system, where they
# are installed, run and purged.  Usage: packages_test.bash  (as root; it completes the release tree)
set -euo pipefail

self=$(readlink -f -- "${BASH_SOURCE[0]}")
root=${self%/tests/install/*}
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cd -- "$root"

fail() {
  printf '%s\n' "$*" >&2
  exit 1
}

test_the_wheel() {
  local wheel
  /usr/bin/python3 -m venv "$folder/venv"
  "$folder/venv/bin/pip" wheel --no-deps --no-index --config-settings build-dir="$root/build/release" --wheel-dir "$folder" .
  wheel=$(echo "$folder"/clatter-*.whl)
  (($(stat -c %s "$wheel") <= 10000000)) || fail "the wheel is larger than 10 MB"
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
PYTHON
  ) || fail "the module from the wheel does not work"
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
  dpkg-deb -f "$1" Depends | tr ',' '\n' | sed -E 's/\(.*\)//; s/\|.*//; s/ //g' | grep -vE '^(clatter|libclatter-dev|python3-clatter)$'
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
  in_chroot python3 -c 'import clatter; assert len(clatter.sequence(angle=10)) == 3' || fail "the packaged module does not work"
  in_chroot dpkg --purge clatter libclatter-dev python3-clatter >/dev/null 2>&1
  in_chroot find / -xdev -not -path '/proc/*' -not -path '/var/lib/dpkg/*' -not -path '/var/log/*' | sort >"$folder/after"
  diff "$folder/before" "$folder/after" || fail "files are left after the purge"
}

test_the_wheel
make_packages
test_the_packages
printf 'wheel and Debian packages work\n'

#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Serves the page with `clatter demo` and tests it in a browser; page_modules_test checks its sources and their types alone.
# Usage: page_test.bash PROGRAM PAGE TESTS, the folder in which the page was built and the name of a file beside this one
set -euo pipefail

program=$1
page=$2
tests=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/$3.mjs
export DEMO_PAGE=$page CLATTER_PROGRAM=$program
# A browser asks for more memory than a campaign of faults allows; the program does not.
soft=$(ulimit -S -v)
ulimit -S -v "$(ulimit -H -v)"
if [[ $3 == page_modules_test ]]; then
  (cd -- "$page" && npm run --silent check)
  exec node --test --test-reporter=spec "$tests"
fi
scratch=$(mktemp -d)
exec 3< <(ulimit -S -v "$soft" && exec "$program" demo 2>"$scratch/complaints")
demo=$!
trap 'kill -INT "$demo" 2>/dev/null; wait "$demo" || true; rm -rf -- "$scratch"' EXIT
if grep -q DEMO_COPY "$tests"; then "$program" demo --export "$scratch/copy.html"; fi
read -r address <&3 || { cat -- "$scratch/complaints" && exit 1; }
[[ $address =~ http://[0-9.:]+/ ]]
export DEMO_URL=${BASH_REMATCH[0]} DEMO_COPY=$scratch/copy.html
node --test --test-reporter=spec "$tests"

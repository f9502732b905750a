#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# Tests the page of `clatter demo` as validation/demo/build_page.py built it; CLATTER_PROGRAM is the program to compare with.
# Usage: page_test.bash PAGE TESTS, the folder in which the page was built and the name of a file beside this one
set -euo pipefail

export DEMO_PAGE=$1
tests=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")/$2.mjs
# A browser asks for more memory than a campaign of faults allows.
ulimit -S -v "$(ulimit -H -v)"
if [[ $2 == page_modules_test ]]; then (cd -- "$DEMO_PAGE" && npm run --silent check); fi
node --test --test-reporter=spec "$tests"

#!/bin/bash
# Checks the types of the page, serves it with `clatter demo` and tests it in a browser.
# Usage: page_test.bash PROGRAM PAGE, the folder in which the page was built
set -euo pipefail

program=$1
page=$2
here=$(dirname -- "$(readlink -f -- "${BASH_SOURCE[0]}")")
(cd -- "$page" && npm run --silent check)
scratch=$(mktemp -d)
exec 3< <(exec "$program" demo 2>"$scratch/complaints")
demo=$!
trap 'kill -INT "$demo" 2>/dev/null; wait "$demo" || true; rm -rf -- "$scratch"' EXIT
"$program" demo --export "$scratch/copy.html"
read -r address <&3 || { cat -- "$scratch/complaints" && exit 1; }
[[ $address =~ http://[0-9.:]+/ ]]
DEMO_URL=${BASH_REMATCH[0]} DEMO_COPY=$scratch/copy.html DEMO_PAGE=$page CLATTER_PROGRAM=$program \
  node --test --test-reporter=spec "$here/page_test.mjs"

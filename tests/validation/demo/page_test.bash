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
export DEMO_URL=${BASH_REMATCH[0]} DEMO_COPY=$scratch/copy.html DEMO_PAGE=$page CLATTER_PROGRAM=$program
# One after the other: each has a browser of its own.
for tests in page_test page_scene_test page_space_test page_story_test page_modules_test; do
  node --test --test-reporter=spec "$here/$tests.mjs"
done

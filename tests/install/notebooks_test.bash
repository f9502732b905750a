#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
# The notebooks show what they show, opened in any folder, with nothing but the installed module.
# Usage: notebooks_test.bash BUILD
set -euo pipefail

build=$1
self=$(readlink -f -- "${BASH_SOURCE[0]}")
root=${self%/tests/install/*}
folder=$(mktemp -d)
trap 'rm -rf -- "$folder"' EXIT
cmake --install "$build" --prefix "$folder/installed" --component python --strip >"$folder/log"
package=$(dirname -- "$(find "$folder/installed" -path '*/clatter/__init__.py')")
mkdir "$folder/elsewhere" "$folder/notebooks"
# Copies, so that nothing beside the originals helps them.
cp -- "$root"/notebooks-data/notebooks/*.ipynb "$folder/notebooks"
cd -- "$folder/elsewhere"
PYTHONPATH=${package%/*} /usr/bin/python3 -B "$root/notebooks-data/notebooks.py" --check --in . "$folder"/notebooks/*.ipynb
[[ -z $(ls -A) ]] || { echo "a notebook left files behind: $(ls -A)" >&2; exit 1; }

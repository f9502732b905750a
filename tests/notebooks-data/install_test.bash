#!/bin/bash
# After `cmake --install` into a folder of its own, `import clatter` works from there.
# Usage: install_test.bash BUILD
set -euo pipefail

build=$1
prefix=$(mktemp -d)
trap 'rm -rf -- "$prefix"' EXIT
cmake --install "$build" --prefix "$prefix" --strip >"$prefix/install.log"
package=$(dirname -- "$(find "$prefix" -path '*/clatter/__init__.py')")
# Isolated from the build tree and from where this script is called.
cd -- "$prefix"
env -u PYTHONPATH PYTHONPATH="$(dirname -- "$package")" /usr/bin/python3 -B - "$package" <<'PYTHON'
import os
import sys

import clatter

assert os.path.dirname(clatter.__file__) == sys.argv[1], clatter.__file__
assert clatter.sequence(angle=10).outcome == "no-further-impact"
assert os.path.exists(os.path.join(sys.argv[1], "py.typed"))
PYTHON
printf 'import clatter works from %s\n' "${package#"$prefix"/}"

#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The impacts of a drop, read from the program's JSON."""

import json
import subprocess

command = ["clatter", "sequence", "--angle", "10", "--format", "json"]
found = json.loads(subprocess.run(command, capture_output=True, check=True).stdout)
for impact in found["impacts"]:
    error = impact["error_estimate"]["impulse_normal"]
    print(f"{impact['start']:.6f} s  {impact['impulse_normal']:.6f} ± {error:.0e} N·s")

# SPDX-License-Identifier: GPL-3.0-or-later
"""How hard is the hardest blow of a phone that falls at 5° to 60°?"""

import clatter

for angle in range(5, 65, 5):
    drop = clatter.sequence("phone-damped", angle=angle)
    hardest = max(drop, key=lambda impact: impact.impulse_normal)
    error = hardest.error_estimate["impulse_normal"]
    print(f"{angle:2}°: impact {hardest.n} of {len(drop)}, end {hardest.end}, "
          f"{hardest.impulse_normal:.4f} N·s ± {error:.1g}; then {drop.outcome}")

# SPDX-License-Identifier: GPL-3.0-or-later
"""A small code of fixed steps for planar rods and boxes: Euler's, with the exact impulse at points on or in the ground."""
import math

from planar_code import Code


class StepCode(Code):
    """One row a step, or one in `every`; what is done in a step, in its order: k gravity, s impacts, d places."""

    def __init__(self, problem, gap_index=0, step=1 / 960, order="ksd"):
        super().__init__(problem, gap_index)
        self.step, self.order = step, order

    def advance(self, state):
        for part in self.order:
            if part == "k":
                state = state[:5] + [state[5] - self.gravity * self.step / self.order.count("k"), state[6]]
            elif part == "d":
                x, z, phi, vx, vz, omega = state[1:]
                state = [state[0] + self.step, x + vx * self.step, z + vz * self.step, phi + omega * self.step, vx, vz, omega]
            else:
                state = self.struck(state)
        return state

    def struck(self, state):
        """The lowest point that comes down first."""
        for point in sorted(range(len(self.points)), key=lambda k: self.height(state, k)):
            if self.height(state, point) <= 1e-9 and self.approach(state, point) < 0:
                state = self.apply(state, point, *self.impulse(state, point, self.e, self.friction))
        return state

    def rows(self, every=1, end=None):
        end, rows, state = self.end() if end is None else end, [], self.state
        for k in range(math.ceil(end / self.step) + every + 1):
            if k % every == 0:
                rows.append([k * self.step, *state[1:]])
            state = self.advance(state)
        return rows

    def text(self, every=1, **head):
        return super().text(self.rows(every), **head)

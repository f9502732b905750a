# SPDX-License-Identifier: GPL-3.0-or-later
"""Answers of the notebooks' exercises by other means than clatter's: closed forms, own root-finders, own integrations.

ORACLES: exercise to (function that gives the expected numbers, relative tolerance).
"""

from . import notebook_1, notebook_2, notebook_3, notebook_4, notebook_5, notebook_6, notebook_7, notebook_8, notebook_9, notebook_10, notebook_11, notebook_12, notebook_13, notebook_14

ORACLES = {}
for _notebook in (notebook_1, notebook_2, notebook_3, notebook_4, notebook_5, notebook_6, notebook_7, notebook_8, notebook_9, notebook_10, notebook_11, notebook_12, notebook_13, notebook_14):
    ORACLES.update(_notebook.ORACLES)

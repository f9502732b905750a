# SPDX-License-Identifier: GPL-3.0-or-later
"""Data of the extra pictures that the program prints, kept as CSV files."""

import csv
import io
import subprocess
from dataclasses import dataclass

import numpy as np

from plotting import as_column


@dataclass(frozen=True)
class Source:
    """Some columns of what the program prints for `arguments`, in figures/`file`."""
    file: str
    arguments: tuple
    columns: tuple
    same_everywhere: bool = True  # but for rounding; otherwise no check compares it

    def printed(self, program):
        text = subprocess.run([program, *self.arguments, "--format", "csv"], check=True, capture_output=True, text=True).stdout
        head = next(line for line in text.splitlines() if line.startswith("#"))
        out = io.StringIO()
        out.write(f"{head}\n# command: clatter {' '.join(self.arguments)} --format csv, these columns\n")
        writer = csv.DictWriter(out, self.columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(csv.DictReader(line for line in text.splitlines() if not line.startswith("#")))
        return out.getvalue()

    def renewed(self, program, folder, check):
        """File and text if the file does not hold what the program prints."""
        path = folder / self.file
        if check and not self.same_everywhere:
            return {}
        text = self.printed(program)
        return {} if path.exists() and agree(path.read_text(encoding="utf-8"), text) else {path: text}


def agree(kept, text):
    """To a millionth of each column's range: another machine rounds differently."""
    (kept_head, kept_rows), (head, rows) = split(kept), split(text)
    if kept_head != head or len(kept_rows) != len(rows):
        return False
    for old, new in zip(zip(*kept_rows[1:]), zip(*rows[1:])):
        old, new = as_column(old), as_column(new)
        if old.dtype.kind == new.dtype.kind == "f":
            scale = np.nanmax(np.abs(old), initial=1e-3)
            if not np.allclose(old, new, rtol=0, atol=1e-6 * scale, equal_nan=True):
                return False
        elif list(old) != list(new):
            return False
    return kept_rows[0] == rows[0]


def split(text):
    lines = text.splitlines()
    return [line for line in lines if line.startswith("#")], list(csv.reader(line for line in lines if not line.startswith("#")))

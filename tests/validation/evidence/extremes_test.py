# SPDX-License-Identifier: GPL-3.0-or-later
"""`clatter verify --extremes` as its users meet it.  Costs are measured, not judged."""

import xml.etree.ElementTree

from run_folder import EmptyFolder, json_of, rows_of

PATIENCE = ["--seconds", "600"]  # so that no test depends on a time


class Extremes(EmptyFolder):
    def test_csv_and_json_have_every_cell(self):
        cells = json_of("verify", "--extremes", "--only", "angle", *PATIENCE)["cells"]
        rows = rows_of("verify", "--extremes", "--only", "angle", *PATIENCE)
        self.assertEqual(len(rows), len(cells))
        self.assertEqual({row["model"] for row in rows}, {"closed form", "discrete", "planar", "spatial"})
        for cell in cells:
            self.assertEqual(cell["error"] is None, cell["verdict"] != "number", cell)
            self.assertEqual(cell["reason"] is None, cell["verdict"] == "number", cell)

    def test_the_picture_is_well_formed_svg_with_a_cell_for_each(self):
        cells = json_of("verify", "--extremes", "--only", "ratio", "--plot", self.path("map.svg"), *PATIENCE)["cells"]
        titles = xml.etree.ElementTree.parse(self.path("map.svg")).getroot().findall(".//{http://www.w3.org/2000/svg}title")
        self.assertEqual(len(titles), len(cells))

    def test_the_same_digits_each_time(self):
        once, again = ([cell["digits"] for cell in json_of("verify", "--extremes", "--only", "gravity", *PATIENCE)["cells"]] for _ in range(2))
        self.assertEqual(once, again)

    def test_bad_arguments_are_one_line(self):
        self.each_refused({"--only angel": "did you mean angle?", "--quick --only angle": "--quick", "--seed x": "--seed", "--seconds 0": "--seconds",
                           "--plot /no/such/folder/x.svg": "--plot", "--plot same --output same": "--plot", "--format jsn": "--format"}, "extremes")

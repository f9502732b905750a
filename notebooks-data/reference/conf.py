# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of Sphinx for the reference; notebooks-data/reference.py calls it and tells places by the environment."""

import os
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [os.environ["CLATTER_REFERENCE_PYTHON"], str(HERE)]

project = "clatter"
release = version = os.environ["CLATTER_REFERENCE_VERSION"]
html_title = f"clatter {version}"
extensions = ["sphinx.ext.autodoc", "myst_parser", "formulas", "docstrings"]

source_suffix = {".md": "markdown"}
exclude_patterns = ["theme"]
myst_enable_extensions = ["dollarmath", "colon_fence", "deflist"]
myst_heading_anchors = 3
myst_dmath_double_inline = True
highlight_language = "none"
nitpicky = False
smartquotes = False  # they make a dash of --angle
suppress_warnings = ["myst.header"]  # parts of the notebooks begin at any level

autodoc_typehints = "none"
autodoc_member_order = "groupwise"
add_module_names = False
toc_object_entries = False

html_theme = "furo"
templates_path = ["theme"]
html_static_path = ["theme/reference.css"]
html_css_files = ["reference.css"]
html_theme_options = {"footer_icons": [], "navigation_with_keys": True}
html_show_sphinx = False
html_show_copyright = False
html_copy_source = False
html_show_sourcelink = False
# A page that was opened from a file may not fetch others, so results are titles and headings.
html_show_search_summary = False

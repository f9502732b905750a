# SPDX-License-Identifier: GPL-3.0-or-later
"""Surfaces as the texts of STL files."""


def stl(triangles):
    """Of triangles of three corners each, counterclockwise seen from outside."""
    text = "solid body\n"
    for triangle in triangles:
        corners = "".join("vertex %r %r %r\n" % tuple(corner) for corner in triangle)
        text += "facet normal 0 0 0\nouter loop\n" + corners + "endloop\nendfacet\n"
    return text + "endsolid body\n"

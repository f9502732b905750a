# SPDX-License-Identifier: GPL-3.0-or-later
"""Mesh files of every form as the body, whole and broken, held against integrals of their triangles in exact rationals."""

import base64
import io
import json
import math
import os
import random
import struct
import zipfile
from fractions import Fraction
from pathlib import Path

import numpy as np
from run_folder import EmptyFolder, stl

MASS = 0.2
DROP = ("--mass", str(MASS), "--angle", "20", "--impacts", "1")


def box(low=(0.1, 0.2, 0.3), high=(0.2, 0.25, 0.47)):
    corners = [tuple(high[k] if i >> k & 1 else low[k] for k in range(3)) for i in range(8)]
    faces = ((0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5))
    return [tuple(corners[i] for i in three) for a, b, c, d in faces for three in ((a, b, c), (a, c, d))]


def turned(triangles):
    return [(a, c, b) for a, b, c in triangles]


def turned_about(profile, around, along, centre=(0, 0, 0)):
    """The surface of revolution of the points profile(j), their distance from the axis and height, j from 0 to `along`."""
    def point(i, j):
        turn, (far, high) = 2 * math.pi * (i % around) / around, profile(j)
        return centre[0] + far * math.cos(turn), centre[1] + far * math.sin(turn), centre[2] + high

    quads = [(point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)) for i in range(around) for j in range(along)]
    return [three for a, b, c, d in quads for three in ((a, b, c), (a, c, d)) if len(set(three)) == 3]


def torus(around=12, across=8):
    rolls = [2 * math.pi * j / across for j in range(across)]
    return turned_about(lambda j: (0.05 + 0.02 * math.cos(rolls[j % across]), 0.02 * math.sin(rolls[j % across])), around, across)


def ball(along=6):
    polar = [math.pi * j / along for j in range(along + 1)]
    return turned_about(lambda j: (0.03 * math.sin(polar[j]) if 0 < j < along else 0, -0.03 * math.cos(polar[j])), 10, along, (0.1, 0.2, 0.3))


def hollow():
    return box((0, 0, 0), (0.1, 0.2, 0.3)) + turned(box((0.01, 0.02, 0.03), (0.05, 0.1, 0.1)))


def single(x):
    return float(np.float32(x))


def in_32_bits(triangles):
    return [tuple(tuple(map(single, corner)) for corner in three) for three in triangles]


def exact(triangles):
    """Volume and the inertia of MASS about the centre, xx, yy, zz, xy, xz, yz, in rationals."""
    a, b, c = np.moveaxis(np.array([[[Fraction(x) for x in corner] for corner in three] for three in triangles]), 1, 0)
    part, total = (a * np.cross(b, c)).sum(axis=1) / 6, a + b + c
    volume, first = part.sum(), part @ total / 4
    second = sum((part[:, None] * x).T @ x for x in (total, a, b, c)) / 20
    p = (second - np.outer(first, first) / volume) / volume
    k2 = p[1, 1] + p[2, 2], p[2, 2] + p[0, 0], p[0, 0] + p[1, 1], -p[0, 1], -p[0, 2], -p[1, 2]
    return float(volume), [MASS * float(x) for x in k2]


def shared(triangles):
    """Corners, each once, and their numbers."""
    number = {corner: i for i, corner in enumerate(dict.fromkeys(corner for three in triangles for corner in three))}
    return list(number), [[number[corner] for corner in three] for three in triangles]


def binary_stl(triangles):
    numbers = (struct.pack("<12fH", 0, 0, 0, *(x for corner in three for x in corner), 0) for three in triangles)
    return bytes(80) + struct.pack("<I", len(triangles)) + b"".join(numbers)


def obj(triangles):
    corners, threes = shared(triangles)
    return ("".join("v %r %r %r\n" % corner for corner in corners) + "".join("f %d//1 %d//1 %d//1\n" % tuple(i + 1 for i in three) for three in threes)).encode()


def off(triangles):
    corners, threes = shared(triangles)
    return (f"OFF # a body\n{len(corners)} {len(threes)} 0\n" + "".join("%r %r %r\n" % corner for corner in corners) +
            "".join("3 %d %d %d 255 0 0\n" % tuple(three) for three in threes)).encode()


def ply(triangles, form="ascii", kind="double"):
    corners, threes = shared(triangles)
    head = (f"ply\nformat {form} 1.0\nelement vertex {len(corners)}\nproperty {kind} x\nproperty {kind} y\nproperty {kind} z\nproperty uchar red\n"
            f"element face {len(threes)}\nproperty list uchar int vertex_indices\nend_header\n").encode()
    if form == "ascii":
        return head + ("".join("%r %r %r 9\n" % corner for corner in corners) + "".join("3 %d %d %d\n" % tuple(three) for three in threes)).encode()
    order, letter = "<" if "little" in form else ">", "d" if kind == "double" else "f"
    return (head + b"".join(struct.pack(f"{order}3{letter}B", *corner, 9) for corner in corners) +
            b"".join(struct.pack(f"{order}B3i", 3, *three) for three in threes))


def gltf(triangles, is_binary=False, **node):
    corners, threes = shared(triangles)
    places, numbers = b"".join(struct.pack("<3f", *c) for c in corners), b"".join(struct.pack("<3I", *t) for t in threes)
    extremes = {name: [which(single(corner[k]) for corner in corners) for k in range(3)] for name, which in (("min", min), ("max", max))}
    scene = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, **node}],
             "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
             "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(corners), "type": "VEC3", **extremes},
                           {"bufferView": 1, "componentType": 5125, "count": 3 * len(threes), "type": "SCALAR"}],
             "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": len(places)},
                             {"buffer": 0, "byteOffset": len(places), "byteLength": len(numbers)}],
             "buffers": [{"byteLength": len(places + numbers)}]}
    if not is_binary:
        scene["buffers"][0]["uri"] = "data:application/octet-stream;base64," + base64.b64encode(places + numbers).decode()
        return json.dumps(scene).encode()
    text = json.dumps(scene).encode()
    text += b" " * (-len(text) % 4)
    chunks = struct.pack("<II", len(text), 0x4E4F534A) + text + struct.pack("<II", len(places + numbers), 0x4E4942) + places + numbers
    return struct.pack("<III", 0x46546C67, 2, 12 + len(chunks)) + chunks


def three_mf(triangles, unit="meter"):
    corners, threes = shared(triangles)
    package = "http://schemas.openxmlformats.org/package/2006/"
    parts = {"[Content_Types].xml": f'<Types xmlns="{package}content-types"><Default Extension="rels" ContentType="application/vnd.openxmlformats-package.'
                                    'relationships+xml"/><Default Extension="model" ContentType="application/vnd.ms-package.3dmanufacturing-3dmodel+xml"/></Types>',
             "_rels/.rels": f'<Relationships xmlns="{package}relationships"><Relationship Target="/3D/3dmodel.model" Id="r" '
                            'Type="http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel"/></Relationships>',
             "3D/3dmodel.model": f'<model unit="{unit}" xmlns="http://schemas.microsoft.com/3dmanufacturing/core/2015/02"><resources><object id="1" '
                                 'type="model"><mesh><vertices>' + "".join('<vertex x="%r" y="%r" z="%r"/>' % corner for corner in corners) +
                                 "</vertices><triangles>" + "".join('<triangle v1="%d" v2="%d" v3="%d"/>' % tuple(three) for three in threes) +
                                 '</triangles></mesh></object></resources><build><item objectid="1"/></build></model>'}
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name, text in parts.items():
            archive.writestr(name, '<?xml version="1.0" encoding="UTF-8"?>' + text)
    return packed.getvalue()


def dae(triangles, metres=1.0):
    corners, threes = shared(triangles)
    return (f'<?xml version="1.0"?><COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1"><asset><unit meter="{metres!r}"/>'
            '<up_axis>Z_UP</up_axis></asset><library_geometries><geometry id="g"><mesh><source id="p"><float_array id="a" count="%d">%s</float_array>'
            '<technique_common><accessor source="#a" count="%d" stride="3"><param name="X" type="float"/><param name="Y" type="float"/>'
            '<param name="Z" type="float"/></accessor></technique_common></source><vertices id="v"><input semantic="POSITION" source="#p"/></vertices>'
            '<triangles count="%d"><input semantic="VERTEX" source="#v" offset="0"/><p>%s</p></triangles></mesh></geometry></library_geometries>'
            '<library_visual_scenes><visual_scene id="s"><node id="n"><instance_geometry url="#g"/></node></visual_scene></library_visual_scenes>'
            '<scene><instance_visual_scene url="#s"/></scene></COLLADA>' %
            (3 * len(corners), " ".join("%r %r %r" % corner for corner in corners), len(corners), len(threes),
             " ".join("%d %d %d" % tuple(three) for three in threes))).encode()


# Each with what its numbers are: those of the file, or 32 bits of them.
FORMS = {"text.stl": (lambda t: stl(t).encode(), list), "binary.STL": (binary_stl, in_32_bits), "a.obj": (obj, list), "a.off": (off, list), "text.ply": (ply, list),
         "little.ply": (lambda t: ply(t, "binary_little_endian"), list), "big.ply": (lambda t: ply(t, "binary_big_endian", "float"), in_32_bits),
         "a.gltf": (gltf, in_32_bits), "a.glb": (lambda t: gltf(t, True), in_32_bits), "a.3mf": (three_mf, None), "a.dae": (dae, None)}


class MeshFiles(EmptyFolder):
    def put(self, name, contents):
        Path(self.path(name)).write_bytes(contents)

    def body(self, name, *more):
        return self.json_of("sequence", name, *DROP, *more, status=(0, 4))["body"]

    def check(self, name, triangles, scale=1.0, bar=None, relative=None, more=()):
        """The body is that of these triangles, to its own bars; these are below `bar` of the volume."""
        body = self.body(name, *more)
        volume, inertia = exact(triangles)
        volume, inertia, mesh = volume * scale**3, [i * scale**2 for i in inertia], body["mesh"]
        off, turned_off = abs(mesh["volume"] - volume), max(abs(a - b) for a, b in zip(body["inertia"], inertia))
        self.assertLessEqual(off, mesh["volume_error"], name)
        self.assertLessEqual(turned_off, mesh["inertia_error"], name)
        if bar:
            self.assertLess(mesh["volume_error"], bar * volume, name)
        if relative:
            self.assertLessEqual((off / volume, turned_off / max(inertia)), (relative, relative), name)
        return mesh

    def test_bodies_of_every_form_are_those_of_exact_integrals(self):
        shapes = (box(), ball(), torus(), hollow())
        for name, (writer, numbers) in FORMS.items():
            for shape in shapes:
                self.put(name, writer(shape))
                if numbers is None:  # texts of which assimp keeps 32 bits
                    self.check(name, shape, bar=1e-5)
                else:
                    self.check(name, numbers(shape), relative=1e-12)

    def test_broken_bodies_of_every_form_are_repaired_and_told(self):
        chance = random.Random(1)
        whole = box()
        seam = [tuple(tuple(x + 5e-8 * chance.uniform(-1, 1) for x in c) for c in t) if i < 4 else t for i, t in enumerate(whole)]
        a, b, c = whole[0]
        middle = tuple((x + y) / 2 for x, y in zip(a, b))
        broken = {"corners_joined": (seam, whole), "flat_left_out": ([(a, middle, c), (middle, b, c), (a, b, middle), *whole[1:]], whole),
                  "doubled_left_out": ([*whole, whole[5], *turned(whole[:1])], whole), "turned_outward": (turned(whole[:3]) + whole[3:], whole),
                  "nested_left_out": (whole + box((0.12, 0.21, 0.32), (0.15, 0.22, 0.4)), whole),
                  "cavities": (turned(hollow()), hollow())}
        for name, (writer, _) in FORMS.items():
            for what, (triangles, meant) in broken.items():
                self.put(name, writer(triangles))
                self.assertGreater(self.check(name, meant, bar=2e-5)[what], 0, (name, what))
                if what != "cavities":
                    self.write("strict.toml", f"[body]\nshape = 'mesh'\nmesh = {{ file = '{name}', strict = true }}\n")
                    self.refused(name, "sequence", "strict.toml", *DROP)
            self.put(name, writer(whole[1:]))
            self.refused("is open", "sequence", name, *DROP)
        self.put("a.stl", binary_stl(seam))
        head = " ".join(self.run_program("sequence", "a.stl", *DROP).stdout.split())
        self.assertRegex(head, r" mesh: 12 triangles, \d+ corners joined; volume 0\.00085\S* m³ ± \S+, inertia ± \S+ kg·m² ")
        self.write("fine.toml", "[body]\nshape = 'mesh'\nmesh = { file = 'a.stl', weld = 1e-9 }\n")
        self.refused("is open", "sequence", "fine.toml", *DROP)

    def test_the_unit_is_given_by_name_or_number_and_before_that_of_the_file(self):
        self.put("a.obj", obj(box()))
        for unit, metres in (("mm", 0.001), ("cm", 0.01), ("m", 1), ("in", 0.0254), ("0.5", 0.5)):
            self.check("a.obj", box(), scale=metres, relative=1e-12, more=("--unit", unit))
        self.write("unit.toml", "[body]\nshape = 'mesh'\nmesh = { file = 'a.obj', unit = 'cm' }\n")
        self.assertEqual(self.json_of("sequence", "unit.toml", *DROP, status=(0, 4))["scene"]["body"]["mesh"]["unit"], 0.01)
        for name, contents, metres in (("inch.3mf", three_mf(box(), "inch"), 0.0254), ("cm.dae", dae(box(), 0.01), 0.01)):
            self.put(name, contents)
            self.check(name, box(), scale=metres, bar=1e-5)
            self.check(name, box(), scale=0.001, bar=1e-5, more=("--unit", "mm"))
        for bad in ("ft", "0", "-1", "nan"):
            self.refused("mm, cm, m, in", "sequence", "a.obj", *DROP, f"--unit={bad}")
        for unit, words in (("1000", "millimetres? say unit = \"mm\""), ("1e-7", "say the unit")):
            self.assertIn(words, self.run_program("sequence", "a.obj", *DROP, "--unit", unit).stderr)

    def test_a_node_of_gltf_moves_turns_and_scales_its_mesh(self):
        half = math.sqrt(0.5)
        self.put("a.gltf", gltf(box(), rotation=[0, 0, half, half], scale=[2, 2, 2], translation=[1, 0, 0]))
        self.check("a.gltf", [tuple((1 - 2 * y, 2 * x, 2 * z) for x, y, z in three) for three in box()], bar=1e-4)

    def test_a_mesh_stands_as_a_scene_or_is_a_flag(self):
        self.write("part.stl", stl(box((0, 0, 0), (100, 50, 20))))
        alone, by_flag = (self.json_of("sequence", *words, *DROP, "--unit", "mm") for words in (("part.stl",), ("--mesh", "part.stl")))
        self.write("rod.toml", "[body]\nlength = 2\nradius = 0.1\n")
        over = self.json_of("sequence", "rod.toml", "--mesh", "part.stl", "--unit", "mm", *DROP)
        same = self.json_of("sequence", "--body", "box", "--size", "0.1x0.05x0.02", *DROP)
        for one in (alone, by_flag, over):
            self.assertEqual(one["impacts"], alone["impacts"])
        for one, other in zip(alone["impacts"], same["impacts"], strict=True):
            self.assertAlmostEqual(one["impulse_normal"], other["impulse_normal"], delta=1e-12)
        self.refused("body.mass: required", "sequence", "part.stl", "--angle", "20")
        for name, contents, words in (("a.csv", b"t,x\n0,1\n", "(CSV)"), ("b.toml", b"# a table\n1;2;3\n", "(CSV)"),
                                      ("c.toml", b"\x7fELF\0\1\2", "binary")):
            self.put(name, contents)
            self.refused(words, "sequence", name, *DROP)

    def test_what_is_no_file_of_triangles_is_refused_in_a_line_and_in_little_time(self):
        os.mkdir(self.path("folder.stl"))
        os.mkfifo(self.path("pipe.obj"))
        lies = bytearray(binary_stl(box()))
        lies[80:84] = struct.pack("<I", 10**9)
        files = {"folder.stl": (None, "folder"), "pipe.obj": (None, "pipe"), "none.glb": (None, "cannot be opened"),
                 "lies.stl": (bytes(lies), "1000000000 triangles"), "empty.ply": (b"", "is empty"), "mark.obj": (b"\xef\xbb\xbf", "is empty"),
                 "lies.ply": (ply(box(), "binary_little_endian").replace(b"vertex 8", b"vertex 1000000000"), "truncated"),
                 "lies.off": (off(box()).replace(b"8 12 0", b"1000000000 1 0"), "the end of the file"),
                 "far.obj": (obj(box()).replace(b"f 1//", b"f 99//"), "not one of"), "word.off": (b"OFF x\n", "whole number"),
                 "nan.off": (off(box()).replace(b"0.47", b"nan", 1), "not finite"), "no.3mf": (b"PK\3\4", "no.3mf")}
        for name, (contents, words) in files.items():
            if contents is not None:
                self.put(name, contents)
            self.refused(words, "sequence", name, *DROP, timeout=600)

    def test_damaged_files_of_every_form_end_in_a_line_or_a_body(self):
        chance = random.Random(2)
        for name, (writer, _) in FORMS.items():
            whole = writer(torus(around=5, across=4))
            for _ in range(6):
                damaged = bytearray(whole[: chance.randrange(len(whole))] if chance.random() < 0.4 else whole)
                for _ in range(chance.randrange(1, 20)):
                    if damaged:
                        damaged[chance.randrange(len(damaged))] = chance.choice((0, 45, 49, 57, 255, chance.randrange(256)))
                self.put(name, bytes(damaged))
                done = self.run_program("sequence", name, *DROP, errors="replace", timeout=600)
                self.assertIn(done.returncode, (0, 2, 3, 4), (name, bytes(damaged)))
                self.assertLess(done.stderr.count("\n"), 4)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the small valid files that the fuzzers start from, DIR/<fuzzer>/*, and the words of each format, DIR/<fuzzer>.dict.

Usage: python3 make_corpus.py DIR
"""
import base64
import pathlib
import re
import struct
import sys
import zlib

POINTS = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0.5, 0.5, 1)]
FACETS = [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)]
POLYGONS = [(3, 2, 1, 0)] + FACETS


def lines(*rows):
    return ("\n".join(" ".join(str(x) for x in row) for row in rows) + "\n").encode()


def off():
    body = lines(*POINTS, *[(len(p), *p) for p in POLYGONS])
    coloured = lines(*[(*p, 10, 20, 30, 255) for p in POINTS], *[(len(p), *p, 0.1, 0.2, 0.3) for p in POLYGONS])
    return {"pyramid.off": b"OFF\n5 5 8\n" + body, "coloured.off": b"COFF\n# a comment\n5 5 0\n" + coloured}


def obj():
    points = lines(*[("v", *p) for p in POINTS])
    plain = lines(*[("f", *[i + 1 for i in p]) for p in POLYGONS])
    slashes = lines(*[("f", *[f"{i + 1}/{i + 1}/1" for i in p]) for p in FACETS])
    negative = lines(*[("f", *[i - 5 for i in p]) for p in FACETS])
    return {"plain.obj": points + plain,
            "slashes.obj": b"mtllib a.mtl\no box\n" + points + b"vt 0 0\nvn 0 0 1\ns off\n" + slashes,
            "negative.obj": points + negative + b"f 1 2 \\\n 5\nl 1 2\n"}


def stl():
    text = ["solid pyramid"]
    binary = b"binary".ljust(80) + struct.pack("<I", len(FACETS))
    for facet in FACETS:
        text += ["facet normal 0 0 1", "outer loop"]
        text += ["vertex {} {} {}".format(*POINTS[i]) for i in facet] + ["endloop", "endfacet"]
        binary += struct.pack("<12fH", 0, 0, 1, *[x for i in facet for x in POINTS[i]], 0)
    return {"text.stl": "\n".join(text + ["endsolid pyramid", ""]).encode(), "binary.stl": binary}


def ply():
    def header(kind, count="uchar"):
        return (f"ply\nformat {kind} 1.0\ncomment made by hand\nelement vertex 5\nproperty float x\nproperty float y\n"
                f"property double z\nelement face 5\nproperty list {count} int vertex_indices\nend_header\n").encode()
    files = {"text.ply": header("ascii") + lines(*POINTS, *[(len(p), *p) for p in POLYGONS])}
    for kind, order in (("binary_little_endian", "<"), ("binary_big_endian", ">")):
        points = b"".join(struct.pack(order + "ffd", *p) for p in POINTS)
        polygons = b"".join(struct.pack(f"{order}B{len(p)}i", len(p), *p) for p in POLYGONS)
        files[kind + ".ply"] = header(kind) + points + polygons
    return files


def gmsh():
    nodes = lines(*[(i + 1, *p) for i, p in enumerate(POINTS)])
    elements = lines((1, 3, 2, 0, 1, 4, 3, 2, 1), *[(k + 2, 2, 2, 0, 1, *[i + 1 for i in f]) for k, f in enumerate(FACETS)])
    old = b"$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n" + nodes + b"$EndNodes\n$Elements\n5\n" + elements + b"$EndElements\n"
    tags = lines(*[(i + 1,) for i in range(5)])
    facets = lines(*[(k + 1, *[i + 1 for i in f]) for k, f in enumerate(FACETS)])
    new = (b"$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Nodes\n1 5 1 5\n2 1 0 5\n" + tags + lines(*POINTS) +
           b"$EndNodes\n$Elements\n1 4 1 4\n2 1 2 4\n" + facets + b"$EndElements\n")
    return {"2.2.msh": old, "4.1.msh": new}


VTP_ARRAYS = {"points": ("Float32", 3, [x for p in POINTS for x in p]),
              "connectivity": ("Int64", 1, [i for p in POLYGONS for i in p]),
              "offsets": ("Int64", 1, [sum(map(len, POLYGONS[:k + 1])) for k in range(len(POLYGONS))])}


def vtp_file(array, attributes="", appended=b"", cells="Polys"):
    """A file of one piece; array(name) is the tag of an array."""
    counts = "".join(f' NumberOf{kind}="{5 if kind == cells else 0}"' for kind in ("Verts", "Lines", "Strips", "Polys"))
    return (f'<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian"{attributes}>\n'
            f'<PolyData><Piece NumberOfPoints="5"{counts}>\n<Points>{array("points")}</Points>\n'
            f'<{cells}>{array("connectivity")}{array("offsets")}</{cells}>\n</Piece></PolyData>').encode() + appended + b"</VTKFile>\n"


def vtp_array(name, form, inside="", extra=""):
    kind, components, _ = VTP_ARRAYS[name]
    return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="{form}"{extra}>{inside}</DataArray>'


def vtp_stored(name, packed):
    """The parts in which an array is stored; base64 encodes each on its own."""
    kind, _, numbers = VTP_ARRAYS[name]
    data = struct.pack(f"<{len(numbers)}{'f' if kind == 'Float32' else 'q'}", *numbers)
    if not packed:
        return [struct.pack("<I", len(data)) + data]
    block = zlib.compress(data)
    return [struct.pack("<4I", 1, len(data), 0, len(block)), block]


def base64_of(parts):
    return b"".join(base64.b64encode(part) for part in parts)


def vtp():
    files = {}
    for cells in ("Polys", "Strips"):
        files[f"text_{cells}.vtp"] = vtp_file(
            lambda name: vtp_array(name, "ascii", " ".join(str(x) for x in VTP_ARRAYS[name][2])), cells=cells)
    for packed in (False, True):
        attributes = ' header_type="UInt32"' + (' compressor="vtkZLibDataCompressor"' if packed else "")
        kind = "zlib" if packed else "plain"
        files[f"{kind}_inline.vtp"] = vtp_file(
            lambda name: vtp_array(name, "binary", base64_of(vtp_stored(name, packed)).decode()), attributes)
        for encoding, encoded in (("raw", b"".join), ("base64", base64_of)):
            offsets, appended = {}, b""
            for name in VTP_ARRAYS:
                offsets[name] = len(appended)
                appended += encoded(vtp_stored(name, packed))
            files[f"{kind}_appended_{encoding}.vtp"] = vtp_file(
                lambda name: vtp_array(name, "appended", extra=f' offset="{offsets[name]}"'), attributes,
                f'<AppendedData encoding="{encoding}">_'.encode() + appended + b"</AppendedData>")
    return files


def imports():
    """Two bytes before the file: the reader and the repairs, as import.cpp takes them."""
    broken = lines(("OFF",), (6, 6, 0), *POINTS, (0, 0, 0), *[(3, *f) for f in FACETS], (3, 5, 1, 4), (3, 0, 0, 1))
    files = {f"broken_{repairs}.bin": bytes([0, repairs]) + broken for repairs in (0, 1, 3, 7, 9, 15, 17, 31)}
    for reader, maker in enumerate((off, obj, stl, ply, gmsh, vtp)):
        for name, content in maker().items():
            files[f"{name}.bin"] = bytes([reader, 31]) + content
            files[f"detected_{name}.bin"] = bytes([6, 1]) + content
    return {name: content for name, content in files.items() if len(content) <= 2048}


SCENARIO = b"""[simulation]
duration = "2 s"
gravity = [0, 0, "-9.81 m/s2"]
threads = 2
[materials.gravel]
density = "2650 kg/m3"
young_modulus = "20 MPa"
friction_angle = "35 deg"
[[contacts]]
between = "gravel"
and = "gravel"
law = "cohesive_frictional"
tensile_strength = "1 kPa"
[[membranes]]
name = "sheet"
shape = { kind = "sheet", width = 0.4, length = "40 cm", cells = [4, 4] }
material = "gravel"
thickness = "1 mm"
young_modulus = "100 MPa"
density = "1100 kg/m3"
hold = "rim"
[[grains]]
name = "gravel"
material = "gravel"
mass = "0.2 kg"
sieves = [{ sieve = "6 mm", passing = 0 }, { sieve = "8 mm", passing = "30 %" }, { sieve = "16 mm", passing = 1 }]
box = { min = ["0 m", "0 m", "1 cm"], max = ["10 cm", "10 cm", "30 cm"] }
[[planes]]
name = "floor"
point = [0, 0, 0]
normal = [0, 0, 2]
material = "gravel"
[[loads]]
kind = "force"
membrane = "sheet"
nodes = "all"
force = [0, 0, "1 N"]
[output]
interval = "1 ms"
contact_list = true
reactions = [{ kind = "plane", plane = "floor" }]
[stop]
kinetic_energy = "1e-6 J"
"""


INFLATED = b"""[simulation]
duration = "2 ms"
[materials.rubber]
density = 1000
young_modulus = "1 MPa"
friction_angle = "20 deg"
[[membranes]]
name = "ball"
shape = { kind = "sphere", radius = "5 cm", subdivisions = 1 }
mode = "continuum"
young_modulus = "1 MPa"
density = 1000
material = "rubber"
thickness = "1 mm"
rest_pressure = "2 kPa"
[[rigid_bodies]]
name = "clump"
spheres = [{ centre = [0, 0, "10 cm"], radius = "1 cm" }, { centre = [0, "1 cm", "10 cm"], radius = "8 mm" }]
material = "rubber"
mass = "10 g"
inertia = ["1 kg cm2", "1 kg cm2", "1 kg cm2"]
hold = "xy"
[[ties]]
from = { membrane = "ball", nodes = "z_max" }
to = { kind = "body", rigid_body = "clump" }
brake = { force = "1 N", stroke = "1 cm" }
[[planes]]
name = "drum"
kind = "cylinder"
axis = [0, 1, 0]
point = [0, 0, 0]
radius = "20 cm"
angular_velocity = "10 rad/s"
material = "rubber"
[[loads]]
kind = "servo"
plane = "drum"
force = "1 N"
speed = "1 m/s"
"""


def scenario():
    """The examples of the program too, where their meshes are not needed."""
    files = {"small.toml": SCENARIO, "inflated.toml": INFLATED,
             "overrides.toml": b"--set grains.gravel.mass=3 kg\n--set simulation.damping=0.2\n" + SCENARIO}
    examples = pathlib.Path(__file__).resolve().parents[2] / "apps" / "examples"
    for example in sorted(examples.glob("*/*.toml")):
        files[example.name] = example.read_bytes()
    return files


def sieves():
    """A byte of choices, then for each row its size and what passes."""
    rows = [(0.006, 0), (0.008, 19660), (0.01, 19660), (0.016, 65535)]
    table = b"".join(struct.pack("<dH", *row) for row in rows)
    return {f"table_{choice}.bin": bytes([choice]) + table for choice in range(4)}


def bed():
    sphere = (0.1, 0.2, 0.3, 0.001, 0, 0, -1e-3, 0, 1.5, 0)
    return {"two.txt": lines((2, 0.01, 1), sphere, [2 * x for x in sphere]), "none.txt": b"0 0.01 3\n"}


def checkpoint():
    """A head without an image: what HDF5 writes is added by a run of the program, see README.md."""
    return {"head.h5": b"plekton checkpoint\nversion 1\nwriter 0.1.0\nbytes 0\nchecksum 243f6a8885a308d3\n".ljust(512, b"\0")}


def state():
    """Changes: place of an array, what to do, a power of 2, the place of a number, the number."""
    return {f"array_{k}.bin": struct.pack("<HBBIi", 7 * k, k % 9, (8 * k) % 64, k, (-1) ** k * k) for k in range(30)}


WORDS = {
    "scenario": "[simulation] [materials.a] [[contacts]] [[membranes]] [[rigid_bodies]] [[grains]] [[planes]] [[ties]] [[loads]] "
                "[output] [stop] [[stages]] inf nan -inf 1e999 -1 --set true false mm deg kPa rim lattice truss continuum sphere "
                "cylinder tube sheet motion force servo pressure ground_springs",
    "sieves": "",
    "bed": "1e999 nan inf -1 1e300 0x1 18446744073709551615",
    "checkpoint": "plekton checkpoint version writer bytes checksum",
    "state": "",
    "off": "OFF COFF NOFF CNOFF STOFF # nan inf 1e999 1e-999 -1 1e75",
    "obj": "v vt vn f fo l # \\ / // -1 nan 1e999",
    "stl": "solid facet normal outer loop vertex endloop endfacet endsolid nan 1e999",
    "ply": "ply format ascii binary_little_endian binary_big_endian 1.0 element vertex face tristrips property list char uchar "
           "short ushort int uint float double x y z vertex_indices vertex_index comment obj_info end_header",
    "gmsh": "$MeshFormat $EndMeshFormat $Nodes $EndNodes $Elements $EndElements $PhysicalNames $EndPhysicalNames 2.2 4.1 "
            "9223372036854775807 -9223372036854775808",
    "vtp": "<VTKFile <PolyData> <Piece <Points> <Polys> <Strips> <DataArray <AppendedData </VTKFile> </PolyData> </Piece> </Points> "
           "</Polys> </Strips> </DataArray> </AppendedData> <!-- --> <?xml ?> /> type= PolyData byte_order= LittleEndian BigEndian "
           "header_type= UInt32 UInt64 compressor= vtkZLibDataCompressor NumberOfPoints= NumberOfVerts= NumberOfLines= "
           "NumberOfStrips= NumberOfPolys= Name= offsets connectivity NumberOfComponents= format= ascii binary appended offset= "
           "encoding= raw base64 Int8 UInt8 Int16 UInt16 Int32 Int64 Float32 Float64",
}


def keys_of_scenarios():
    """The parts of all keys, from the one table of them."""
    table = pathlib.Path(__file__).resolve().parents[2] / "apps" / "scenario" / "key_meanings.cpp"
    paths = re.findall(r'^ *\{"([^"]+)"', table.read_text(), re.MULTILINE)
    if not paths:
        sys.exit(f"{table}: has no keys")
    return " ".join(sorted({part.removesuffix("[]") for path in paths for part in path.split(".")}))


def dictionary(words):
    escaped = (word.replace("\\", "\\\\") for word in words.split())
    return "".join(f'"{word}"\n' for word in escaped)


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    root = pathlib.Path(sys.argv[1])
    for maker in (off, obj, stl, ply, gmsh, vtp, imports, scenario, sieves, checkpoint, state, bed):
        folder = root / ("import" if maker is imports else maker.__name__)
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in maker().items():
            (folder / name).write_bytes(content)
    words = WORDS | {"scenario": WORDS["scenario"] + " " + keys_of_scenarios()}
    for name, words in (words | {"import": " ".join(WORDS.values())}).items():
        (root / f"{name}.dict").write_text(dictionary(words))


if __name__ == "__main__":
    main()

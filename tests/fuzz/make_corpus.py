# SPDX-License-Identifier: GPL-3.0-or-later
"""Writes the small valid files that the fuzzers start from: DIR/<format>/*, one folder for each fuzzer.

Usage: python3 make_corpus.py DIR
"""
import base64
import pathlib
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


def vtp():
    flat = [x for p in POINTS for x in p]
    corners = [i for p in POLYGONS for i in p]
    ends, end = [], 0
    for p in POLYGONS:
        end += len(p)
        ends.append(end)
    arrays = {"points": struct.pack("<15f", *flat), "connectivity": struct.pack(f"<{len(corners)}q", *corners),
              "offsets": struct.pack(f"<{len(ends)}q", *ends)}

    def text(array_of, attributes="", tail=""):
        return (f'<?xml version="1.0"?>\n<VTKFile type="PolyData" version="1.0" byte_order="LittleEndian" header_type="UInt32"{attributes}>\n'
                f'<PolyData><Piece NumberOfPoints="5" NumberOfPolys="5" NumberOfVerts="0" NumberOfLines="0" NumberOfStrips="0">\n'
                f'<Points>{array_of("points", "Float32", 3)}</Points>\n<Polys>{array_of("connectivity", "Int64", 1)}'
                f'{array_of("offsets", "Int64", 1)}</Polys>\n</Piece></PolyData>{tail}\n</VTKFile>\n').encode()

    def array(name, kind, components, form, inside, extra=""):
        return f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{components}" format="{form}"{extra}>{inside}</DataArray>'

    numbers = {"points": flat, "connectivity": corners, "offsets": ends}
    with_length = {name: struct.pack("<I", len(data)) + data for name, data in arrays.items()}

    def packed(data):
        block = zlib.compress(data)
        return base64.b64encode(struct.pack("<4I", 1, len(data), 0, len(block))) + base64.b64encode(block)

    offsets, appended = {}, b""
    for name, data in with_length.items():
        offsets[name] = len(appended)
        appended += data
    raw = text(lambda n, k, c: array(n, k, c, "appended", "", f' offset="{offsets[n]}"'), "", "@")
    return {
        "text.vtp": text(lambda n, k, c: array(n, k, c, "ascii", " ".join(str(x) for x in numbers[n]))),
        "base64.vtp": text(lambda n, k, c: array(n, k, c, "binary", base64.b64encode(with_length[n]).decode())),
        "zlib.vtp": text(lambda n, k, c: array(n, k, c, "binary", packed(arrays[n]).decode()),
                         ' compressor="vtkZLibDataCompressor"'),
        "raw.vtp": raw.replace(b"@", b'<AppendedData encoding="raw">_' + appended + b"</AppendedData>"),
    }


def imports():
    """The first byte chooses the repairs."""
    broken = lines(("OFF",), (6, 6, 0), *POINTS, (0, 0, 0), *[(3, *f) for f in FACETS], (3, 5, 1, 4), (3, 0, 0, 1))
    return {f"{choice}.bin": bytes([choice]) + data for choice in (0, 1, 3, 7, 9, 15) for data in (off()["pyramid.off"], broken)}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    for maker in (off, obj, stl, ply, gmsh, vtp, imports):
        folder = pathlib.Path(sys.argv[1]) / ("import" if maker is imports else maker.__name__)
        folder.mkdir(parents=True, exist_ok=True)
        for name, content in maker().items():
            (folder / name).write_bytes(content)


if __name__ == "__main__":
    main()

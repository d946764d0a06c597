# SPDX-License-Identifier: GPL-3.0-or-later
"""Makes the meshes of the tour and membrane_tour.toml: python3 make_tour.py, in this folder."""
import math
import random

LENGTH, WIDTH, CELL = 0.4, 0.12, 0.02  # m


def fold(x):
    """Slopes of 20 degrees: a valley, a ridge and a valley."""
    return math.tan(math.radians(20)) * abs(abs(x) - 0.1)


SURFACES = {
    "random": lambda x, y: 0.0,
    "ripple": lambda x, y: 0.006 * math.sin(2 * math.pi * x / 0.1),
    "fold": lambda x, y: fold(x),
    "saddle": lambda x, y: 0.6 * (x * x - 4 * y * y),
}


def mesh(name, height, chance):
    across, along = round(WIDTH / CELL), round(LENGTH / CELL)
    points = []
    for i in range(along + 1):
        for j in range(across + 1):
            x, y = i * CELL - LENGTH / 2, j * CELL - WIDTH / 2
            if name == "random" and 0 < i < along and 0 < j < across:
                x, y = x + chance.uniform(-4e-3, 4e-3), y + chance.uniform(-4e-3, 4e-3)
            points.append((x, y, height(x, y)))
    facets = []
    for i in range(along):
        for j in range(across):
            a, b = i * (across + 1) + j, (i + 1) * (across + 1) + j
            facets += [(a, b, b + 1), (a, b + 1, a + 1)] if (i + j) % 2 == 0 else [(a, b, a + 1), (b, b + 1, a + 1)]
    with open(f"{name}.off", "w") as file:
        file.write(f"OFF\n# SPDX-License-Identifier: GPL-3.0-or-later\n{len(points)} {len(facets)} 0\n")
        file.writelines("%.6g %.6g %.6g\n" % p for p in points)
        file.writelines("3 %d %d %d\n" % f for f in facets)
    return points, facets


def edges(facets):
    return sorted({tuple(sorted(pair)) for a, b, c in facets for pair in ((a, b), (b, c), (c, a))})


def is_closed(facet):
    """Of the sheet that is partly a net: whether a facet is in one of the closed bands, four cells long with four open ones between."""
    return min(node // (round(WIDTH / CELL) + 1) for node in facet) % 8 < 4


def rows(key, numbers, form):
    """A list of TOML on lines of some length."""
    words, lines, line = [form % tuple(x) for x in numbers], [], "   "
    for word in words:
        if len(line) + len(word) > 130:
            lines.append(line)
            line = "   "
        line += f" {word},"
    return "\n".join([f"{key} = [", *lines, line, "]"]) + "\n"


def above_bars(points, bars, x, y):
    """Where the centre of a ball has 0.2 mm of room above bars."""
    def room(z):
        least = math.inf
        for a, b in ((points[i], points[j]) for i, j in bars):
            along, to = [v - u for u, v in zip(a, b)], [v - u for u, v in zip(a, (x, y, z))]
            t = min(1.0, max(0.0, sum(u * v for u, v in zip(along, to)) / sum(u * u for u in along)))
            least = min(least, math.dist((x, y, z), [u + t * v for u, v in zip(a, along)]))
        return least - 0.0252

    low, high = 0.0, 0.1
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (low, middle) if room(middle) > 0 else (middle, high)
    return high


def height_above(height, x, y):
    """Where the centre of a ball has 0.2 mm of room above a surface."""
    reach = [(0.001 * i, 0.001 * j) for i in range(-25, 26) for j in range(-25, 26) if i * i + j * j <= 625]
    return max(height(x + u, y + v) + math.sqrt(0.0252**2 - u * u - v * v) for u, v in reach)


HEAD = '''# SPDX-License-Identifier: GPL-3.0-or-later
# Spheres slide, roll and spin over sheets, flat with irregular facets, rippled, folded, and a saddle, over the ripple as a net of bars,
# and over one that is partly closed; see README.md. Written by make_tour.py.
# Run:   plekton run apps/examples/membrane_tour/membrane_tour.toml
# Keys:  apps/scenario.md

[simulation]
duration = "3.2 s"
time_step = "20 us"
damping = 0.3          # they fall by 0.2 mm, and bounce at every fold
self_contact = false   # the sheets are fixed

[materials.ball]      # soft, so that overlaps are a hundredth of half the thickness, and steps long
density = "2650 kg/m3"
young_modulus = "1 MPa"
friction_angle = "20 deg"

[output]
interval = "40 ms"
history_interval = "4 ms"
'''

SHEET = '''
[[membranes]]
name = "{name}"
mesh = "{name}.off"
translate = [0, "{y:g} mm", 0]
mode = "truss"
thickness = "10 mm"
young_modulus = "1 MPa"
density = "1000 kg/m3"
material = "ball"
hold = "all"
'''

BARS = '''
[[membranes]]
name = "{name}"
translate = [0, "{y:g} mm", 0]
mode = "truss"
thickness = "10 mm"
young_modulus = "1 MPa"
density = "1000 kg/m3"
material = "ball"
hold = "all"

[membranes.shape]   # points in m
kind = "{kind}"
{lists}'''

BALL = '''
[[grains]]
name = "{name}"
material = "ball"
centres = [["-160 mm", "{y:g} mm", "{z:g} mm"]]
radius = "20 mm"
{start}
[[loads]]
name = "{name}"
kind = "motion"
grains = "{name}"
velocity = ["100 mm/s", "5 mm/s", 0]
components = "xy"
{turn}

[[output.reactions]]
kind = "contacts"
grains = "{name}"

[[output.reactions]]
name = "place of {name}"
kind = "nodes"
grains = "{name}"
nodes = "all"
'''

WAYS = {
    "slides": ("", "hold_rotation = true"),
    "rolls": ('angular_velocity = [-0.25, 5, 0]\n', ""),
    "spins": ("", "angular_velocity = [3, -2, 20]"),
}


def balls(name, shift, height_at):
    """The text of the three balls of a surface."""
    text = ""
    for place, (way, (start, turn)) in zip((-0.05, -0.005, 0.04), WAYS.items()):
        z = 1e3 * height_at(-0.16, place)
        text += BALL.format(name=f"{name}: {way}", y=shift + 1e3 * place, z=z, start=start, turn=turn)
    return text


def main():
    chance = random.Random(1)
    text, meshes = HEAD, {}
    for number, (name, height) in enumerate(SURFACES.items()):
        meshes[name] = mesh(name, height, chance)
        shift = 150.0 * number
        text += SHEET.format(name=name, y=shift)
        text += balls(name, shift, lambda x, y: height_above(height, x, y))

    # The ripple again: as a net of bars along all of its edges, and as one of which bands are closed with facets.
    points, facets = meshes["ripple"]
    bars = edges(facets)
    closed = [facet for facet in facets if is_closed(facet)]
    open_bars = sorted(set(bars) - set(edges(closed)))
    as_points, as_bars = rows("points", points, "[%.6g, %.6g, %.6g]"), rows("bars", bars, "[%d, %d]")
    text += BARS.format(name="net", y=600.0, kind="bars", lists=as_points + as_bars)
    text += balls("net", 600.0, lambda x, y: above_bars(points, bars, x, y))
    lists = as_points + rows("facets", closed, "[%d, %d, %d]") + rows("bars", open_bars, "[%d, %d]")
    text += BARS.format(name="partly closed", y=750.0, kind="facets", lists=lists)
    text += balls("partly closed", 750.0, lambda x, y: height_above(SURFACES["ripple"], x, y))
    with open("membrane_tour.toml", "w") as file:
        file.write(text)


main()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a net has stopped a boulder, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of rockfall_net.toml. Writes boulder.csv, ropes.csv and split.csv into it, for rockfall.gnuplot. Ends 1 where
something is out of its bounds.
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, check_runs, columns, report_of, write  # noqa: E402

MASS, SPEED, RADIUS, GRAVITY = 500.0, 6.0, 0.35357, 9.81  # SI
BRAKE_FORCE, STROKE = 10e3, 0.6  # N, m
SIDES = ("left", "right", "front", "back")


def rope_tensions(ties):
    """The larger of both ends of each rope, by row: a brake bears what its rope does."""
    ends = [[ties[f"{side}_brakes[{end}].tension"] for end in (0, 1)] for side in SIDES]
    return [[max(pair) for pair in zip(*both)] for both in ends]


def write_curves(run, boulder, ties, energy):
    """What happens over time."""
    write(run / "boulder.csv", ["time (ms)", "force (kN)", "below the net (m)"],
          zip([1e3 * t for t in boulder["time"]], [1e-3 * f for f in boulder["boulder.force_z"]], [RADIUS - z for z in boulder["boulder.position_z"]]), digits=6)
    times = [1e3 * t for t in ties["time"]]
    write(run / "ropes.csv", ["time (ms)", *SIDES], zip(times, *([1e-3 * f for f in rope] for rope in rope_tensions(ties))), digits=6)
    brakes = [sum(values) for values in zip(*(ties[f"{side}_brakes.dissipated"] for side in SIDES))]
    shackles = [sum(values) for values in zip(*(ties[f"{side}_shackles.dissipated"] for side in SIDES))]
    wires = [total - a - b for total, a, b in zip(energy["bond_dissipated"], brakes, shackles)]
    stored = [a + b for a, b in zip(energy["bond_elastic"], energy["contact_elastic"])]
    lost = [a + b for a, b in zip(energy["friction"], energy["damping"])]
    parts = {"motion": energy["kinetic"], "height": energy["gravity"], "brakes": brakes, "shackles": shackles, "wires": wires, "stored": stored,
             "friction and damping": lost}
    write(run / "split.csv", ["time (ms)", *parts], zip(times, *([1e-3 * value for value in part] for part in parts.values())), digits=6)


def trapezoid(t, f, end):
    """Integral of f up to row end."""
    return sum(0.5 * (f[i] + f[i + 1]) * (t[i + 1] - t[i]) for i in range(end))


def check(run, bounds):
    report = report_of(run)
    boulder, ties, energy = columns(run / "reactions.csv"), columns(run / "ties.csv"), columns(run / "energy.csv")
    t, z, force = boulder["time"], boulder["boulder.position_z"], boulder["boulder.force_z"]
    low = min(range(len(z)), key=z.__getitem__)
    fall = z[0] - z[low]
    write_curves(run, boulder, ties, energy)
    available = 0.5 * MASS * SPEED**2 + MASS * GRAVITY * fall

    # Newton: at the lowest point the momentum is gone.
    stopped = trapezoid(t, force, low) / (MASS * (SPEED + GRAVITY * t[low]))
    bounds.expect("impulse of the net over momentum, at the turn", stopped, 0.99, 1.01, "m (v + g t)")
    bounds.expect("boulder turns before the end: time left (s)", t[-1] - t[low], 0.02, 1e9, "it is stopped")

    # Brakes are rigid and perfectly plastic but for their springs.
    heads = [f"{side}_brakes[{end}]" for side in SIDES for end in (0, 1)]
    paid = [max(ties[f"{head}.slip"]) for head in heads]
    tension = max(max(ties[f"{head}.tension"]) for head in heads)
    bounds.expect("largest tension in a brake (N)", tension, 0.99 * BRAKE_FORCE, (1 + 1e-9) * BRAKE_FORCE, "it pays out at that")
    bounds.expect("longest way of a brake (m)", max(paid), 0.0, STROKE, "its stroke")
    in_brakes = sum(ties[f"{side}_brakes.dissipated"][-1] for side in SIDES)
    bounds.expect("energy in brakes over force times way", in_brakes / (BRAKE_FORCE * sum(paid)), 0.99, 1.01, "F s")
    for one, other in (("left", "right"), ("front", "back")):
        ways = [sum(paid[2 * SIDES.index(side) : 2 * SIDES.index(side) + 2]) for side in (one, other)]
        bounds.expect(f"way of brakes, {one} over {other}", ways[0] / ways[1], 0.8, 1.25, "the boulder falls into the middle")

    # What the boulder had is somewhere.
    row = lambda name: energy[name][-1]
    in_shackles = sum(ties[f"{side}_shackles.dissipated"][-1] for side in SIDES)
    split = {
        "brakes": in_brakes,
        "shackles that slide": in_shackles,
        "wires that yield": row("bond_dissipated") - in_brakes - in_shackles,
        "friction of the boulder on wires": row("friction"),
        "damping": row("damping"),
        "stored": row("bond_elastic") + row("contact_elastic"),
        "motion": row("kinetic"),
        "height": row("gravity"),
    }
    start = 0.5 * MASS * SPEED**2
    bounds.expect("all energy at the end over that at the start", sum(split.values()) / start, 0.99, 1.01, "nothing is lost")
    bounds.expect("energy taken by brakes over that of the boulder", in_brakes / available, 0.4, 1.0, "what they are for")
    bounds.expect("energy taken by damping over that of the boulder", split["damping"] / available, 0.0, 0.1, "it only takes the hum")
    bounds.expect("broken wires", report["counts"]["broken_bonds"], 0, 0, "the net holds")
    bounds.expect("broken ties", report["counts"]["broken_ties"], 0, 0, "they have no strength")
    bounds.expect_sound(report)

    print(f"  the boulder goes {1e3 * (RADIUS - z[low]):.0f} mm below the net in {1e3 * t[low]:.0f} ms; largest force on it {max(force) / 1e3:.1f} kN")
    print("  largest tension of ropes: " + ", ".join(f"{side} {max(rope) / 1e3:.2f} kN" for side, rope in zip(SIDES, rope_tensions(ties))))
    print(f"  brakes pay out {1e3 * min(paid):.0f} to {1e3 * max(paid):.0f} mm")
    print("  energy at the end: " + ", ".join(f"{name} {value / 1e3:.2f} kJ" for name, value in split.items()))


check_runs(__doc__, check, Bounds())

# SPDX-License-Identifier: GPL-3.0-or-later
"""Says how a sphere bounced, and whether that can be: python3 check.py RUN [RUN ...]

RUN is the folder of a run of bouncing_sphere.toml, gas.toml, incline.toml or gas_incline.toml, or of a run of the study speeds.toml. Ends 1 where
something is out of its bounds. Runs of the same speed with different steps are compared.
"""
import math
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from results import Bounds, columns, mean, report_of, runs_of_arguments  # noqa: E402

SLOPE = math.atan(0.29337)
FRICTION = math.tan(math.radians(20))
THROWN = 5.0  # m/s, downwards, of the ball full of gas
OUTSIDE = 101325.0  # Pa
EXPONENT = 1.4


def slope(t, x):
    """Of the straight line through points: vibrations of the ball average out over many of their periods."""
    mean_t, mean_x = mean(t), mean(x)
    return sum((a - mean_t) * (b - mean_x) for a, b in zip(t, x)) / sum((a - mean_t) ** 2 for a in t)


class Bounce:
    """Speeds before and after, and times, of what hits a plane and leaves it."""

    def __init__(self, run, plane, height, gravity=0.0):
        history = columns(run / "reactions.csv")
        self.t = history["time"]
        # Without what gravity does, the flight is straight.
        self.z = [z + 0.5 * gravity * t * t for t, z in zip(self.t, height(history))]
        touching = [i for i, force in enumerate(history[f"{plane}.force_z"]) if force != 0]
        if not touching:
            sys.exit(f"{run}: nothing has touched {plane}")
        self.touch = touching[0]
        # Up to the first pause of 5 ms: later the ball falls again, where there is gravity.
        self.leave = next((i for i, j in zip(touching, touching[1:]) if self.t[j] - self.t[i] > 5e-3), touching[-1])
        later = next((j for j in touching if j > self.leave), len(self.t))
        before = [i for i in range(self.touch) if self.t[i] > self.t[self.touch] - 1e-3]
        after = range(self.leave + 1, later)
        self.v_in = gravity * self.t[self.touch] - slope([self.t[i] for i in before], [self.z[i] for i in before])
        self.v_out = slope([self.t[i] for i in after], [self.z[i] for i in after]) - gravity * self.t[self.leave]
        self.restitution = self.v_out / self.v_in

    def below(self):
        """Time (s) in which the centre is nearer than where the ball touched first."""
        back = next(i for i in range(self.touch + 10, len(self.z)) if self.z[i] > self.z[self.touch])
        return self.t[back] - self.t[self.touch]


def check_empty(run, bounds):
    bounce = Bounce(run, "wall", lambda h: h["ball.position_z"])
    bounds.expect("restitution", bounce.restitution, *((0.85, 1.0) if bounce.v_in < 1.25 else (0.5, 1.0)), "elastic: at most 1; A20 at 1 m/s")
    print(f"  in {bounce.v_in:.3f} m/s, out {bounce.v_out:.3f} m/s, contact for {1e3 * (bounce.t[bounce.leave] - bounce.t[bounce.touch]):.1f} ms")
    return bounce


def rows_when_full(run, bounds):
    """The history of the gas, and its rows once the ball is inflated."""
    gas = columns(run / "pressures.csv")
    full = [i for i, t in enumerate(gas["time"]) if t > 0.0201]
    states = [(gas["air.pressure"][i] + OUTSIDE) * gas["air.volume"][i] ** EXPONENT for i in full]
    bounds.expect("largest change of p V^1.4", max(states) / min(states) - 1, 0, 1e-9, "gas without exchange of heat")
    return gas, full


def check_gas(run, bounds):
    bounce = Bounce(run, "wall", lambda h: h["ball.position_z"])
    gas, full = rows_when_full(run, bounds)
    energy = columns(run / "energy.csv")
    before = max(i for i in full if gas["time"][i] < bounce.t[bounce.touch])
    radius = (3 * gas["air.volume"][before] / 4 / math.pi) ** (1 / 3)
    mass = 2 * max(energy["kinetic"][i] for i, t in enumerate(energy["time"]) if t < bounce.t[bounce.touch]) / bounce.v_in**2
    cap = math.pi * math.sqrt(mass / (2 * math.pi * radius * gas["air.pressure"][before]))
    bounds.expect("restitution", bounce.restitution, 0.85, 1.0, "elastic: at most 1")
    bounds.expect("time below where it touches, over that of a cap", bounce.below() / cap, 0.8, 1.25, f"pi sqrt(m / (2 pi R p)) = {1e3 * cap:.2f} ms")
    print(f"  in {bounce.v_in:.3f} m/s, out {bounce.v_out:.3f} m/s, {1e3 * bounce.below():.2f} ms, pressure {gas['air.pressure'][before] / 1e3:.1f} to {max(gas['air.pressure'][i] for i in full) / 1e3:.1f} kPa")


def on_incline(run, gravity):
    """The bounce along the normal of the incline, its history, and places along the incline, downhill."""
    sine, cosine = math.sin(SLOPE), math.cos(SLOPE)
    bounce = Bounce(run, "incline", lambda h: [sine * x + cosine * z for x, z in zip(h["ball.position_x"], h["ball.position_z"])], gravity * cosine)
    history = columns(run / "reactions.csv")
    return bounce, history, [cosine * x - sine * z for x, z in zip(history["ball.position_x"], history["ball.position_z"])]


def check_slip(history, bounds, aside):
    """@param aside  largest way out of the plane of symmetry (m)"""
    sine, cosine = math.sin(SLOPE), math.cos(SLOPE)
    middle = history["ball.position_y"][0]
    bounds.expect("largest way out of the plane of symmetry (m)", max(abs(y - middle) for y in history["ball.position_y"]), 0, aside, "symmetry")
    slip = 0.0
    for x, z in zip(history["incline.force_x"], history["incline.force_z"]):
        pressed = -(sine * x + cosine * z)
        if pressed > 0:
            slip = max(slip, abs(cosine * x - sine * z) / pressed)
    bounds.expect("largest tangential over normal force", slip, 0, FRICTION * (1 + 1e-9), "Coulomb: tan 20 deg")


def check_gas_incline(run, bounds):
    bounce, history, along = on_incline(run, 0.0)
    rows_when_full(run, bounds)
    check_slip(history, bounds, 1e-3)  # a limp sheet wrinkles, and what rounding begins grows
    bounds.expect("restitution along the normal", bounce.restitution, 0.85, 1.0, "elastic: at most 1")
    expected = THROWN * math.cos(SLOPE)
    bounds.expect("speed at the incline (m/s)", bounce.v_in, 0.99 * expected, 1.01 * expected, "as it was thrown")
    after = range(bounce.leave + 1, len(bounce.t))
    out = slope([bounce.t[i] for i in after], [along[i] for i in after])
    bounds.expect("speed along the incline, out over in", out / (THROWN * math.sin(SLOPE)), 0.2, 0.6, "a shell that grips: elastic 1/5, rolling 3/5")
    print(f"  in {bounce.v_in:.3f} m/s, out {bounce.v_out:.3f} m/s along the normal, {out:.3f} m/s along the incline")


def check_incline(run, bounds):
    cosine, sine = math.cos(SLOPE), math.sin(SLOPE)
    bounce, history, _ = on_incline(run, 9.81)
    check_slip(history, bounds, 1e-9)
    bounds.expect("restitution along the normal", bounce.restitution, 0.5, 1.0, "A21")
    heights = [sine * x + cosine * z for x, z in zip(history["ball.position_x"], history["ball.position_z"])]
    expected = math.sqrt(2 * 9.81 * cosine * (heights[0] - heights[bounce.touch]))
    bounds.expect("speed at the incline (m/s)", bounce.v_in, 0.995 * expected, 1.005 * expected, "free fall")
    print(f"  in {bounce.v_in:.3f} m/s, out {bounce.v_out:.3f} m/s along the normal")


def main():
    bounds, empty = Bounds(46), {}
    for run in runs_of_arguments(__doc__):
        print(run)
        has_gas, has_incline = (run / "pressures.csv").exists(), "incline.force_z" in columns(run / "reactions.csv")
        if has_gas or has_incline:
            {(True, False): check_gas, (False, True): check_incline, (True, True): check_gas_incline}[has_gas, has_incline](run, bounds)
        else:
            bounce = check_empty(run, bounds)
            empty.setdefault(round(bounce.v_in, 6), []).append(bounce.restitution)
        bounds.expect_sound(report_of(run))
    for speed, values in empty.items():
        # Faster, the shell dimples: it snaps, and what it keeps of that depends on everything.
        if len(values) > 1 and speed < 1.25:
            bounds.expect(f"change with the step at {speed:g} m/s", max(values) / min(values) - 1, 0, 5e-3, "A20")
    sys.exit(0 if bounds.hold else 1)


main()

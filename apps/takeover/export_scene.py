# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs a script in YADE to an iteration and writes what is there then, as JSON in SI units.

Usage, from plekton import-yade: yade -n -x -j1 export_scene.py SCRIPT ITERATION OUT [LATER_ITERATION OUT]...
The first iteration may be "end": where the script ends.
"""

import json
import locale
import math
import os
import sys
import traceback
import types

script = os.path.abspath(sys.argv[1])
stops = [(None if at == "end" else int(at), os.path.abspath(out)) for at, out in zip(sys.argv[2::2], sys.argv[3::2])]


class Anything:
    """Stands in for windows, which are not there: it may be called, asked and told anything."""

    def __init__(self, *_, **__):
        pass

    def __call__(self, *_, **__):
        return Anything()

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)
        return Anything()

    def __setattr__(self, name, value):
        pass


def without_windows():
    """Modules that would open windows, replaced."""
    windows = types.ModuleType("yade.qt")
    windows.__getattr__ = lambda name: Anything()
    sys.modules["yade.qt"] = windows
    import yade

    yade.qt = windows
    os.environ["MPLBACKEND"] = "Agg"


def with_any_locale():
    """A locale that this machine has not is taken as that of C, whose numbers have points too."""
    set_locale = locale.setlocale

    def set_what_there_is(category, name=None):
        try:
            return set_locale(category, name)
        except locale.Error:
            return set_locale(category, "C.UTF-8")

    locale.setlocale = set_what_there_is


def run_script():
    """Runs it as YADE would, from its own folder and among the names that YADE's engines know, and goes on to the first iteration."""
    omega, target, file_name = O, stops[0][0], script
    os.chdir(os.path.dirname(file_name))
    sys.argv = [file_name]
    sys.path.insert(0, os.path.dirname(file_name))
    if target:
        omega.stopAtIter = target
    with open(file_name, encoding="utf-8") as file:
        code = compile(file.read(), file_name, "exec")
    ours = dict(globals())
    globals()["__file__"] = file_name
    try:
        exec(code, globals())
    except SystemExit:
        pass
    if target is None:
        target = end_of_script(omega)
    if omega.running:
        omega.pause() if omega.iter >= target else omega.wait()
    reached = omega.iter
    if reached < target:
        omega.run(target - reached, True)
    globals().update(ours)  # what the script calls by the same names
    if reached > target:
        raise SystemExit(
            f"error: the script has run to iteration {reached} by itself; --iteration has to be at least that, "
            "and --iteration end takes what is there then"
        )


def end_of_script(omega):
    """The iteration at which a script that has been run ends, which it may have told YADE only."""
    if not omega.running:
        return omega.iter
    if omega.stopAtIter <= 0:
        raise SystemExit("error: the script leaves YADE running without an end; name an --iteration")
    return omega.stopAtIter


def vector(v):
    return [float(v[0]), float(v[1]), float(v[2])]


def motion(body):
    """What blocks a body, and how it moves."""
    state = body.state
    return {
        "v": vector(state.vel),
        "w": vector(state.angVel),
        "blocked": state.blockedDOFs if body.dynamic else "xyzXYZ",
        "mass": float(state.mass),
    }


MATERIAL = {
    "young": "young",
    "poisson": "poisson",
    "frictionAngle": "friction_angle",
    "isCohesive": "is_cohesive",
    "normalCohesion": "normal_cohesion",
    "shearCohesion": "shear_cohesion",
    "momentRotationLaw": "rolls",
    "alphaKr": "rolling_stiffness",
    "alphaKtw": "twisting_stiffness",
    "etaRoll": "rolling_limit",
    "etaTwist": "twisting_limit",
}
"""Attributes of YADE's materials, and what they are called here."""


class Export:
    def __init__(self):
        self.materials = []
        self.spheres, self.nodes, self.connections, self.pfacets = [], [], [], []
        self.walls, self.facets, self.clumps, self.bonds = [], [], [], []
        self.others = {}
        self.contacts = 0
        self.glued = 0

    def material(self, body):
        """Its place among the materials."""
        material = body.material
        if material is None:
            return -1
        told = {"type": type(material).__name__, "label": material.label}
        for name, ours in MATERIAL.items():
            value = getattr(material, name, None)
            if isinstance(value, bool) or (isinstance(value, (int, float)) and math.isfinite(value)):
                told[ours] = value
        if told not in self.materials:
            self.materials.append(told)
        return self.materials.index(told)

    def add(self, body):
        shape = body.shape
        kind = type(shape).__name__ if shape is not None else "nothing"
        told = {"id": body.id, "material": self.material(body), "x": vector(body.state.pos), **motion(body)}
        if kind == "Sphere":
            if not body.isClumpMember:
                self.spheres.append({**told, "r": shape.radius})
        elif kind == "GridNode":
            self.nodes.append({**told, "r": shape.radius, "inertia": float(body.state.inertia[0])})
        elif kind == "GridConnection":
            self.connections.append({**told, "r": shape.radius, "nodes": [shape.node1.id, shape.node2.id]})
        elif kind == "PFacet":
            nodes = [shape.node1.id, shape.node2.id, shape.node3.id]
            self.pfacets.append({**told, "r": shape.radius, "nodes": nodes})
        elif kind == "Wall":
            self.walls.append({**told, "axis": int(shape.axis), "sense": int(shape.sense)})
        elif kind == "Facet":
            self.add_facets(told, body, shape.vertices, [[0, 1, 2]])
        elif kind == "Box":
            self.add_box(told, body)
        elif kind == "Clump":
            self.add_clump(told, body)
        else:
            self.others[kind] = self.others.get(kind, 0) + 1

    def add_facets(self, told, body, corners, facets):
        points = [vector(body.state.pos + body.state.ori * v) for v in corners]
        self.facets.append({**told, "points": points, "facets": facets})

    def add_box(self, told, body):
        half = body.shape.extents
        flat = [i for i in range(3) if half[i] <= 0]
        if len(flat) > 1:
            self.others["Box without an area"] = self.others.get("Box without an area", 0) + 1
        elif flat:
            u, v = [i for i in range(3) if i not in flat]
            corners = []
            for a, b in ((-1, -1), (1, -1), (1, 1), (-1, 1)):
                corner = Vector3(0, 0, 0)
                corner[u], corner[v] = a * half[u], b * half[v]
                corners.append(corner)
            self.add_facets(told, body, corners, [[0, 1, 2], [0, 2, 3]])
        else:
            corners = [Vector3((i & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i >> 2) * 2 - 1) for i in range(8)]
            corners = [Vector3(c[0] * half[0], c[1] * half[1], c[2] * half[2]) for c in corners]
            sides = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]]
            self.add_facets(told, body, corners, [t for a, b, c, d in sides for t in ([a, b, c], [a, c, d])])
            self.facets[-1]["half"] = vector(half)

    def add_clump(self, told, body):
        members = [O.bodies[i] for i in body.shape.members]
        if any(type(m.shape).__name__ != "Sphere" for m in members):
            self.others["Clump of other bodies than spheres"] = self.others.get("Clump of other bodies than spheres", 0) + 1
            return
        spheres = [{"x": vector(m.state.pos), "r": m.shape.radius} for m in members]
        axes = [vector(body.state.ori * Vector3(*(float(i == k) for i in range(3)))) for k in range(3)]
        self.clumps.append({**told, "material": self.material(members[0]), "spheres": spheres,
                            "inertia": vector(body.state.inertia), "axes": axes})

    def add_interaction(self, interaction):
        """Between grid nodes it is a beam; others are contacts."""
        if not interaction.isReal:
            return
        if type(interaction.geom).__name__ != "GridNodeGeom6D":
            self.contacts += 1
            if getattr(interaction.phys, "normalAdhesion", 0) > 0 and not getattr(interaction.phys, "cohesionBroken", True):
                self.glued += 1
            return
        phys = interaction.phys
        a, b = interaction.id1, interaction.id2
        radii = O.bodies[a].shape.radius + O.bodies[b].shape.radius
        self.bonds.append({
            "nodes": [a, b], "kn": phys.kn, "kr": getattr(phys, "kr", 0.0), "ktw": getattr(phys, "ktw", 0.0),
            "rest_length": radii - getattr(phys, "unp", 0.0), "force": float(phys.normalForce.norm()),
            "broken": bool(getattr(phys, "cohesionBroken", False)), "fragile": bool(getattr(phys, "fragile", True)),
            "normal_adhesion": min(getattr(phys, "normalAdhesion", 1e300), 1e300),
        })


def permanent_forces():
    """On bodies that are there, of those that have any."""
    forces = []
    if not O.forces.getPermForceUsed():
        return forces  # asked for one where there are none, YADE 2023 ends with a segmentation fault
    for body in O.bodies:
        force, torque = O.forces.permF(body.id), O.forces.permT(body.id)
        if force.norm() > 0 or torque.norm() > 0:
            forces.append({"id": body.id, "force": vector(force), "torque": vector(torque)})
    return forces


LEFT_OUT = {
    "Ip2": ("en", "es", "betan", "betas", "gamma", "eta", "krot", "ktwist", "frictAngle", "kn", "ks"),
    "Law2": ("includeMoment", "includeAdhesion"),
}
"""Attributes of functors that have no counterpart where they are set, by how the names of the functors begin."""


def settings_left_out(functor):
    """Those that are set: by default they are None, False or 0."""
    kind = type(functor).__name__.split("_")[0]
    return [name for name in LEFT_OUT.get(kind, ()) if getattr(functor, name, None)]


def engine_facts():
    """What engines there are, and what the integrator is told."""
    facts = {"engines": [], "functors": [], "functor_settings": {},
             "gravity": [0.0, 0.0, 0.0], "damping": 0.0, "damp_gravity": True, "stepper": ""}
    for engine in O.engines:
        name = type(engine).__name__
        if getattr(engine, "dead", False):
            continue
        facts["engines"].append(name)
        if name == "NewtonIntegrator":
            facts["gravity"] = vector(engine.gravity)
            facts["damping"] = float(engine.damping)
            facts["damp_gravity"] = bool(getattr(engine, "dampGravity", True))
        if name == "InteractionLoop":
            for dispatcher in (engine.geomDispatcher, engine.physDispatcher, engine.lawDispatcher):
                for functor in dispatcher.functors:
                    facts["functors"].append(type(functor).__name__)
                    if left_out := settings_left_out(functor):
                        facts["functor_settings"][type(functor).__name__] = left_out
                    for flag in ("setCohesionNow", "setCohesionOnNewContacts"):
                        if getattr(functor, flag, False):
                            facts["functors"].append(flag)
        if name.endswith("TimeStepper"):
            facts["stepper"] = name
    return facts


WORDS = {"x": "position", "v": "velocity", "w": "angular velocity", "r": "radius"}
"""Of what is told of bodies in short."""


def numbers_in(told, path=""):
    """All numbers with a point, each with what it is; bodies by their numbers."""
    if isinstance(told, dict):
        path = f"body {told['id']}:" if "id" in told else path
        for name, value in told.items():
            yield from numbers_in(value, f"{path} {WORDS.get(name, name)}")
    elif isinstance(told, list):
        for value in told:
            yield from numbers_in(value, path)
    elif isinstance(told, float):
        yield path.strip(), told


def refuse_what_is_not_finite(told):
    for what, number in numbers_in(told):
        if not math.isfinite(number):
            raise SystemExit(f"error: {what} is {number} at iteration {told['iteration']}, expected a finite number; is there one earlier?")


def export(out):
    scene = Export()
    for body in O.bodies:
        scene.add(body)
    for interaction in O.interactions:
        scene.add_interaction(interaction)
    told = {"iteration": int(O.iter), "time": float(O.time), "dt": float(O.dt), "periodic": bool(O.periodic)}
    told.update(engine_facts(), forces=permanent_forces(), **vars(scene))
    # YADE forgets that it was told to glue what touches once it has done so.
    if scene.glued > 0 and "setCohesionNow" not in told["functors"]:
        told["functors"].append("setCohesionNow")
    if told["stepper"]:
        O.step()  # it knows its step only then
        told["dt"] = float(O.dt)
    refuse_what_is_not_finite(told)
    with open(out, "w", encoding="utf-8") as file:
        json.dump(told, file, allow_nan=False)


def main():
    without_windows()
    with_any_locale()
    code = 0
    try:
        run_script()
        for at, out in stops:
            O.run(at - O.iter, True) if at is not None and at > O.iter else None
            export(out)
    except SystemExit as stop:
        print(stop)
        code = 1
    except BaseException as error:
        traceback.print_exc()
        print(f"error: {type(error).__name__}: {error}")
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)  # the ends of YADE's threads and of its interpreter get in each other's way


main()

"""A triad with a closed form as a package of its own has it, and what must work with it; run by the installed one."""

#: The module ``trammels``: a plate whose three pins slide along three guides that are known.
PACKAGE = '''
from linkwright.formula.trace import sqrt
from linkwright.formula.linear_algebra import Vec
from linkwright.groups.base import Solved
from linkwright.joints.pose import UNTURNED, Rotor
from linkwright.kinematics.groups import pair_of


class ThreeGuides:
    """Blocks p + s n on known guides, pinned to one plate whose pins are a1, a2, a3 in its axes.

    n_i x (p_1 + s_1 n_1 + R (a_i - a_1) - p_i) = 0 for i = 2, 3 is linear in s_1, cos and sin of the plate's angle;
    without s_1 it is A cos + B sin + G = 0, of whose two angles this is the one with the positive root.
    """

    signature = "RRR-PPP"
    words = ("", "")

    def fits(self, group):
        steps = group.unknowns
        return len(group.links) == 4 and len(steps) == 4 and sum(step.slides for step in steps) == 3 and (
            steps[-1].turns and all(cut.turns for cut in group.cuts))

    def place(self, tracer, group):
        *guides, turning = group.unknowns
        pins = {turning.parent: turning.joint} | {cut.other(turning.child): cut.joint for cut in group.cuts}
        plate = [tracer.dimensions.point(turning.child, pins[step.child]) for step in guides]
        starts, along = [], []
        for step in guides:
            pair, parent = pair_of(step, tracer.dimensions), tracer.poses[step.parent]
            block = pair.place(parent, 0.0)
            starts.append(block.point(tracer.dimensions.point(step.child, pins[step.child])))
            along.append(pair.normal(parent))
        first = guides.index(next(step for step in guides if step.child == turning.parent))
        order = [first, *(i for i in range(3) if i != first)]
        (p1, *p), (n1, *n), (a1, *a) = ([each[i] for i in order] for each in (starts, along, plate))
        rows = [(m.cross(n1), m.cross(b - a1), m.dot(b - a1), m.cross(p1 - q)) for m, b, q in zip(n, a, p)]
        (k2, *second), (k3, *third) = rows
        x, y, g = (k3 * s - k2 * t for s, t in zip(second, third))
        scale = x * x + y * y
        square = scale - g * g
        root = sqrt(square)
        turned = Vec((y * root - g * x) / scale, (-g * y - x * root) / scale)
        start = -(second[0] * turned.x + second[1] * turned.y + second[2]) / k2
        at = p1 + n1 * start
        slides = [n1.dot(at - p1), *(
            m.dot(at + turned.turn(b - a1) - q) for m, b, q in zip(n, a, p))]
        found = {order[i]: slide for i, slide in enumerate(slides)}
        return Solved((*(found[i] for i in range(3)), Rotor(turned, UNTURNED.local)), 1.0, square, scale, {})

    def explain(self, facts):
        return "the plate is too small for its three guides"
'''
#: Checks in a process in which the package is installed: against Newton's method, which knows no closed form.
PROGRAM = r'''
TRIAD = """
format: 1
name: trammel in a turning slot
frame: {points: {O: [0.05 m, 0.02 m], Q: [0 m, 0 m]}}
links:
  slot: {points: {O: [0 m, 0 m], E: [0.4 m, 0 m]}, mass: 1 kg, inertia: 0.01 kg·m²}
  plate: {points: {A: [0 m, 0 m], B: [0.3 m, 0 m], C: [0.1 m, 0.15 m]}, mass: 2 kg, inertia: 0.03 kg·m²}
  a: {points: [A], mass: 0.2 kg}
  b: {points: [B]}
  c: {points: [C]}
joints:
  level: {kind: prismatic, guide: frame, through: Q, direction: 0 deg, block: a, at: A}
  upright: {kind: prismatic, guide: frame, through: Q, direction: 80 deg, block: b, at: B}
  groove: {kind: prismatic, guide: slot, through: O, direction: 0 deg, block: c, at: C}
DRAWN
driver: {turn: slot, about: O, speed: 2 rad/s, start: 40 deg}
cycle: {from: 40 deg, to: 100 deg}
gravity: [0, -9.81 m/s²]
loads: {push: {kind: torque, on: plate, magnitude: 5 N·m}}
"""
from linkwright.groups.base import DYADS
from tests.worked_reading import against_solver, reckon_lines
machine = lw.loads(TRIAD.replace("DRAWN\n", ""))
motion = lw.solve_motion(machine, at=[np.radians(40)])
places = ", ".join(f"{p}: [{x!r} m, {y!r} m]" for p in "ABCE" for x, y in [motion.point(p).position[0].tolist()])
forces = lw.solve_forces(lw.solve_motion(machine, steps=24))
(group,) = [g for g in lw.structure(machine).groups if len(g.links) == 4]
assert (group.signature, group.assur_class) == ("RRR-PPP", 3), group
sweep = lw.sweep(machine, {"plate.C.y": np.array([0.14, 0.15, 0.16])}, outputs=[("input_torque", "max")], steps=24)
varied = ["plate.C.y", "frame.O.x", "plate.mass"]
problem = lw.objective(machine, "driver.effort rms", vary=varied, steps=24)
value, slope = problem(problem.start)
page = lw.worked(forces, 5)
assert "RRR-PPP" in page.text()
assert reckon_lines(page) == [] and against_solver(page, forces)[0] == []
assert "RRR-PPP" in lw.worked(forces, 5, language="zh").text()
open("triad.yaml", "w").write(dump(machine))
assert lw.load("triad.yaml").joints == machine.joints
assert main(["check", "triad.yaml"]) == 0 and main(["structure", "triad.yaml"]) == 0
assert main(["report", "triad.yaml", "--sections", "method", "worked", "--to", "html"]) == 0
too_small = TRIAD.replace("DRAWN\n", "").replace("C: [0.1 m, 0.15 m]", "C: [0.1 m, 0.01 m]").replace(
    "O: [0.05 m, 0.02 m]", "O: [0.6 m, 0.6 m]")
try:
    lw.solve_motion(lw.loads(too_small), steps=4)
    raise SystemExit("a plate that does not reach its guides was placed")
except lw.LinkwrightError as error:
    assert "too small for its three guides" in str(error), error
form = DYADS._elements.pop("three_guides")
# of other names, so that no program of the closed form that is kept is taken
followed = lw.loads(TRIAD.replace("DRAWN", "drawing: {" + places + "}").replace("slot", "arm"))
other = lw.solve_forces(lw.solve_motion(followed, steps=24))
assert other.motion.tracked is not None
for name in ("plate", "a", "c"):
    for each in ("direction", "angular_velocity", "angular_acceleration"):
        one, two = (getattr(f.motion.link(name), each) for f in (forces, other))
        assert np.abs(one - two).max() < 1e-9 * max(1.0, np.abs(two).max()), (name, each)
for joint, link in (("level", "a"), ("groove", "c"), ("B", "plate")):
    one, two = (f.reaction(joint, on=link) for f in (forces, other))
    assert np.abs(one - two).max() < 1e-8 * np.abs(two).max(), joint
assert np.abs(forces.input_torque - other.input_torque).max() < 1e-9 * np.abs(other.input_torque).max()
again = lw.sweep(followed, {"plate.C.y": np.array([0.14, 0.15, 0.16])}, outputs=[("input_torque", "max")], steps=24)
assert np.abs(sweep["input_torque", "max"] - again["input_torque", "max"]).max() < 1e-9
for name, x, own in zip(varied, problem.start, slope):
    h = 1e-5 * max(1.0, abs(x))
    near = lw.sweep(followed, {name: np.array([x - h, x, x + h])}, outputs=[("driver.effort", "rms")], steps=24)
    low, middle, high = near["driver.effort", "rms"]
    assert abs(middle - value) < 1e-9 * value and abs((high - low) / (2 * h) - own) < 1e-6 * np.abs(slope).max(), name
print("the triad too")
'''

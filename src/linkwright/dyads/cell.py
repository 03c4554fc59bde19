"""One group by itself as a traced program: outer joints as inputs, everything inside as outputs.

The group is cut out of a small mechanism in which its outer links, ``base_1`` and ``base_2``, are driven; here
their states are inputs of the program instead. Positions, rates and forces come from the solvers of mechanisms
(:class:`~linkwright.kinematics.groups.GroupTracer`, :class:`~linkwright.kinematics.trace.RateTracer`,
:func:`~linkwright.kinetostatics.trace.trace_forces`), so from the closed forms of :mod:`linkwright.groups`.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import cached_property, lru_cache

from linkwright.applied_loads.site import Wrench
from linkwright.files.model_file import loads
from linkwright.formula.linear_algebra import ZERO, Vec
from linkwright.formula.numpy_backend import NumpyProgram
from linkwright.formula.program import Program
from linkwright.formula.trace import Scalar, Trace, Value
from linkwright.groups.base import Dyad
from linkwright.joints.pose import FRAME_POSE, FRAME_STATE, UNTURNED, Pose, Rotor, State
from linkwright.kinematics.dimensions import Dimensions, DriverInput
from linkwright.kinematics.groups import GroupTracer, Placed, dyad_shape
from linkwright.kinematics.rotations import Angles
from linkwright.kinematics.trace import MotionOutputs, MotionTrace, RateTracer
from linkwright.kinetostatics.trace import ForceTrace, trace_forces
from linkwright.topology import structure

#: A link of a group; each may have a mass.
_LINK = "{{points: {points}, mass: 1 kg, inertia: 1 kg·m², mass_centre: [1 m, 1 m]}}"
#: An outer link: a point P or Q and what is in the frame.
_BASE = "{{points: {{{point}: [0 m, 0 m], F{number}: [1 m, 0 m]}}}}"
_ONE, _BAR = "{{{0}: [0 m, 0 m]}}", "{{{0}: [0 m, 0 m], B: [1 m, 0 m]}}"
_GUIDE = "{{kind: prismatic, guide: {0}, through: {1}, direction: {2} rad, block: {3}, at: {4}, offset: 1 m}}"
#: Points of the links and guides of each group, with the driver of one that has one; P and Q are the outer points,
#: B is the inner one.
_GROUPS: dict[str, tuple[tuple[str, ...], dict[str, str], str]] = {
    "bar": ((_BAR.format("P"),), {}, "{turn: first, about: P, speed: 1 rad/s}"),
    "slider": (
        (_ONE.format("B"),),
        {"outer_1": _GUIDE.format("base_1", "P", 0, "first", "B")},
        "{slide: outer_1, speed: 1 m/s}",
    ),
    "RRR": ((_BAR.format("P"), _BAR.format("Q")), {}, ""),
    "RRP": ((_BAR.format("P"), _ONE.format("B")), {"outer_2": _GUIDE.format("base_2", "Q", 0, "second", "B")}, ""),
    "RPR": (
        (_ONE.format("P"), "{Q: [0 m, 0 m], B: [0 m, -1 m]}"),
        {"inner": _GUIDE.format("first", "P", 0, "second", "B")},
        "",
    ),
    "PRP": (
        (_ONE.format("B"), _ONE.format("B")),
        {
            "outer_1": _GUIDE.format("base_1", "P", 0, "first", "B"),
            "outer_2": _GUIDE.format("base_2", "Q", 0, "second", "B"),
        },
        "",
    ),
    "RPP": (
        (_ONE.format("B"), _ONE.format("Q")),
        {
            "outer_1": _GUIDE.format("base_1", "P", 0, "first", "B"),
            "inner": _GUIDE.format("first", "B", 1, "second", "Q"),
        },
        "",
    ),
}
#: The joints of each group: names of the mechanism by those of the functions.
JOINTS = {
    "RRR": {"outer_1": "P", "inner": "B", "outer_2": "Q"},
    "RRP": {"outer_1": "P", "inner": "B", "outer_2": "outer_2"},
    "RPR": {"outer_1": "P", "inner": "inner", "outer_2": "Q"},
    "PRP": {"outer_1": "outer_1", "inner": "B", "outer_2": "outer_2"},
    "RPP": {"outer_1": "outer_1", "inner": "inner", "outer_2": "Q"},
    "bar": {"outer_1": "P"},
    "slider": {"outer_1": "outer_1"},
}


def _text(name: str) -> str:
    """The model file of the mechanism that a group is cut out of."""
    points, guides, driver = _GROUPS[name]
    links = {f"base_{n}": _BASE.format(point=p, number=n) for n, p in enumerate("PQ"[: len(points)], 1)}
    links |= {link: _LINK.format(points=each) for link, each in zip(("first", "second"), points, strict=False)}
    drivers = {f"drive_{n}": f"{{turn: base_{n}, about: F{n}, speed: 1 rad/s}}" for n in range(1, len(points) + 1)}
    drivers |= {"drive": driver} if driver else {}
    sections = {"links": links, "joints": guides, "drivers": drivers}
    lines = ["format: 1", f"name: {name}", "frame: {points: {F1: [0 m, 0 m], F2: [1 m, 0 m]}}"]
    for section, entries in sections.items():
        lines += [f"{section}:", *(f"  {key}: {value}" for key, value in entries.items())] if entries else []
    return "\n".join([*lines, "gravity: [1 m/s², 1 m/s²]", ""])


class _Positional(Trace):
    """A trace whose dimensions may differ from position to position."""

    def parameter(self, name: str) -> Value:
        return self.position(name)


class Cell:
    """The programs of one group; ``varying``: its dimensions that are inputs, by their addresses."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.mechanism = loads(_text(name))
        found = self.mechanism.dimensions()
        self.varying = tuple(key for key in found if _varies(key, found[key]))
        self.structure = structure(self.mechanism)
        self.group = next(group for group in self.structure.groups if "first" in group.links)

    @property
    def dyad(self) -> Dyad:
        """The closed form of the group."""
        found = dyad_shape(self.group)
        assert found is not None
        return found[0]

    @cached_property
    def placed(self) -> Placed:
        """The group in position, with its rates."""
        return self._traced[1]

    @cached_property
    def motion(self) -> MotionTrace:
        """Bases and links as traced values."""
        return self._traced[0]

    @cached_property
    def _traced(self) -> tuple[MotionTrace, Placed]:
        trace = _Positional()
        dimensions = Dimensions(self.mechanism, trace, frozenset(self.varying))
        drivers = {name: self._input(trace, name) for name in self.group.drivers}
        poses, states = {"frame": FRAME_POSE}, {"frame": FRAME_STATE}
        for base in ("base_1", "base_2"):
            if base in self.mechanism.links:
                states[base] = _base(trace, base, base in self._guiding)
                poses[base] = states[base].pose
        motion = MotionTrace(self.mechanism, self.structure, trace, dimensions, drivers, poses, states)
        motion.angles = Angles((), dimensions, poses)
        placer = GroupTracer(
            dimensions, drivers, poses, motion.angles, iterations=1, mode=lambda _: trace.position("mode")
        )
        placed = placer.place(self.group)
        RateTracer(dimensions, drivers, poses, states).move(placed)
        motion.placed[self.group.name] = placed
        return motion, placed

    @property
    def _guiding(self) -> set[str]:
        """The bases that carry guides."""
        return {joint.guide for joint in self.mechanism.guides.values()}

    def _input(self, trace: Trace, driver: str) -> DriverInput:
        rate, second = trace.position("rate"), trace.position("second")
        if self.mechanism.drivers[driver].joint in self.mechanism.guides:
            return DriverInput(None, trace.position("slide"), rate, second)
        return DriverInput(Vec(trace.position("cos"), trace.position("sin")), None, rate, second)

    # programs ---------------------------------------------------------------------------------
    @cached_property
    def kinematics(self) -> NumpyProgram:
        """States of the links, slides with their rates, whether the group is assembled, and why not."""
        return self._program(self._motion_outputs())

    @cached_property
    def kinetostatics(self) -> NumpyProgram:
        """Force of every joint on the first of its links in the group, couples, and the drivers' efforts."""
        extra = {"given": [self._wrench(link) for link in self.group.links]}
        found = trace_forces(self.motion, inertia=True, extra=extra, along_input=frozenset())
        return self._program(self._force_outputs(found))

    def _program(self, outputs: Mapping[str, Scalar | bool]) -> NumpyProgram:
        return NumpyProgram(Program.of(self.motion.trace, outputs))

    def _motion_outputs(self) -> dict[str, Scalar | bool]:
        found: dict[str, Scalar | bool] = {}
        for link in self.group.links:
            state = self.motion.states[link]
            for rate, v in zip(("", "v", "a"), self.motion.point(link, ZERO), strict=True):
                found |= {f"{link}.{rate}x": v.x, f"{link}.{rate}y": v.y}
            ahead = state.pose.direction
            found |= {f"{link}.cos": ahead.x, f"{link}.sin": ahead.y}
            found |= {f"{link}.omega": state.omega, f"{link}.alpha": state.alpha}
        outputs = MotionOutputs(self.motion)
        for joint in self.mechanism.guides:
            found |= zip((f"{joint}.s", f"{joint}.vs", f"{joint}.as"), outputs.slide(joint), strict=True)
        found |= {"valid": self.placed.valid, "reached": self.placed.reached}
        return found | {f"why:{name}": value for name, value in self.placed.facts.items()}

    def _wrench(self, link: str) -> Wrench:
        trace = self.motion.trace
        force = Vec(trace.position(f"{link}.fx"), trace.position(f"{link}.fy"))
        origin = self.motion.point(link, ZERO)[0]
        return Wrench(link, force, origin, trace.position(f"{link}.moment"))

    def _force_outputs(self, forces: ForceTrace) -> dict[str, Scalar | bool]:
        found: dict[str, Scalar | bool] = {}
        for name, joint in JOINTS[self.name].items():
            on = "second" if name == "outer_2" else "first"
            force = forces.reaction(joint, on)
            found |= {f"{name}.fx": force.x, f"{name}.fy": force.y, f"{name}.couple": forces.couple(joint, on)}
        return found | {"effort" if len(forces.efforts) == 1 else name: each for name, each in forces.efforts.items()}


def _base(trace: Trace, base: str, guiding: bool) -> State:
    """An outer link: a point with its rates, and of a guide its direction with the rates of that."""
    place, velocity, acceleration = (
        Vec(trace.position(f"{base}.{rate}x"), trace.position(f"{base}.{rate}y")) for rate in ("", "v", "a")
    )
    if not guiding:
        return State(Pose(ZERO, place, UNTURNED), velocity, 0.0, acceleration, 0.0)
    cosine, sine, omega, alpha = (trace.position(f"{base}.{name}") for name in ("cos", "sin", "omega", "alpha"))
    rotor = Rotor(Vec(cosine, sine), Vec(1.0, 0.0))
    return State(Pose(ZERO, place, rotor), velocity, omega, acceleration, alpha)


def _varies(address: str, value: float) -> bool:
    """Whether a dimension is an input: those that are not zero, of the links and joints of the group."""
    return value != 0.0 and address.split(".", maxsplit=1)[0] in (
        "first",
        "second",
        "outer_1",
        "inner",
        "outer_2",
        "gravity",
    )


@lru_cache
def cell(name: str) -> Cell:
    """The programs of a group, made once."""
    return Cell(name)

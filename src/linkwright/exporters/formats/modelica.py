"""Modelica models without libraries: as conditions of the joints, or as differential equations.

Every joint's condition g(q) = 0 enters as ġ = -g/T: linear in the velocities, so that a tool integrates from the
starting position and cannot change to another way of putting the mechanism together.
"""

from __future__ import annotations

from linkwright.errors import RequestError
from linkwright.exporters.export import FORMATS, Format
from linkwright.exporters.modelica_equations import Equations, Text, identifier, indented, law_text, number, quoted
from linkwright.exporters.results import Results, seconds
from linkwright.joints.base import Joint
from linkwright.joints.lower_pair import RigidJoint, SlidingJoint
from linkwright.words import _

INTERVALS = 360
FORMS = ("positions", "rates")
#: Relaxation times in a cycle, for equations of rates.
RELAXATIONS = 60


def modelica_content(
    results: Results, *, name: str | None = None, form: str = "rates", accelerations: bool = True
) -> bytes:
    """A model without libraries: unknowns are the place and angle of every link, of pins and points.

    Each pin says that its links meet there, each guide that its block lies on its line; drivers are laws of time, so
    that as many equations as unknowns are left and the motion follows. Starting values are those of the first
    position that was reached: they choose the way the mechanism is put together. Dimensions are parameters.
    Masses and loads are not part of the model.

    ``form="rates"``: the joints' conditions between velocities, places and angles integrated from the start.
    ``form="positions"``: the conditions themselves, to be solved at every time; more exact, with ``accelerations``
    of links and blocks, but a tool may change to another way of putting the mechanism together. ``name``: of the
    model (default: Linkwright_ and the mechanism's name).
    """
    motion, mechanism = results.motion, results.mechanism
    index = results.first_ok()
    if form not in FORMS:
        raise RequestError(
            _('the equations are of "positions" or of "rates", not of "{form}"', code="export.bad_form", form=form)
        )
    if form == "rates":
        text = Rates(results, index, seconds(motion) / RELAXATIONS).write()
    else:
        text = Equations(results, index, accelerations=accelerations).write()
    title = name or f"Linkwright_{identifier(mechanism.name)}"
    begin = float(motion.time[index])
    end, step = begin + seconds(motion), seconds(motion) / INTERVALS
    experiment = f"StartTime={number(begin)}, StopTime={number(end)}, Interval={number(step)}, Tolerance=1e-9"
    lines = [
        f"model {title} {quoted(mechanism.name)}",
        *indented(text.parameters),
        *indented(text.unknowns),
        "equation",
        *indented(text.equations),
        f"  annotation(experiment({experiment}));",
        f"end {title};",
        "",
    ]
    return "\n".join(lines).encode()


FORMATS.register("modelica")(Format((".mo",), modelica_content))


Pair = tuple[str, str]


class Rates:
    """Writes the model; ``relaxation`` is T, s."""

    def __init__(self, results: Results, index: int, relaxation: float) -> None:
        self.model = Equations(results, index, accelerations=False)
        self.mechanism, self.motion, self.index = results.mechanism, results.motion, index
        self.redundant = results.structure.redundant
        self.model.parameter("relaxation", "s", relaxation, "time in which errors of the joints fade")

    def write(self) -> Text:
        """All lines."""
        for name in self.mechanism.links:
            self._link(name)
        for name in self.model.pins:
            self._pin(name)
        for name in self.mechanism.links:
            self.model.plain_points(name)
        for guide in self.mechanism.guides.values():
            self._guide(guide)
        for weld in self.mechanism.welds.values():
            self._weld(weld)
        for joint in self.mechanism.joints.values():
            if joint.higher and joint.name not in self.redundant:
                self._rolling(joint)
        for name in self.mechanism.drivers:
            self._driver(name)
        return self.model.text

    def _link(self, name: str) -> None:
        me = self.model.links[name]
        x, y = self.model.placed[name].origin[self.index]
        angle = self.motion.link(name).angle[self.index]
        states = (("x", "m", x, "vx", "m/s"), ("y", "m", y, "vy", "m/s"), ("phi", "rad", angle, "w", "rad/s"))
        for state, unit, start, rate, rate_unit in states:
            meaning = quoted(f"{state} of link {name}")
            self.model.text.unknowns += [
                f'Real {me}_{state}(unit="{unit}", start={number(start)}, fixed=true) {meaning};',
                f'Real {me}_{rate}(unit="{rate_unit}") {quoted(f"rate of {me}_{state}")};',
            ]
            self.model.text.equations.append(f"der({me}_{state}) = {me}_{rate};")

    def _condition(self, rate: str, gap: str) -> None:
        self.model.text.equations.append(f"{rate} = -({gap})/relaxation;")

    def _velocity(self, link: str, point: str) -> Pair:
        if link == "frame":
            return "0.0", "0.0"
        (x, y), me = self.model.world(link, point), self.model.links[link]
        return f"({me}_vx - {me}_w*({y} - {me}_y))", f"({me}_vy + {me}_w*({x} - {me}_x))"

    def _spin(self, link: str) -> str:
        return "0.0" if link == "frame" else f"{self.model.links[link]}_w"

    def _pin(self, name: str) -> None:
        links = sorted(self.model.pins[name].links, key=lambda link: link != "frame")
        me = self.model.names.of("pin", name)
        self.model.point(me, name, f"pin {name}")
        places = self.model.world(links[0], name)
        self.model.text.equations += [f"{me}_x = {places[0]};", f"{me}_y = {places[1]};"]
        base = self._velocity(links[0], name)
        for link in links[1:]:
            here, speed = self.model.world(link, name), self._velocity(link, name)
            for axis, place, rate, first in zip("xy", here, speed, base, strict=True):
                self._condition(f"{rate} - {first}", f"{place} - {me}_{axis}")

    def _guide(self, joint: SlidingJoint) -> None:
        me = self.model.names.of("guide", joint.name)
        angle = joint.direction
        turn = self.model.parameter(f"{me}_direction", "rad", angle, f"direction of {joint.name}")
        offset = self.model.parameter(f"{me}_offset", "m", joint.offset, "normal distance, left positive")
        slide = self.motion.joint(joint.name)
        self.model.unknown(f"{me}_s", "m", slide.displacement[self.index], f"displacement of {joint.name}")
        self.model.text.unknowns.append(f'Real {me}_s_w(unit="m/s") {quoted(f"velocity of {joint.name}")};')
        (bx, by), (gx, gy) = (self.model.world(joint.block, joint.at), self.model.world(joint.guide, joint.through))
        (bu, bv), (gu, gv) = self._velocity(joint.block, joint.at), self._velocity(joint.guide, joint.through)
        along = f"({self.model.angle(joint.guide)} + {turn})"
        c, s, w = f"cos{along}", f"sin{along}", self._spin(joint.guide)
        dx, dy, du, dv = f"({bx} - ({gx}))", f"({by} - ({gy}))", f"({bu} - {gu})", f"({bv} - {gv})"
        across = f"{dy}*{c} - {dx}*{s}"
        self.model.text.equations += [
            f"{me}_s = {dx}*{c} + {dy}*{s};",
            f"{me}_s_w = {du}*{c} + {dv}*{s} + {w}*({across});",
        ]
        self._condition(f"{dv}*{c} - {du}*{s} - {w}*{me}_s", f"{across} - {offset}")
        if joint.name not in self.redundant:
            self._turning(joint.block, joint.guide)

    def _turning(self, link: str, base: str) -> None:
        """The angle between two links stays as it is."""
        gap = self.motion.link(link).angle[self.index] - self.motion.link(base).angle[self.index]
        turned = f"{self.model.angle(link)} - {self.model.angle(base)} - ({number(gap)})"
        self._condition(f"{self._spin(link)} - {self._spin(base)}", turned)

    def _rolling(self, joint: Joint) -> None:
        rotations, slides, _ = joint.sums(self.mechanism)
        terms = [(factor, self._spin(link)) for link, factor in rotations.items()]
        terms += [(factor, f"{self.model.names.of('guide', name)}_s_w") for name, factor in slides.items()]
        rate = " + ".join(f"({number(factor)})*{name}" for factor, name in terms)
        self._condition(rate, self.model.rolled(joint))

    def _weld(self, joint: RigidJoint) -> None:
        a, b = joint.links
        here, there = self.model.world(a, joint.at), self.model.world(b, joint.at)
        for p, q, u, v in zip(here, there, self._velocity(a, joint.at), self._velocity(b, joint.at), strict=True):
            self._condition(f"{v} - {u}", f"{q} - ({p})")
        self._turning(b, a)

    def _driver(self, name: str) -> None:
        driver = self.mechanism.drivers[name]
        rotary = self.motion.positions.rotary[name]
        me, start = self.model.names.of("driver", name), float(self.motion.inputs[name][self.index])
        self.model.unknown(f"{me}_q", "rad" if rotary else "m", start, f"coordinate of the driver {name}")
        rate = quoted(f"rate of the driver {name}")
        self.model.text.unknowns.append(f'Real {me}_q_w(unit="{"rad/s" if rotary else "m/s"}") {rate};')
        law = law_text(driver.law, float(self.motion.time.min()), float(self.motion.time.max()))
        self.model.text.equations += [f"{me}_q = {law};", f"{me}_q_w = der({me}_q);"]
        if not rotary:
            slide = self.model.names.of("guide", driver.joint)
            self._condition(f"{slide}_s_w - {me}_q_w", f"{slide}_s - {me}_q")
            return
        link, base = driver.link, driver.relative_to
        gap = self.motion.link(link).angle[self.index] - self.motion.link(base).angle[self.index] - start
        turned = f"{self.model.angle(link)} - {self.model.angle(base)} - {me}_q - ({number(gap)})"
        self._condition(f"{self._spin(link)} - {self._spin(base)} - {me}_q_w", turned)

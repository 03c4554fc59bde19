"""A Python program that solves one machine with the functions of this package, group by group, as a text."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import cached_property

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import POINT, SLIDE, Output
from linkwright.dyads.listed_forces import CROSS, ForceLines
from linkwright.dyads.plan import Pin, Step
from linkwright.dyads.script import WIDE, ZERO, Script, angle, call, column, number, pair, quoted, series
from linkwright.words import _
from linkwright.words.message import in_language

_TITLES = {
    "bar": _("driven link {links}"),
    "slider": _("driven block {links}"),
    "weld": _("{links}, fixed to a link solved before"),
    "other": _("{signature} group: {links}; solved by the library, since {reason}"),
}
_DYAD = _("{signature} dyad: {links}")


class Listing(Script):
    """The program; ``rows``: the positions of the motion that it solves, in order; ``source``: the model file, which
    it reads where the machine has groups that no function solves."""

    @cached_property
    def reactions(self) -> ForceLines:
        """The calls of the forces."""
        return ForceLines(self)

    def text(self) -> str:
        """The complete program."""
        self._data()
        for step in self.plan.steps:
            self._step(step)
        self.reactions.write()
        self._table()
        return "\n".join([*self._head(), *self.lines]).rstrip() + "\n"

    # parts ------------------------------------------------------------------------------------
    def _head(self) -> Iterator[str]:
        """Title and imports; what the lines below do not use is not imported."""
        name = " ".join(self.mechanism.name.split())
        units = _(
            "Units: m, kg, s, N, rad; counter-clockwise positive. Points of links: along their line, left of it."
        )
        yield "# " + self.translate(_("{name}: solved group by group with linkwright.dyads", name=name))
        yield f"# {self.translate(units)}"
        yield from ("import numpy as np", "")
        if self.plan.others:
            yield "import linkwright as lw"
        yield "from linkwright import dyads"
        used = [name for name in ("Body", "Line", "Load") if any(f"{name}(" in line for line in self.lines)]
        if used:
            yield f"from linkwright.dyads import {', '.join(used)}"
        if any("cross(" in line for line in self.lines):
            yield from CROSS

    def _data(self) -> None:
        self.write("", "# " + self.translate(_("given")))
        for point in self.mechanism.frame.points:
            if any(self._touches(step, point) for step in self.plan.steps):
                name = self.names.of("point", point)
                self.placed[self.key("frame", point)] = name
                self.write(f"{name} = {pair(self.plan.local('frame', point))}")
        for driver in self.mechanism.drivers:
            name, (q, rate, second) = self.names.of("driver", driver), self._coordinates(driver)
            turns = self.motion.positions.rotary[driver]
            self.write(f"{name} = {series(q, degrees=turns)}")
            for rates, word in ((rate, "speed"), (second, "acceleration")):
                if np.abs(rates).max(initial=0.0) > 0.0:
                    self.write(f"{self.names.of('driver', f'{driver}_{word}')} = {series(rates)}")
        if self.reactions.possible and any(self.mechanism.gravity):
            self.write(f"G = {pair(complex(*self.mechanism.gravity))}")

    def _touches(self, step: Step, point: str) -> bool:
        return any(isinstance(each, Pin) and each.link == "frame" and each.joint == point for each in step.outer)

    def _coordinates(self, driver: str) -> tuple[Floats, Floats, Floats]:
        return tuple(row[self.rows] for row in self.motion.positions.coordinates[driver])  # type: ignore[return-value]

    def _step(self, step: Step) -> None:
        links = " ".join(", ".join(step.group.links).split())
        form = _TITLES.get(step.kind.lower() or "other", _DYAD)
        reason = in_language(step.reason, self.language)
        title = self.translate(form.format(links=links, signature=step.group.signature, reason=reason))
        self.write("", f"# {step.number}  {title}")
        {"bar": self._bar, "slider": self._slider, "weld": self._weld, "": self._other}.get(step.kind, self._dyad)(
            step
        )
        for link in step.group.links:
            self._points(link)

    def _bar(self, step: Step) -> None:
        driver = step.group.tree[0].driver or ""
        pin = step.outer[0]
        turn, *rates = self._driven(driver, step.sign)
        if pin.link != "frame":
            carrier, axes = self.names.of("link", pin.link), self.plan.axes[pin.link]
            added = f"- {turn[1:]}" if turn.startswith("-") else f"+ {turn}"
            lean = f" - {angle(axes.lean)}" if abs(axes.lean) > ZERO else ""
            turn = f"{carrier}.angle{lean} {added}"
            rates = [f"{carrier}.angular_velocity + {rates[0]}", f"{carrier}.angular_acceleration + {rates[1]}"]
        elif rates[1] == "0":
            rates = rates[:1]
        self.write(*call(self.names.of("link", step.links[0]), "bar", [self.outer(pin), turn, *rates]))

    def _slider(self, step: Step) -> None:
        driver = step.group.tree[0].driver or ""
        (slid,), guide = step.slides, step.outer[0]
        place, *rates = self._driven(driver, slid.sign)
        arguments = [self.outer(guide), place, *rates]
        if step.offsets[0]:
            arguments.append(f"offset={number(step.offsets[0])}")
        self.write(*call(self.names.of("link", step.links[0]), "slider", arguments))

    def _driven(self, driver: str, sign: float) -> list[str]:
        """A driver's coordinate and its rates, 0 for those that are."""
        found = [self.names.of("driver", driver)]
        for word, row in zip(("speed", "acceleration"), self._coordinates(driver)[1:], strict=True):
            moving = np.abs(row).max(initial=0.0) > 0.0
            found.append(self.names.of("driver", f"{driver}_{word}") if moving else "0")
        return found if sign > 0 else [f"-{each}" if each != "0" else each for each in found]

    def _weld(self, step: Step) -> None:
        pin, name = step.outer[0], self.names.of("link", step.links[0])
        axes = self.plan.axes[pin.link]
        place = axes.along(pin.local)
        turn = step.angle - axes.lean
        if pin.link == "frame":
            self.write(f"{name} = Line({pair(place)}, {angle(turn)})")
            return
        carrier = self.names.of("link", pin.link)
        self.write(f"{name} = {carrier}.line({number(place.real)}, {number(place.imag)}, {angle(turn)})")

    def _dyad(self, step: Step) -> None:
        name = self.names.of("dyad", f"{step.kind.lower()}_{step.number}")
        a, b = (self.outer(each) for each in step.outer)
        arguments = [b, a, angle(step.angle)] if step.kind == "RPP" else [a, b]
        if step.kind == "RRR":
            arguments.append(f"({number(step.lengths[0])}, {number(step.lengths[1])})")
        elif step.kind == "RRP":
            arguments += [number(step.lengths[0]), *([number(step.offsets[0])] if step.offsets[0] else [])]
        elif any(abs(each) > 0.0 for each in step.offsets):
            arguments.append(f"({number(step.offsets[0])}, {number(step.offsets[1])})")
        if step.mode:
            arguments.append(f'mode="{step.mode}"')
        self.write(*call(name, step.kind.lower(), arguments))
        one, two = (self.names.of("link", link) for link in step.links)
        self.write(f"{one}, {two} = {name}.first, {name}.second")
        if step.kind in ("RRR", "RRP", "PRP"):
            key = self.key(step.links[0], step.inner)
            if key not in self.placed:
                self.placed[key] = self.names.of("point", key)
                self.write(f"{self.placed[key]} = {name}.inner")

    def _other(self, step: Step) -> None:
        """A group that no function solves: its links from the solved motion of the library."""
        if step == self.plan.others[0]:
            model = self.source or "machine.yaml"
            self.write(f"motion = lw.solve_motion(lw.load({quoted(model)}), {self._positions()})")
        for link in step.group.links:
            name, first = self.names.of("link", link), next(iter(self.mechanism.links[link].points))
            self.write(
                f"turning = motion.link({quoted(link)})",
                f"{name} = Line(motion.point({quoted(f'{link}.{first}')}), turning.angle, turning.angular_velocity, "
                "turning.angular_acceleration)",
            )

    def _positions(self) -> str:
        """The same positions, as ``solve_motion`` takes them."""
        drivers = list(self.mechanism.drivers)
        if len(drivers) == 1 and self.mechanism.steady:
            return f"at={self.names.of('driver', drivers[0])}"
        return f"times={series(self.motion.time[self.rows])}"

    def _points(self, link: str) -> None:
        """Points of a link that are printed or that later groups hang on."""
        wanted = set(self.motion.point_names())
        for point in self.mechanism.links[link].points:
            key = self.key(link, point)
            if key in wanted and key not in self.placed:
                place = self.plan.axes[link].along(self.plan.local(link, point))
                self.placed[key] = self.names.of("point", key)
                self.write(f"{self.placed[key]} = {self.at(link, place)}")

    # the table --------------------------------------------------------------------------------
    def _table(self) -> None:
        self.write(
            "",
            "# " + self.translate(_("table: the columns of `linkwright export`; angles within half a turn")),
            "table = {}",
        )
        for driver in self.mechanism.drivers:
            head = Output("input", driver, slides=not self.motion.positions.rotary[driver]).heading
            self.write(f"table[{quoted(head)}] = {self.names.of('driver', driver)}")
        self._link_columns()
        self._slide_columns()
        self._point_columns()
        self.reactions.columns()
        self.write(
            'print(",".join(table))',
            "for row in zip(*np.broadcast_arrays(*map(np.atleast_1d, table.values()))):",
            '    print(",".join(f"{value:.12g}" for value in row))',
        )

    def _link_columns(self) -> None:
        links = [
            f"({quoted(link)}, {self.names.of('link', link)}, {angle(self.plan.axes[link].lean)})"
            for link in self.mechanism.links
            if link in self.plan.axes
        ]
        heads = [Output(kind, "{label}").heading for kind in ("angle", "angular_velocity", "angular_acceleration")]
        self.write(
            *wrapped("for label, axis, lean in", links, ":"),
            f'    table[f"{heads[0]}"] = np.angle(np.exp(1j * (axis.angle - lean)))',
            f'    table[f"{heads[1]}"] = axis.angular_velocity',
            f'    table[f"{heads[2]}"] = axis.angular_acceleration',
        )

    def _slide_columns(self) -> None:
        heads = [Output(kind, "{label}").heading for kind in SLIDE]
        parts = ("displacement", "velocity", "acceleration")
        listed = [self._slide(step, i) for step in self.plan.steps for i in range(len(step.slides))]
        listed += [
            f"({quoted(joint)}, motion.joint({quoted(joint)}), 1, 0)"
            for step in self.plan.others
            for joint in dict.fromkeys(each.joint for each in step.group.joints)
            if joint in self.mechanism.guides
        ]
        if listed:
            self.write(
                *wrapped("for label, moved, sign, shift in", listed, ":"),
                f'    table[f"{heads[0]}"] = sign * moved.{parts[0]} + shift',
                *(
                    f'    table[f"{head}"] = sign * moved.{part}'
                    for head, part in zip(heads[1:], parts[1:], strict=True)
                ),
            )

    def _slide(self, step: Step, i: int) -> str:
        """A slide with the sign and the shift that give the displacement which the file means."""
        slid = step.slides[i]
        if step.kind == "slider":
            values = self._driven(step.group.tree[0].driver or "", 1.0)
            return f"({quoted(slid.joint)}, dyads.Slide({', '.join(values)}), 1, 0)"
        name = self.names.of("dyad", f"{step.kind.lower()}_{step.number}")
        return f"({quoted(slid.joint)}, {name}.slides[{i}], {slid.sign:.0f}, {number(slid.shift)})"

    def _point_columns(self) -> None:
        wanted = [key for key in self.motion.point_names() if key in self.placed]
        if not wanted:
            return
        points = [f"({quoted(key)}, {self.placed[key]})" for key in wanted]
        self.write(*wrapped("for label, place in", points, ":"), '    for i, part in enumerate("xy"):')
        for kind in POINT:
            head = Output(kind, "{label}", "{part}").heading
            self.write(f'        table[f"{head}"] = place.{kind}[..., i]')


def wrapped(before: str, items: Sequence[str], after: str = "") -> Iterable[str]:
    """A line with a list, whose items have lines of their own where it is long."""
    line = f"{before} [{', '.join(items)}]{after}"
    return [line] if len(line) <= WIDE else [f"{before} [", *column(items), f"]{after}"]

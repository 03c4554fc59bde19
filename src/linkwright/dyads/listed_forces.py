"""The part of a listing that finds the joint forces, from the last group to the first."""

from __future__ import annotations

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.core.outputs import Output
from linkwright.dyads.plan import Guide, Step
from linkwright.dyads.script import Script, call, number, pair, quoted, series
from linkwright.elements import Connection
from linkwright.kinetostatics.link_balance import applied_rows
from linkwright.mechanism.link import centre
from linkwright.words import _

#: Share of the largest load below which another is rounding.
FADED = 1e-12
#: The cross product, for couples about another point.
CROSS = ("", "", "def cross(a, b):", "    return a[..., 0] * b[..., 1] - a[..., 1] * b[..., 0]", "")


class ForceLines:
    """Writes the calls of the forces into a listing, and their columns."""

    def __init__(self, listing: Script) -> None:
        self.listing = listing
        self.mechanism, self.forces = listing.mechanism, listing.forces
        #: What later groups exert on a link, as loads.
        self.on: dict[str, list[str]] = {}
        #: Forces and couples on a link at a joint, as terms of a sum.
        self.reactions: dict[tuple[str, str], list[str]] = {}
        self.couples: dict[tuple[str, str], str] = {}
        self.efforts: dict[str, str] = {}

    @property
    def possible(self) -> bool:
        """Whether the functions find the forces of every link."""
        if self.forces is None or self.forces.static:
            return False
        return all(self._alone(each) for step in self.listing.plan.others for each in step.group.joints)

    def _alone(self, connection: Connection) -> bool:
        """Whether the force on each moving link at a joint is that of this connection alone."""
        others = [
            each
            for step in self.listing.plan.steps
            for each in step.group.joints
            if each != connection and each.joint == connection.joint
        ]
        mine = {connection.a, connection.b} - {"frame"}
        return not any(mine & {each.a, each.b} for each in others)

    def write(self) -> None:
        """The calls, or why there are none."""
        if self.forces is None:
            return
        translate, write = self.listing.translate, self.listing.write
        if not self.possible:
            sentence = _("joint forces: not all groups have a function for them; lw.solve_forces(mechanism) has them")
            write("", f"# {translate(sentence)}")
            return
        write("", "# " + translate(_("joint forces, from the last group to the first")))
        if self.listing.plan.others:
            write("library = lw.solve_forces(motion)")
        for step in reversed(self.listing.plan.steps):
            if step.kind:
                self._step(step)
            else:
                self._other(step)

    # calls ------------------------------------------------------------------------------------
    def _step(self, step: Step) -> None:
        names = self.listing.names
        found = names.of("forces", f"forces_{step.number}")
        bodies = [self._body(link) for link in step.links]
        function = "forces"
        subject = names.of("dyad", f"{step.kind.lower()}_{step.number}")
        if step.kind in ("bar", "slider", "weld"):
            function = "slider_forces" if step.kind == "slider" else "bar_forces"
            subject = names.of("link", step.links[0])
        while len(bodies) > 1 and bodies[-1] == "None":
            bodies.pop()
        arguments = [] if bodies == ["None"] else bodies
        if any(self.mechanism.gravity) and any(self.mechanism.links[link].mass for link in step.links):
            arguments.append("gravity=G")
        self.listing.write(*call(found, function, [subject, *arguments]))
        for i, outer in enumerate(step.outer):
            self._outer(step, found, i, outer)
        if step.inner:
            self._inner(step, found)
        if step.kind in ("bar", "slider"):
            driver = step.group.tree[0].driver or ""
            sign = step.sign if step.kind == "bar" else step.slides[0].sign
            self.efforts[driver] = f"{'' if sign > 0 else '-'}{found}.effort"

    def _other(self, step: Step) -> None:
        """A group that no function solves: the library's forces, on the links that it hangs on."""
        for driver in step.group.drivers:
            self.efforts[driver] = f"library.driver_effort({quoted(driver)})"
        for connection in step.group.joints:
            joint = self.mechanism.joints[connection.joint]
            for link in (connection.a, connection.b):
                force = f"library.reaction({quoted(joint.name)}, on={quoted(link)})"
                self._note(joint.name, link, force)
                couple = f"library.couple({quoted(joint.name)}, on={quoted(link)})" if joint.couples else ""
                if couple and link != "frame":
                    self.couples[joint.name, link] = couple
                if link in step.group.links or link == "frame":
                    continue
                at = f"motion.reaction_place({quoted(joint.name)})"
                if joint.coordinate == "turn":
                    at = self.listing.point(link, joint.name)
                self.on.setdefault(link, []).append(f"Load({force}, {at}{', ' if couple else ''}{couple})")

    def _outer(self, step: Step, found: str, i: int, outer: object) -> None:
        """Notes what an outer joint exerts, and on the known link its opposite."""
        link, joint, known = step.links[i], step.outer[i].joint, step.outer[i].link
        force, couple = f'{found}.reaction("outer_{i + 1}")', f'{found}.couple("outer_{i + 1}")'
        self._note(joint, link, force)
        self._note(joint, known, f"-{force}")
        name = self.listing.names.of("link", link)
        own = isinstance(outer, Guide) or step.kind == "weld"
        place = f"{name}.origin" if own else self.listing.point(known, joint)
        total = force
        if step.kind == "slider":
            along = f"np.stack([np.cos({name}.angle), np.sin({name}.angle)], axis=-1)"
            total = f"({force} + {found}.effort[..., None] * {along})"
        if step.kind == "weld":  # what would drive a bar there holds the link
            self.couples |= {(joint, link): f"{found}.effort", (joint, known): f"-{found}.effort"}
        if isinstance(outer, Guide):
            self._couple(joint, link, couple, f"{name}.origin", total, self.listing.plan.axes[link].origin)
        if known == "frame":
            return
        held = f"{found}.effort" if step.kind in ("bar", "weld") else couple if isinstance(outer, Guide) else ""
        more = f", -{held}" if held else ""
        self.on.setdefault(known, []).append(f"Load(-{total}, {place}{more})")

    def _inner(self, step: Step, found: str) -> None:
        one, two = step.links
        force = f'{found}.reaction("inner")'
        self._note(step.inner, one, force)
        self._note(step.inner, two, f"-{force}")
        if step.inner in self.mechanism.guides:
            dyad = self.listing.names.of("dyad", f"{step.kind.lower()}_{step.number}")
            self._couple(step.inner, one, f'{found}.couple("inner")', f"{dyad}.inner", force, None)

    def _note(self, joint: str, link: str, force: str) -> None:
        if link != "frame":
            self.reactions.setdefault((joint, link), []).append(force)

    def _couple(self, joint: str, link: str, couple: str, about: str, force: str, origin: complex | None) -> None:
        """A couple about the block's point, as results give it, from that about another point."""
        guide = self.mechanism.guides[joint]
        place = self.listing.plan.local(guide.block, guide.at)
        if origin is None or guide.block != link or abs(place - origin) > 0.0:
            at = self.listing.point(guide.block, guide.at)
            resting = guide.block == "frame" or "frame" in self.mechanism.pin_links(guide.at)
            at = at if resting else f"{at}.position"
            name = self.listing.names.of("couple", f"couple_{joint}")
            self.listing.write(
                f"{name} = {couple} + cross(", f"    np.subtract({about}.position, {at}), {force}", ")"
            )
            couple = name
        self.couples[joint, link] = couple
        other = guide.guide if guide.block == link else guide.block
        if other != "frame":
            self.couples[joint, other] = f"-{couple}"

    # what a link weighs and carries --------------------------------------------------------------
    def _body(self, link: str) -> str:
        part = self.mechanism.links[link]
        loads = [*self._applied(link), *self.on.get(link, [])]
        arguments = []
        if part.mass or part.inertia:
            arguments = [number(part.mass), number(part.inertia)]
            place = complex(*centre(part, part.points, self.mechanism.dimension))
            along = self.listing.plan.axes[link].along(place)
            if part.mass and pair(along) != "(0, 0)":
                arguments.append(pair(along))
        if loads:
            arguments.append(f"loads=[{', '.join(loads)}]")
        return f"Body({', '.join(arguments)})" if arguments else "None"

    def _applied(self, link: str) -> list[str]:
        """Loads of the model and friction on a link: a force at its point where there is one, else all of them
        together about the frame's origin."""
        assert self.forces is not None
        fx, fy, moment = (row[self.listing.rows] for row in self.forces.fetch(applied_rows(link)))
        size = max(float(np.abs(row).max(initial=0.0)) for row in (fx, fy, moment))
        if size == 0.0:
            return []
        force = self._vector(link, fx, fy, size)
        acting = [each for each in self.mechanism.loads.values() if each.acts_on == link]
        points = acting[0].named_points if len(acting) == 1 else ()
        if points and self._through(link, points[0].point, fx, fy, moment):
            return [f"Load({force}, {self.listing.point(link, points[0].point)})"]
        couple = self._named(f"{link}_couple", series(np.where(np.abs(moment) > FADED * size, moment, 0.0)))
        if force == "(0, 0)":
            return [f"Load(couple={couple})"]
        return [f"Load({force}, (0, 0), {couple})"]

    def _named(self, name: str, text: str) -> str:
        """Numbers of all positions as a name, written before the call; a number as it is."""
        if "np" not in text:
            return text
        own = self.listing.names.of("load", name)
        self.listing.write(f"{own} = {text}")
        return own

    def _through(self, link: str, point: str, fx: Floats, fy: Floats, moment: Floats) -> bool:
        """Whether the moment is that of the force at a point."""
        x, y = self.listing.motion.point(f"{link}.{point}").position[self.listing.rows].T
        gap = np.abs(x * fy - y * fx - moment).max(initial=0.0)
        return bool(gap <= 1e-9 * max(float(np.abs(moment).max(initial=0.0)), 1e-300))

    def _vector(self, link: str, fx: Floats, fy: Floats, size: float) -> str:
        """A force: its two components, or where they vary the name of an array that is written before the call."""
        parts = [series(np.where(np.abs(row) > FADED * size, row, 0.0)) for row in (fx, fy)]
        if all("np" not in each for each in parts):
            return f"({parts[0]}, {parts[1]})"
        own = self.listing.names.of("load", f"{link}_force")
        text = self.listing.translate(
            _("loads of the model and friction on {link}, by positions", link=" ".join(link.split()))
        )
        self.listing.write(f"# {text}", f"{own} = np.zeros(({len(self.listing.rows)}, 2))")
        self.listing.write(*(f"{own}[:, {i}] = {part}" for i, part in enumerate(parts) if part != "0"))
        return own

    # columns ------------------------------------------------------------------------------------
    def columns(self) -> None:
        """Efforts, joint forces on every link, couples."""
        if not self.possible:
            return
        write = self.listing.write
        for driver, text in self.efforts.items():
            slides = not self.listing.motion.positions.rotary[driver]
            write(f"table[{quoted(Output('effort', driver, slides=slides).heading)}] = {text}")
        rows = [
            f"    ({quoted(joint)}, {quoted(link)}, {_sum(terms)}),"
            for (joint, link), terms in self.reactions.items()
        ]
        if not rows:
            return
        write("reactions = [", *rows, "]")
        write("largest = max(float(np.max(np.hypot(f[..., 0], f[..., 1]))) for _, _, f in reactions)")
        write("for joint_of, on, force in reactions:", "    size = np.hypot(force[..., 0], force[..., 1])")
        parts = {"x": "force[..., 0]", "y": "force[..., 1]", "": "size"}
        for part, text in parts.items():
            write(f'    table[f"{Output("reaction", "{joint_of}", part, "{on}").heading}"] = {text}')
        heading = Output("reaction_direction", "{joint_of}", on="{on}").heading
        write("    angle = np.where(size > 1e-12 * largest, np.arctan2(force[..., 1], force[..., 0]), np.nan)")
        write(f'    table[f"{heading}"] = angle')
        for (joint, link), text in self.couples.items():
            if link == "frame":
                continue
            write(f"table[{quoted(Output('couple', joint, on=link).heading)}] = {text}")


def _sum(terms: list[str]) -> str:
    return " + ".join(terms).replace("+ -", "- ")

"""Profiles of a cam's sheet: of a disc cam by inversion, of a barrel cam its developed groove."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from functools import cached_property

import numpy as np

from linkwright.cams.result import CamDesign
from linkwright.core.arrays import Complexes, Floats
from linkwright.pictures.labels import Name, put
from linkwright.pictures.picture import Picture, Runs, as_runs, indexed, joined
from linkwright.sheets.cam_division import (
    Paper,
    angle_between,
    checks_text,
    divided,
    graphical,
    inverted,
    marked,
    pair,
    pitch_of,
    sharpest,
    widest_gap,
)
from linkwright.sheets.layout import Drawn, Panel, drawing_scale, scale_text
from linkwright.sheets.machine import frame_pin, guide
from linkwright.words import Translate, _

_DENSE = 1440
#: Paper, mm: how far followers' lines go on beyond the outermost point, and room for numbers and names beyond them.
BEYOND, _MARGIN = 4.0, 12.0
#: Length of the stem of a translating follower at 0 beyond the other ones' lines, and where its guide is, mm.
_STEM, _GUIDE = 22.0, 14.5
#: Radius of an offset circle on paper from which the followers' lines begin at it, mm.
_OFFSET = 4.0
#: Share of the base circle within which the pitch curve is taken for it.
_SAME = 1e-6


class ProfilePanel(Panel):
    """Base circle, positions of the follower, pitch curve, rollers and the profile as their envelope, to scale."""

    name, rank = "profile", 0.5
    smallest, largest = 90.0, 420.0

    def __init__(self, design: CamDesign, translate: Translate) -> None:
        self.design, self.translate = design, translate
        self.places = divided(design.cam.program)
        self.at = inverted(design, self.places)
        self.turn = np.linspace(0.0, 2 * math.pi, _DENSE + 1)
        self.pitch = pitch_of(design, self.turn)
        self.walls = [_wall(design, k) for k in range(len(design.cam.walls))]
        cloud = [self.pitch, *self.walls, self.at.face.ravel()]
        self.outer = float(max(np.abs(each).max(initial=0.0) for each in cloud))
        self._drawn: dict[float, Drawn] = {}

    def drawn(self, size: float, scale: float | None) -> Drawn:
        wanted = 1e3 * max(self.extent) / max(size - 2 * (BEYOND + _MARGIN), 10.0)
        reduction = 1e3 * scale if scale else drawing_scale(wanted)
        if reduction not in self._drawn:
            self._drawn[reduction] = self._at(reduction)
        return self._drawn[reduction]

    def _at(self, reduction: float) -> Drawn:
        """The picture at a scale."""
        paper, picture = Paper(reduction), Picture()
        self._centre(picture, paper)
        self._circles(picture, paper)
        names = self._followers(picture, paper)
        self._curves(picture, paper)
        self._first(picture, paper)
        names += marked(picture, paper, self.design, self.translate, self.outer)
        put(picture, [replace(each, height=self.letters) for each in names])
        return Drawn(picture, tuple(self._caption(reduction)), scale_text(reduction))

    @cached_property
    def extent(self) -> tuple[float, float]:
        """Width and height of the picture at full size, m."""
        oscillating = self.design.cam.follower.oscillating
        ends = self.at.foot if oscillating else self.outer * self.at.along
        cloud = np.concatenate([*self.walls, self.pitch, self.at.face.ravel(), ends])
        return float(np.ptp(cloud.real)), float(np.ptp(cloud.imag))

    def _centre(self, picture: Picture, paper: Paper) -> None:
        """The axes of the cam and its pin."""
        reach = paper.length(self.outer) + BEYOND
        for way in ((1.0, 0.0), (0.0, 1.0)):
            picture.line([-reach * np.array(way), reach * np.array(way)], "chain")
        frame_pin(picture, np.zeros(2), (0.0, -1.0))

    def _circles(self, picture: Picture, paper: Paper) -> None:
        """Prime circle where the pitch curve leaves it, base circle of the profile, offset circle."""
        cam = self.design.cam
        base, roller = cam.base_radius or 0.0, cam.follower.roller_radius
        prime = (base + roller) * np.exp(1j * np.angle(self.pitch))
        if cam.follower.kind == "flat":
            prime = base * np.exp(1j * self.turn)
        else:
            prime = np.where(np.abs(np.abs(self.pitch) / (base + roller) - 1.0) < _SAME, np.nan, prime)
        picture.line(paper.points(prime), "chain")
        if roller:
            picture.circle((0.0, 0.0), paper.length(base), "thin")
        if offset := _offset(self.design):
            picture.circle((0.0, 0.0), paper.length(offset), "chain")

    def _followers(self, picture: Picture, paper: Paper) -> list[Name]:
        """The positions 0, 1, 2 …; gives their numbers with the places where these may be."""
        follower = self.design.cam.follower
        numbers: list[Name] = []
        for k in range(len(self.places)):
            end, away = (self._arm if follower.oscillating else self._stem)(picture, paper, k)
            numbers.append(Name(as_runs(str(k)), [end + 0.8 * pair(away)], clear=0.8))
            trace = paper.point(self.at.trace[k])
            for line in self.at.face[k : k + 1]:
                picture.line(paper.points(line), "thin")
            if follower.kind == "roller":
                picture.circle(trace, paper.length(follower.roller_radius), "thin")
            if follower.kind != "flat":
                picture.circle(trace, 0.4, "thin", fill="ink")
        if follower.oscillating:
            self._pivots(picture, paper)
        return numbers

    def _stem(self, picture: Picture, paper: Paper, k: int) -> tuple[Floats, complex]:
        """The line along which a translating follower slides, from where it touches the offset circle."""
        along, foot = complex(self.at.along[k]), complex(self.at.foot[k])
        start = foot if paper.length(abs(foot)) > _OFFSET else complex(self.at.rest[k])
        end = paper.point(foot + self._reach(foot) * along) + BEYOND * pair(along)
        picture.line([paper.point(start), end], "thin")
        return end, along

    def _reach(self, foot: complex) -> float:
        """Length from a foot to the circle around everything, m."""
        return math.sqrt(max(self.outer**2 - abs(foot) ** 2, 0.0))

    def _arm(self, picture: Picture, paper: Paper, k: int) -> tuple[Floats, complex]:
        """The arm of an oscillating follower, and the arc on which its end has moved from the base circle."""
        pivot, at = complex(self.at.foot[k]), self.at
        if self.design.cam.follower.kind == "flat":
            picture.line(paper.points(np.array([pivot, at.face[k, 1]])), "thin")
        else:
            picture.line(paper.points(np.array([pivot, at.trace[k]])), "thin")
            first = cmath.phase(at.rest[k] - pivot)
            turned = math.remainder(cmath.phase(at.trace[k] - pivot) - first, 2 * math.pi)
            if abs(turned) > 1e-9:
                radius = paper.length(abs(at.rest[k] - pivot))
                picture.arc(paper.point(pivot), radius, first, first + turned)
        picture.circle(paper.point(pivot), 0.6, "thin", fill="ink")
        return paper.point(pivot), pivot / abs(pivot)

    def _pivots(self, picture: Picture, paper: Paper) -> None:
        """The circle of the pivots, as far as there are any."""
        radius = paper.length(self.design.cam.follower.pivot_distance or 0.0)
        start, end = widest_gap(self.places)
        if end - start < math.radians(60):
            picture.circle((0.0, 0.0), radius, "chain")
            return
        sense = -self.design.cam.turn
        picture.arc((0.0, 0.0), radius, sense * end, sense * (start + 2 * math.pi), "chain")

    def _curves(self, picture: Picture, paper: Paper) -> None:
        """Pitch curve and profile; the second cam of a pair dashed."""
        if self.design.cam.follower.kind == "roller":
            picture.line(paper.points(self.pitch[:-1]), "chain", closed=True)
        for number, wall in enumerate(self.walls):
            second = number > 0 and self.design.cam.conjugate is not None
            picture.line(paper.points(wall), "dashed" if second else "thick", closed=True)

    def _first(self, picture: Picture, paper: Paper) -> None:
        """The follower at 0 with its guide or pivot, thick."""
        follower, at = self.design.cam.follower, self.at
        trace, along, foot = complex(at.trace[0]), complex(at.along[0]), complex(at.foot[0])
        for line in at.face[:1]:
            picture.line(paper.points(line), "thick")
        if follower.oscillating:
            start = at.face[0, 0] if len(at.face) else trace
            picture.line(paper.points(np.array([foot, start])), "thick")
            frame_pin(picture, paper.point(foot), (1.0, 0.0))
        else:
            low = trace if not len(at.face) else along * (trace / along).real
            end = paper.point(foot + self._reach(foot) * along) + BEYOND * pair(along)
            picture.line([paper.point(low), end + _STEM * pair(along)], "thick")
            guide(picture, end + _GUIDE * pair(along), pair(along))
        if follower.kind == "roller":
            picture.circle(paper.point(trace), paper.length(follower.roller_radius), "thick")
            picture.circle(paper.point(trace), 0.8, "thin", fill="paper")

    def _caption(self, reduction: float) -> Sequence[Runs]:
        lines = [as_runs(self.translate(_("Cam profile by inversion")))]
        lines.append(joined(graphical("l", 1e-3 * reduction, "m"), f"  ({scale_text(reduction)})"))
        if checks := checks_text(self.design):
            lines.append(checks)
        if self.design.cam.conjugate is not None:
            lines.append(as_runs(self.translate(_("dashed: second cam of the pair"))))
        return lines


def _offset(design: CamDesign) -> float:
    """Radius of the offset circle, m; zero where there is none."""
    follower = design.cam.follower
    return 0.0 if follower.oscillating or follower.kind == "flat" else abs(follower.offset)


def _wall(design: CamDesign, number: int) -> Complexes:
    """A wall as a closed outline, m; the second cam of a translating pair turned to its place."""
    points = design.profile(_DENSE, number)
    outline = points[:, 0] + 1j * points[:, 1]
    cam = design.cam
    return -outline if number and cam.conjugate is not None and not cam.follower.oscillating else outline


#: Room around the developed cylinder for numbers and names, and how far its edges lie beyond the groove, mm.
_DEVELOPMENT_MARGIN, _EDGE = 10.0, 6.0
#: How far and whither leaders of names go, mm.
_LEADER = np.array([-9.0, 11.0])


class DevelopmentPanel(Panel):
    """Path of the roller's centre, rollers at the divided angles and both walls of the groove, to scale."""

    name, rank = "profile", 0.5
    smallest, largest = 90.0, 420.0

    def __init__(self, design: CamDesign, translate: Translate) -> None:
        self.design, self.translate = design, translate
        self.places = np.append(divided(design.cam.program), 2 * math.pi)
        self.radius = design.cam.barrel_radius or 0.0
        phi = np.minimum(np.linspace(0.0, 2 * math.pi, _DENSE + 1), np.nextafter(2 * math.pi, 0.0))
        self.pitch = pitch_of(design, phi)
        self.walls = [wall.contact(phi).point for wall in design.cam.walls]

    @property
    def extent(self) -> tuple[float, float]:
        """Width and height of the development at full size, m."""
        return 2 * math.pi * self.radius, float(np.ptp(np.concatenate(self.walls).imag))

    def drawn(self, size: float, scale: float | None) -> Drawn:
        wide = 2 * math.pi * self.radius
        reduction = 1e3 * scale if scale else drawing_scale(1e3 * wide / max(size - 2 * _DEVELOPMENT_MARGIN, 10.0))
        paper, picture = Paper(reduction), Picture()
        low = paper.length(min(float(each.imag.min()) for each in self.walls)) - _EDGE
        high = paper.length(max(float(each.imag.max()) for each in self.walls)) + _EDGE
        end = paper.length(wide)
        for level in (low, high):
            picture.line([(0.0, level), (end, level)], "thick")
        for x in (0.0, end):
            picture.line([(x, low), (x, high)], "double_chain")
        picture.line(paper.points(self.pitch), "chain")
        for wall in self.walls:
            picture.line(paper.points(wall), "thick")
        names = self._rollers(picture, paper, low)
        names += self._marks(picture, paper, (end, high))
        put(picture, [replace(each, height=self.letters) for each in names])
        return Drawn(picture, tuple(self._caption(reduction)), scale_text(reduction))

    def _rollers(self, picture: Picture, paper: Paper, low: float) -> list[Name]:
        """The divided angles from the lower edge with the roller at each; gives their numbers."""
        names: list[Name] = []
        roller = paper.length(self.design.cam.follower.roller_radius)
        inside = np.minimum(self.places, np.nextafter(2 * math.pi, 0.0))
        for k, centre in enumerate(pitch_of(self.design, inside)):
            at = paper.point(centre)
            picture.line([(at[0], low), (at[0], at[1])], "thin")
            picture.circle(at, roller, "thin")
            number = str(k % (len(self.places) - 1))
            names.append(Name(as_runs(number), [np.array([at[0], low - depth]) for depth in (2.5, 8.0)], clear=0.3))
        return names

    def _marks(self, picture: Picture, paper: Paper, corner: tuple[float, float]) -> list[Name]:
        """The governing pressure angle, the length of the development, the names of curves."""
        end, high = corner
        level = high + 7.0
        picture.line([(0.0, level), (end, level)])
        for x, way in ((0.0, -1.0), (end, 1.0)):
            picture.line([(x, high), (x, level + 1.5)])
            picture.head((x, level), (way, 0.0))
        length = f"2πR = {1e3 * 2 * math.pi * self.radius:.5g} mm"
        names = [Name(as_runs(length), [np.array([0.5 * end, level])], clear=0.8)]
        found = sharpest(self.design)
        if found is not None:
            phi = np.array([found.place])
            start, slope = pitch_of(self.design, phi)[0], self.design.wall.contact(phi).normal[0]
            spots = angle_between(picture, paper.point(start), 1j, complex(slope), 0.0)
            names.append(Name(indexed("α", "max"), spots))
        for title, curve, share in ((_("pitch curve"), self.pitch, 0.28), (_("profile"), self.walls[1], 0.36)):
            place = paper.point(curve[round(share * (len(curve) - 1))])
            side = place + _LEADER
            picture.line([place, side])
            names.append(Name(as_runs(self.translate(title)), [side], clear=0.6))
        return names

    def _caption(self, reduction: float) -> Sequence[Runs]:
        lines = [as_runs(self.translate(_("Groove of the barrel cam, developed")))]
        lines.append(joined(graphical("l", 1e-3 * reduction, "m"), f"  ({scale_text(reduction)})"))
        if checks := checks_text(self.design):
            lines.append(checks)
        return lines

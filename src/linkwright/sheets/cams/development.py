"""The groove of a barrel cam, developed: its walls over the length of the cylinder's circumference."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from linkwright.cams.result import CamDesign
from linkwright.pictures.labels import Name, put
from linkwright.pictures.picture import Picture, Runs, as_runs, indexed, joined
from linkwright.sheets.cams.division import Paper, divided, pitch_of, sharpest
from linkwright.sheets.cams.marks import angle_between, checks_text, graphical
from linkwright.sheets.panel import Drawn, Panel, drawing_scale, scale_text
from linkwright.words import Translate, _

_DENSE = 1440
#: Room around the developed cylinder for numbers and names, and how far its edges lie beyond the groove, mm.
_MARGIN, _EDGE = 10.0, 6.0
#: How far and whither leaders of names go, mm.
_LEADER = np.array([-9.0, 11.0])


class DevelopmentPanel(Panel):
    """Path of the roller's centre, rollers at the divided angles and both walls of the groove, to scale."""

    name, rank = "profile", 0.5
    smallest, largest = 90.0, 420.0

    def __init__(self, design: CamDesign, say: Translate) -> None:
        self.design, self.say = design, say
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
        reduction = 1e3 * scale if scale else drawing_scale(1e3 * wide / max(size - 2 * _MARGIN, 10.0))
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
            names.append(Name(as_runs(self.say(title)), [side], clear=0.6))
        return names

    def _caption(self, reduction: float) -> Sequence[Runs]:
        lines = [as_runs(self.say(_("Groove of the barrel cam, developed")))]
        lines.append(joined(graphical("l", 1e-3 * reduction, "m"), f"  ({scale_text(reduction)})"))
        if checks := checks_text(self.design):
            lines.append(checks)
        return lines

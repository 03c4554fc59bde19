"""Gears, racks, wheels, belts, chains and cams of a mechanism's drawing, by what their joints say of themselves."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import replace

import numpy as np

from linkwright.pictures.symbols.base import SYMBOLS, Shape
from linkwright.plot.drawing.joint_marks import Mark, marks
from linkwright.plot.drawing.machine import Machine, Part

#: A rack goes on beyond the last place of its pinion, units of the paper.
BEYOND = 14.0
#: Ends of followers, drawn over the blocks that carry them.
_OVER = ("roller", "knife", "face")


def wheels(machine: Machine) -> Iterator[Part]:
    """The marks of all joints, each wheel once: below everything else, rings and large ones first, but the ends of
    followers on top."""
    mechanism = machine.motion.mechanism
    tooth: dict[tuple[str, str], float] = {}
    found: dict[Mark, Mark] = {}
    for joint in mechanism.joints.values():
        for mark in marks(joint, mechanism, tooth):
            key = replace(mark, radius=round(mark.radius, 9), turned=0.0, teeth=None, follows=None)
            found.setdefault(key, mark)
    for mark in sorted(found.values(), key=lambda each: (not each.inside, -each.radius)):
        yield Part("tops" if mark.symbol in _OVER else "ground", mark.link, _shape(machine, mark))


def _shape(machine: Machine, mark: Mark) -> Shape:
    scale, at = machine.view.scale, machine.view.local(mark.at)
    if mark.symbol == "gear":
        return SYMBOLS["gear"](
            at=at, radius=mark.radius * scale, turned=-mark.turned, inside=mark.inside, teeth=mark.teeth
        )
    if mark.symbol in ("disc", "roller"):
        return SYMBOLS[mark.symbol](at=at, radius=mark.radius * scale)
    if mark.symbol in ("strand", "face"):
        return SYMBOLS[mark.symbol](start=at, end=machine.view.local(mark.to))
    if mark.symbol == "knife":
        return SYMBOLS["knife"](at=at, along=(math.cos(mark.turned), -math.sin(mark.turned)))
    if mark.symbol == "cam":
        profile, pitch, outer = ([machine.view.local(each) for each in line] for line in mark.outlines)
        return SYMBOLS["cam"](profile=profile, pitch=pitch, outer=outer)
    assert mark.follows is not None
    along = (math.cos(mark.turned), -math.sin(mark.turned))
    link, point = mark.follows
    gap = machine.placed[link].world(machine.motion.mechanism.link(link).points[point])
    placed = machine.placed[mark.link]
    gap = gap - placed.world(mark.at)
    c, s = math.cos(mark.turned), math.sin(mark.turned)
    ex, ey = placed.direction[:, 0], placed.direction[:, 1]
    ways = (gap[:, 0] * (ex * c - ey * s) + gap[:, 1] * (ey * c + ex * s)) * scale
    low, high = float(np.nanmin(ways)) - BEYOND, float(np.nanmax(ways)) + BEYOND
    if mark.inside:
        along, low, high = (-along[0], -along[1]), -high, -low
    return SYMBOLS["rack"](at=at, along=along, start=low, end=high)

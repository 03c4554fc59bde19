"""Cams, teeth and racks as a page draws them, against what drawings have of the same joints."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from tests import store
from tests.drawn_cams import CASES, text_of
from tests.every import every
from tests.ui.browser import Opened, needs_chromium
from tests.ui.pages import STEPS, page, page_of

import linkwright as lw
from linkwright.mechanism.wheels_and_cams import CamShape
from linkwright.plotting.drawing.joint_marks import marks as marks_of

pytestmark = needs_chromium


@pytest.mark.parametrize(
    ("case", "touch"),
    [
        (0, "groove"),
        pytest.param(1, "flat", marks=pytest.mark.rotating),
        pytest.param(2, "knife", marks=pytest.mark.rotating),
        (0, "flat"),
    ],
)
def test_cams_are_drawn_where_their_followers_touch(opened: Opened, tmp_path: Path, case: int, touch: str) -> None:
    """Contacts found from velocities are points of the profile by its formula, before and after a change."""
    held, side = CASES[case]
    text = text_of(held, side, touch, "clockwise")
    mechanism = lw.loads(text)
    opened.open(page_of(text, tmp_path))
    for changes in ({}, {"lobe.base_radius": 0.074}):
        if changes:
            opened.run("(s, c) => { s.take({...s.model.values, ...c}); s.view.draw(3); }", changes)
        now = mechanism.with_dimensions(changes)
        joint = now.joints["lobe"]
        shape = CamShape.of(joint, now)
        turned = lw.solve_motion(now, steps=STEPS).link("cam").angle
        phi = joint.sense * (turned - joint.phase)
        drawn = opened.run(
            "s => { const g = s.data.glyphs.find(g => g.kind === 'cam'); return s.view.shapes.cam(g); }"
        )
        assert drawn["closed"]
        curves = {"profile": shape.profile(phi)}
        if touch == "groove":
            curves |= {"outer": shape.profile(phi, outer=True), "pitch": shape.pitch(phi)}
        for name, want in curves.items():
            found = np.array(drawn[name]) @ [1, 1j] + shape.centre
            off = np.abs(found[:, None] - want[None, :]).min(axis=1)
            assert off.max() < 1e-11, name
            assert len(found) == STEPS
        if touch == "flat":
            ends = np.subtract(*(complex(*each) for each in (now_face(now)[1], now_face(now)[0])))
            assert drawn["face"][1] - drawn["face"][0] == pytest.approx(abs(ends), rel=0.05)


def now_face(mechanism: lw.Mechanism) -> tuple[Any, Any]:
    """Ends of a flat face as drawings have it."""
    face = next(m for m in marks_of(mechanism.joints["lobe"], mechanism, {}) if m.symbol == "face")
    return face.at, face.to


@pytest.mark.rotating
def test_teeth_mesh_and_racks_reach_as_far_as_they_are_used(opened: Opened, tmp_path: Path) -> None:
    """Places of teeth against those of the drawings (by the gears' phases), after a change of the centres as well."""
    text = store.text("internal_gear_pair").replace(", module: 2 mm", "")
    assert text != store.text("internal_gear_pair")
    mechanism = lw.loads(text)
    opened.open(page_of(text, tmp_path))
    opened.run("s => { s.take({...s.model.values, 'frame.Q.y': -0.012}); s.view.draw(0); }")
    changed = mechanism.with_dimensions({"frame.Q.y": -0.012})
    marks = [m for j in changed.joints.values() for m in marks_of(j, changed, {}) if m.symbol == "gear"]
    places = opened.run(
        "s => s.data.glyphs.flatMap((g, k) => g.kind === 'wheel' ? [[g.link, s.view.shapes.tooth(k),"
        " s.view.shapes.radius(g)]] : [])"
    )
    own = {link: (tooth, radius) for link, tooth, radius in places}
    pitches = []
    for mark in every(marks, least=2):
        tooth, radius = own[mark.link]
        assert radius == pytest.approx(mark.radius, rel=1e-12)
        pitches.append((tooth - mark.turned) * mark.teeth / (2 * math.pi))
    # One pitch of one wheel is one of the other: both may have gone on by the same part of a pitch.
    assert (pitches[0] - pitches[1]) % 1 == pytest.approx(0.0, abs=1e-9) or (
        pitches[0] - pitches[1]
    ) % 1 == pytest.approx(1.0, abs=1e-9)
    opened.open(page("pinion_between_racks"))
    assert opened.run("s => s.data.undrawn") == []
    motion = store.motion("pinion_between_racks", STEPS)
    travel = np.ptp(motion.point("pinion.C").position[:, 0])
    lengths = opened.run(
        "s => s.data.glyphs.filter(g => g.kind === 'rack').map(g => s.view.shapes.rack(g)).map(r => r.high - r.low)"
    )
    assert sorted(lengths) == pytest.approx([travel, travel], rel=1e-9)

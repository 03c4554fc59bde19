"""What is refused of gears, racks, belts, cams and guides: the place and the reason of each."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from tests import store
from tests.refusals import checked, findings, refused, said

import linkwright as lw
from linkwright.machine import steady_running
from linkwright.mechanism.wheels_and_cams import wheel_sizes

HEAD = """format: 1
frame: {points: {O: [0 mm, 0 mm], Q: [60 mm, 0 mm], R: [30 mm, 51.96152422706632 mm], G: [0 mm, -20 mm],
  S: [0 mm, -20 mm], P: [0 mm, 0 mm], H: [90 mm, 0 mm], K: [95 mm, 0 mm]}}
links:
  a: {points: {O: [0 mm, 0 mm]}}
  b: {points: {Q: [0 mm, 0 mm]}}
  c: {points: {R: [0 mm, 0 mm]}}
  loose: {points: {O: [0 mm, 0 mm], X: [10 mm, 0 mm]}}
  bar: {points: {X: [0 mm, 0 mm], Y: [10 mm, 0 mm]}}
  d: {points: {P: [0 mm, 0 mm]}}
  e: {points: {H: [0 mm, 0 mm], K: [5 mm, 0 mm]}}
  rack: {points: {T: [0 mm, 0 mm], U: [10 mm, 0 mm]}}
driver: {turn: a, about: O, speed: 1 rad/s}
joints:
"""
GUIDE = "  way: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: rack, at: T}\n"
CAM = "  m: {{kind: cam, cam: {cam}, follower: {follower}, at: T, touch: flat, base_radius: 20 mm{more}}}"
PROGRAM = ", program: [{rise: 10 mm, over: 180 deg}, {fall: 10 mm, over: 180 deg}]"
TABLE = ", angles: [0 deg, 90 deg], lifts: [0 mm, 5 mm]"
CASES = {
    "centre distance": (
        "  m: {kind: gear, links: [a, b], teeth: [20, 40], module: 3 mm}",
        (
            "joints.m.module",
            "range",
            {
                "message": (
                    "the distance of the centres {centres} on {carrier!r} is {distance}, but the {mesh} pair needs "
                    "{wanted}"
                ),
                "mesh": "external",
                "distance": "60 mm",
                "wanted": "90 mm",
            },
        ),
    ),
    "internal distance": (
        "  m: {kind: gear, links: [a, b], radii: [20 mm, 60 mm], mesh: internal}",
        (
            "joints.m.radii",
            "range",
            {
                "message": (
                    "the distance of the centres {centres} on {carrier!r} is {distance}, but the {mesh} pair needs "
                    "{wanted}"
                ),
                "mesh": "internal",
                "wanted": "40 mm",
            },
        ),
    ),
    "teeth and ratio": (
        "  m: {kind: gear, links: [a, b], teeth: [20, 40], ratio: -2}",
        (
            "joints.m.ratio",
            "choice",
            {
                "message": "the ratio {ratio:g} does not fit {key_}, which give {own:g}",
                "ratio": -2.0,
                "key_": "teeth",
                "own": -0.5,
            },
        ),
    ),
    "ratio of another mesh": (
        "  m: {kind: gear, links: [a, b], teeth: [20, 40], mesh: internal, ratio: -0.5}",
        (
            "joints.m.ratio",
            "choice",
            {
                "message": "the ratio {ratio:g} does not fit {key_}, which give {own:g}",
                "ratio": -0.5,
                "key_": "teeth",
                "own": 0.5,
            },
        ),
    ),
    "distance a little off": (
        "  m: {kind: gear, links: [a, b], radii: [20 mm, 40.0006 mm]}",
        (
            "joints.m.radii",
            "range",
            {
                "message": (
                    "the distance of the centres {centres} on {carrier!r} is {distance}, but the {mesh} "
                    "pair needs {wanted}"
                ),
                "mesh": "external",
                "wanted": "60.0006 mm",
            },
        ),
    ),
    "half a tooth": (
        "  m: {kind: gear, links: [a, b], teeth: [20.5, 40]}",
        ("joints.m.teeth", "range", {"message": "invalid number of teeth {value:g}", "value": 20.5}),
    ),
    "no size": (
        "  m: {kind: gear, links: [a, b]}",
        (
            "joints.m",
            "missing-key",
            {"message": "nothing says how large the wheels are", "keys": ("teeth", "radii", "ratio")},
        ),
    ),
    "gear without pin": (
        "  m: {kind: gear, links: [a, rack], ratio: -1}",
        (
            "joints.m.links",
            "reference",
            {"message": 'the wheel "{wheel}" has no pin about which it turns', "wheel": "rack"},
        ),
    ),
    "no common carrier": (
        "  m: {kind: gear, links: [b, bar], ratio: -1}",
        (
            "joints.m.links",
            "reference",
            {
                "message": (
                    "no link carries the pins of both wheels {wheels}, so nothing fixes their centre distance"
                ),
                "wheels": ("b", "bar"),
            },
        ),
    ),
    "sprockets and radii": (
        "  m: {kind: chain, links: [a, b], teeth: [17, 51], radii: [30 mm, 60 mm], pitch: 5 mm}",
        ("joints.m.radii", "choice", {"message": "pitch with teeth already gives the radii"}),
    ),
    "wheels of two sizes": (
        "  m: {kind: gear, links: [a, b], teeth: [20, 40], radii: [10 mm, 30 mm]}",
        ("joints.m.radii", "choice", {"message": "teeth and radii give different ratios"}),
    ),
    "chain without pitch": (
        "  m: {kind: chain, links: [a, b], teeth: [17, 51]}",
        ("joints.m", "missing-key", {"message": "the chain's pitch is missing"}),
    ),
    "belt without turning": (
        "  m: {kind: belt, links: [a, rack], radii: [10 mm, 10 mm]}",
        (
            "joints.m.links",
            "reference",
            {
                "message": 'the link "{wheel}" does not turn about a pin, so no belt or chain can run around it',
                "wheel": "rack",
            },
        ),
    ),
    "pulleys touch": (
        "  m: {kind: belt, links: [a, b], radii: [30 mm, 40 mm]}",
        (
            "joints.m.radii",
            "range",
            {
                "message": "the radii add up to {sum}, but the distance of the centres {centres} is {distance}",
                "sum": "70 mm",
            },
        ),
    ),
    "pulleys that just touch": (
        "  m: {kind: belt, links: [a, b], radii: [20 mm, 40 mm]}",
        (
            "joints.m.radii",
            "range",
            {
                "message": "the radii add up to {sum}, but the distance of the centres {centres} is {distance}",
                "sum": "60 mm",
                "distance": "60 mm",
            },
        ),
    ),
    "rack without guide": (
        "  m: {kind: rack, pinion: a, rack: rack, through: T, radius: 20 mm}",
        (
            "joints.m.rack",
            "range",
            {
                "message": (
                    "no guide leads from the rack {rack!r} to a link that carries the pin of {pinion!r}: "
                    "nothing keeps the pinion at its distance from the rack"
                ),
                "rack": "rack",
            },
        ),
    ),
    "rack too far": (
        GUIDE + "  m: {kind: rack, pinion: a, rack: rack, through: T, radius: 25 mm}",
        (
            "joints.m.radius",
            "range",
            {
                "message": (
                    "the pinion's centre {centre!r} is {distance} away from the pitch line, but its "
                    "radius is {radius}"
                ),
                "distance": "20 mm",
                "radius": "25 mm",
            },
        ),
    ),
    "rack askew": (
        GUIDE + "  m: {kind: rack, pinion: a, rack: rack, through: T, radius: 20 mm, direction: 10 deg}",
        (
            "joints.m.direction",
            "range",
            {
                "message": "the guide {guide!r} is not parallel to the pitch line of {rack!r}",
                "guide": "way",
                "rack": "rack",
            },
        ),
    ),
    "rack on itself": (
        "  m: {kind: rack, pinion: rack, rack: rack, through: T, radius: 20 mm}",
        ("joints.m.rack", "reference", {"message": 'both links are "{first}"', "first": "rack"}),
    ),
    "pinion without pin": (
        GUIDE + "  m: {kind: rack, pinion: rack, rack: a, through: O, radius: 20 mm}",
        (
            "joints.m.pinion",
            "reference",
            {"message": 'the wheel "{wheel}" has no pin about which it turns', "wheel": "rack"},
        ),
    ),
    "rack of no size": (
        GUIDE + "  m: {kind: rack, pinion: a, rack: rack, through: T, teeth: 20}",
        ("joints.m.radius", "missing-key", {"message": "nothing says how large the wheels are"}),
    ),
    "module without teeth": (
        "  m: {kind: gear, links: [a, b], radii: [20 mm, 40 mm], module: 3 mm}",
        ("joints.m.module", "choice", {"message": "a module says nothing about wheels without numbers of teeth"}),
    ),
    "another carrier": (
        "  m: {kind: gear, links: [a, b], teeth: [20, 40], carrier: bar}",
        (
            "joints.m.carrier",
            "reference",
            {
                "message": "{name!r} does not carry the pins of both wheels {wheels}",
                "names": ("frame",),
                "name": "bar",
            },
        ),
    ),
    "teeth that press along the line of centres": (
        "  m: {kind: gear, links: [a, b], teeth: [20, 40], pressure_angle: 90 deg}",
        (
            "joints.m.pressure_angle",
            "range",
            {
                "message": "{shown} is {fault}",
                "fault": "too large",
                "shown": "90 deg",
                "low": "0 deg",
                "high": "90 deg",
            },
        ),
    ),
    "rack of two sizes": (
        GUIDE + "  m: {kind: rack, pinion: a, rack: rack, through: T, teeth: 20, module: 2 mm, radius: 20 mm}",
        ("joints.m.radius", "choice", {"message": "the size is set twice"}),
    ),
    "rack of half a tooth": (
        GUIDE + "  m: {kind: rack, pinion: a, rack: rack, through: T, teeth: 20.5, module: 2 mm}",
        ("joints.m.teeth", "range", {"message": "invalid number of teeth {value:g}", "value": 20.5}),
    ),
    "pinion's centre without guide": (
        GUIDE + "  m: {kind: rack, pinion: loose, rack: rack, through: T, radius: 20 mm, centre: X}",
        (
            "joints.m.centre",
            "range",
            {"message": "{centre!r} is not a pin to whose link a guide of the rack {rack!r} leads", "centre": "X"},
        ),
    ),
    "belt of no size": (
        "  m: {kind: belt, links: [a, b]}",
        ("joints.m", "missing-key", {"message": "nothing says how large the wheels are", "keys": ("radii",)}),
    ),
    "ring of the same size": (
        "  m: {kind: gear, links: [a, b], teeth: [20, 20], mesh: internal}",
        ("joints.m", "range", {"message": "a wheel cannot run in a ring of its own size"}),
    ),
    "radius of zero": (
        "  m: {kind: gear, links: [a, b], radii: [0 mm, 60 mm]}",
        (
            "joints.m.radii.0",
            "range",
            {
                "message": "{shown} is {fault}",
                "fault": "zero",
                "limit": "{noun} above {limit}",
                "noun": "a length",
                "shown": "0 mm",
            },
        ),
    ),
    "one centre": (
        "  m: {kind: gear, links: [a, d], teeth: [20, 40]}",
        ("joints.m.links", "range", {"message": "the centres {centres} lie in one place", "centres": ("O", "P")}),
    ),
    "several carriers": (
        "  m: {kind: gear, links: [b, e], teeth: [20, 40]}",
        (
            "joints.m.links",
            "reference",
            {"message": "the centres of the wheels may be {names}", "names": ("frame (Q, H)", "frame (Q, K)")},
        ),
    ),
    "cam of itself": (
        CAM.format(cam="a", follower="a", more=PROGRAM).replace("at: T", "at: O"),
        ("joints.m.follower", "reference", {"message": "a cam cannot be its own follower"}),
    ),
    "cam without a lift": (
        CAM.format(cam="a", follower="rack", more=""),
        ("joints.m.program", "missing-key", {"message": "the lift of the cam is missing, or set twice"}),
    ),
    "cam of two lifts": (
        CAM.format(cam="a", follower="rack", more=PROGRAM + TABLE),
        ("joints.m.program", "missing-key", {"message": "the lift of the cam is missing, or set twice"}),
    ),
    "cam with a short table": (
        CAM.format(cam="a", follower="rack", more=TABLE),
        ("joints.m.angles", "range", {"message": "the table of the lift is none"}),
    ),
    "roller of no size": (
        CAM.format(cam="a", follower="rack", more=PROGRAM).replace("flat", "roller"),
        ("joints.m.roller_radius", "missing-key", {"message": "a roller and its radius go together"}),
    ),
    "follower that no guide holds": (
        CAM.format(cam="a", follower="rack", more=PROGRAM),
        (
            "joints.m.follower",
            "range",
            {
                "message": "the follower {follower!r} has no guide on a link on which the cam {cam!r} turns",
                "follower": "rack",
            },
        ),
    ),
    "follower that no pin holds": (
        CAM.format(cam="a", follower="rack", more=PROGRAM.replace("10 mm", "10 deg") + ", side: left"),
        (
            "joints.m.follower",
            "range",
            {
                "message": (
                    "the oscillating follower {follower!r} has no pin on a link on which the cam {cam!r} turns"
                ),
                "follower": "rack",
            },
        ),
    ),
    "guide on itself": (
        GUIDE.replace("guide: frame, through: G", "guide: rack, through: U"),
        ("joints.way.block", "reference", {"message": 'guide and block are both "{guide}"', "guide": "rack"}),
    ),
    "direction of no length": (
        GUIDE.replace("direction: 0 deg", "direction: [G, S]"),
        (
            "joints.way.direction",
            "range",
            {"message": "{points} are at the same place", "first": ("G",), "last": "S"},
        ),
    ),
    "point of guide and block": (
        "  way: {kind: prismatic, guide: a, through: O, direction: 0 deg, block: loose, at: O}",
        (
            "joints.way.at",
            "ambiguous",
            {
                "message": '"{point}" names a point of the guide and of the block, and {others} has it too',
                "point": "O",
                "others": ("frame",),
            },
        ),
    ),
    "unknown kind": (
        "  m: {kind: gaer, links: [a, b], ratio: -1}",
        ("joints.m.kind", "unknown-word", {"message": '"{text}" is not known here', "offer": "gear"}),
    ),
}


@pytest.mark.parametrize("name", CASES)
def test_finding(name: str) -> None:
    joint, (key, code, values) = CASES[name]
    found = said(findings(f"{HEAD}{joint}\n", "wheels.yaml"), code, key, **values)
    assert found.where.startswith("wheels.yaml:") and found.severity == "error" and found.remedy


def test_wheels_that_block_each_other_are_named_with_their_loop() -> None:
    text = HEAD.split("  loose", maxsplit=1)[0] + "driver: {turn: a, about: O, speed: 1 rad/s}\njoints:\n"
    text += "".join(f"  {x}{y}: {{kind: gear, links: [{x}, {y}], ratio: -1}}\n" for x, y in ("ab", "bc", "ca"))
    with refused("mobility.blocked", mobility=0, pairs=("'bc'", "'ab'", "'ca'"), carrier="frame", pair="ca"):
        lw.structure(lw.loads(text))


MOVED = """format: 1
frame: {{points: {{O: [0 mm, 0 mm], Q: [60 mm, 0 mm]}}}}
links:
  a: {{points: {{O: [0 mm, 0 mm]}}}}
  b: {{points: {{Q: [0 mm, 0 mm]}}}}
driver: {{turn: a, about: O, speed: 1 rad/s}}
joints:
  m: {{{pair}}}
"""


@pytest.mark.parametrize(
    ("pair", "distances", "fits", "values"),
    [
        (
            "kind: gear, links: [a, b], radii: [20 mm, 40 mm]",
            [0.06, 0.0601],
            [1, 0],
            {"mesh": "external", "wanted": "60 mm"},
        ),
        ("kind: gear, links: [a, b], teeth: [20, 40], module: 2 mm", [0.06, 0.059], [1, 0], {"distance": "59 mm"}),
        ("kind: gear, links: [a, b], teeth: [20, 40]", [0.06, 0.061], [1, 1], {}),
        (
            "kind: belt, links: [a, b], radii: [20 mm, 10 mm]",
            [0.06, 0.02],
            [1, 0],
            {
                "sum": "30 mm",
                "reason": "the radii add up to {sum}, but the distance of the centres {centres} is {distance}",
            },
        ),
    ],
)
def test_a_distance_that_no_longer_fits_is_noticed(
    pair: str, distances: list[float], fits: list[int], values: dict[str, object]
) -> None:
    """Designs of a sweep whose wheels do not fit count as not assembled; one alone is refused with the reason."""
    mechanism = lw.loads(MOVED.format(pair=pair))
    found = lw.sweep(mechanism, {"frame.Q.x": distances}, outputs=["b.angular_velocity"], steps=12)
    assert (found.assembled > 0).tolist() == [bool(each) for each in fits]
    for distance, good in zip(distances, fits, strict=True):
        changed = mechanism.with_dimensions({"frame.Q.x": distance})
        if good:
            assert lw.solve_motion(changed, steps=4).ok.all()
            continue
        with refused("motion.refused", lw.PositionError, joint="m", **values):
            lw.solve_motion(changed, steps=4)
        assert {each.kind for each in lw.solve_motion(changed, steps=4, failures="mark").outcomes} == {"misfit"}


def test_no_derivative_by_a_distance_that_wheels_fix() -> None:
    five_bar = store.machine("geared_fivebar")
    for address in ("frame.O2.x", "mesh.radii.0"):
        with refused("study.fixed_by_wheels", address=address, centres=("O1", "O2"), mesh="external"):
            lw.sensitivity(five_bar, of=["driver.effort"], by=[address], steps=12)
    found = lw.sensitivity(five_bar, of=["driver.effort"], by=["mesh.phase", "bar_1.length"], steps=12)
    assert found.slope("driver.effort", "mesh.phase").shape == (12,)


@pytest.mark.parametrize(
    ("radii", "data"),
    [
        ("[20 mm, 10 mm]", []),
        ("[10 mm, 20 mm]", [("2 ", "'driver'")]),
        ("[10 mm, 14.142135623730951 mm]", [("1000",)]),
    ],
)
def test_a_belt_says_how_many_turns_its_cycle_takes(radii: str, data: list[tuple[str, ...]]) -> None:
    pair = f"kind: belt, links: [a, b], radii: {radii}"
    notes = lw.solve_motion(lw.loads(MOVED.format(pair=pair)), steps=4).notes
    for note, named in zip(notes, data, strict=True):
        assert all(each in note for each in named)


#: A pinion between two racks of one slide: its rotation would move the slide both ways at once.
TWO_RACKS_OF_A_SLIDE = """
format: 1
name: racks of one slide on both sides of a pinion
frame: {points: {O: [0 m, 0 m], G: [0 m, -30 mm]}}
links:
  pinion: {points: {O: [0 m, 0 m], P: [10 mm, 0 m]}}
  slide: {points: {R: [0 m, 0 m], U: [0 m, 60 mm]}}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 0 deg, block: slide, at: R}
  low: {kind: rack, pinion: pinion, rack: slide, through: R, radius: 30 mm}
  high: {kind: rack, pinion: pinion, rack: slide, through: U, radius: 30 mm}
driver: {turn: pinion, about: O, speed: 60 rpm}
"""


def test_racks_that_block_each_other_are_named() -> None:
    with refused("mobility.blocked_pairs", mobility=0, pairs=("'low'", "'high'"), pair="high"):
        lw.structure(lw.loads(TWO_RACKS_OF_A_SLIDE))
    alone = "\n".join(line for line in TWO_RACKS_OF_A_SLIDE.splitlines() if not line.startswith("  high"))
    assert lw.structure(lw.loads(alone)).mobility == 1


def test_pairs_that_do_not_block_are_not_accused() -> None:
    """A second driver is one too many; the wheels themselves could turn."""
    two = TWO_RACKS_OF_A_SLIDE.replace(
        "driver: {turn: pinion, about: O, speed: 60 rpm}",
        "drivers: {a: {turn: pinion, about: O, speed: 60 rpm}, b: {slide: guide, speed: 1 m/s}}",
    )
    alone = "\n".join(line for line in two.splitlines() if not line.startswith("  high"))
    with refused("mobility.excess", mobility=1, count=2, extra=("driver 'b'",)):
        lw.structure(lw.loads(alone))


#: A parallelogram with a third crank, whose first one the oscillating follower of a cam is.
PARALLELOGRAM_MOVED_BY_A_CAM = """
format: 1
name: parallelogram with a third crank, moved by a cam
frame: {points: {O: [-60 mm, 0 mm], A: [0 mm, 0 mm], B: [100 mm, 0 mm], C: [50 mm, 0 mm]}}
links:
  cam: {points: [O, P]}
  left: {points: [A, D, F]}
  right: {points: [B, E]}
  middle: {points: [C, M]}
  bar: {points: [D, E, M]}
drawing:
  {P: [-60 mm, 10 mm], F: [-30 mm, 20 mm], D: [0 mm, 60 mm], E: [100 mm, 60 mm], M: [50 mm, 60 mm]}
joints:
  contact:
    {kind: cam, cam: cam, follower: left, at: F, touch: roller, roller_radius: 5 mm, base_radius: 20 mm, side: left,
     program: [{rise: 20 deg, over: 180 deg, law: cycloidal}, {fall: 20 deg, over: 180 deg, law: cycloidal}]}
driver: {turn: cam, about: O, speed: 60 rpm}
"""


def test_a_link_too_many_behind_a_cam_is_named() -> None:
    with refused(
        "mobility.excess", mobility=0, reason="the link {links} is redundant in this special geometry; remove it"
    ):
        lw.solve_motion(lw.loads(PARALLELOGRAM_MOVED_BY_A_CAM))


def test_a_missing_key_is_asked_for_by_its_name() -> None:
    text = TWO_RACKS_OF_A_SLIDE.replace(
        "pinion: pinion, rack: slide, through: U, radius: 30 mm", "radii: [1 m, 1 m]"
    ).replace("high: {kind: rack", "high: {kind: belt")
    said(findings(text), "missing-key", "joints.high.links", key_="links")


#: A cam and a pinion on one shaft, both of which move the follower: by the lift, and in proportion to the angle.
CAM_AND_RACK = """
format: 1
name: cam against rack
frame: {points: {O: [0 m, 0 m], G: [0 m, 60 mm]}}
links:
  shaft: {points: {O: [0 m, 0 m], P: [10 mm, 0 m]}}
  follower: {points: {R: [0 m, 0 m], U: [0 m, 30 mm]}}
joints:
  guide: {kind: prismatic, guide: frame, through: G, direction: 90 deg, block: follower, at: R}
  cam: {kind: cam, cam: shaft, follower: follower, at: R, touch: knife, base_radius: 30 mm, program: [
    {rise: 10 mm, over: 120 deg, law: cycloidal}, {dwell: 60 deg}, {fall: 10 mm, over: 180 deg, law: cycloidal}]}
  rack: {kind: rack, pinion: shaft, rack: follower, through: U, radius: 30 mm}
driver: {turn: shaft, about: O, speed: 60 rpm}
"""


def test_a_cam_against_a_rack_on_one_follower_is_named() -> None:
    pairs = ("'cam'", "'rack'")
    with refused("mobility.blocked_by_lift", mobility=0, pairs=pairs, cams=("'cam'",), pair="rack"):
        lw.structure(lw.loads(CAM_AND_RACK))
    for own in ("  cam", "  rack"):
        lines = CAM_AND_RACK.splitlines()
        first = next(k for k, line in enumerate(lines) if line.startswith(own + ":"))
        alone = lines[:first] + lines[first + (2 if own == "  cam" else 1) :]
        assert lw.structure(lw.loads("\n".join(alone))).mobility == 1


def test_a_pinion_on_its_own_shaft_is_not_accused() -> None:
    own = CAM_AND_RACK.replace("pinion: shaft", "pinion: wheel").replace(
        "  follower: {points", "  wheel: {points: {W: [0 m, 0 m], V: [5 mm, 0 m]}}\n  follower: {points"
    )
    own = own.replace("O: [0 m, 0 m], G:", "O: [0 m, 0 m], W: [0 m, 10 mm], G:", 1)
    assert lw.structure(lw.loads(own)).mobility == 1


def two_wheels(kind: str) -> str:
    """Two wheels on the frame, 60 mm apart."""
    kept = ("  a:", "  b:", "format", "frame", "  S:", "links", "driver", "joints")
    lines = [line for line in HEAD.splitlines() if line.startswith(kept)]
    return "\n".join([*lines, f"  m: {{{kind}, links: [a, b]}}"])


@pytest.mark.parametrize(
    ("kind", "address", "value", "given", "limit"),
    [
        ("kind: gear, teeth: [20, 40]", "m.teeth.0", -20.0, "-20", "model.above"),
        ("kind: gear, teeth: [20, 40]", "m.teeth.1", 0.0, "0", "model.above"),
        ("kind: rolling, radii: [20 mm, 40 mm]", "m.radii.0", -0.02, "-0.02 m", "model.above"),
        ("kind: belt, radii: [10 mm, 40 mm]", "m.radii.1", 0.0, "0 m", "model.above"),
        ("kind: rolling, ratio: -0.5", "m.ratio", 0.5, "0.5", "joints.same_sign"),
        ("kind: gear, ratio: 3", "m.ratio", 0.0, "0", "model.not_zero"),
        ("kind: gear, ratio: -2", "m.pressure_angle", 1.6, "1.6 rad", "model.from_to_below"),
    ],
)
def test_sizes_that_a_file_may_not_give_are_refused_in_code(
    kind: str, address: str, value: float, given: str, limit: str
) -> None:
    mechanism = lw.loads(two_wheels(kind))
    with refused("model.set_outside", address=address, value=given, limit=limit):
        mechanism.with_dimensions({address: value})
    kept = mechanism.with_dimensions({address: 1.1 * mechanism.dimension(address)})
    assert kept.dimension(address) == pytest.approx(1.1 * mechanism.dimension(address))


def test_rolling_wheels_have_no_pressure_angle() -> None:
    own = {"m.radii.0", "m.radii.1", "m.phase"}
    mechanism = lw.loads(two_wheels("kind: rolling, radii: [20 mm, 40 mm]"))
    assert {each for each in mechanism.dimensions() if each.startswith("m.")} == own
    sizes = wheel_sizes(mechanism.joints["m"], mechanism)
    assert sizes is not None and sizes.pressure_angle is None and sizes.module is None


@pytest.mark.parametrize(
    ("kind", "radii", "key", "shown", "fault"),
    [
        ("rolling", "[20 mm, -40 mm]", "joints.m.radii.1", "-40 mm", "model.negative"),
        ("belt", "[0 mm, 40 mm]", "joints.m.radii.0", "0 mm", "model.zero"),
    ],
)
def test_the_radius_that_is_none_is_named(kind: str, radii: str, key: str, shown: str, fault: str) -> None:
    (found,) = findings(two_wheels(f"kind: {kind}, radii: {radii}"))
    said([found], "range", key, shown=shown, fault=fault, limit="{noun} above {limit}", noun="a length")


def test_wheels_that_are_never_back_run_no_flywheel() -> None:
    """No cycle of 1009 and 2003 teeth is short enough; other teeth are, as told."""
    text = """
format: 1
name: Hunting teeth
frame: {points: {O: [0 mm, 0 mm], P: [100 mm, 0 mm]}}
links:
  a: {points: [O], inertia: 1 kg·m²}
  b: {points: [P]}
joints: {mesh: {kind: gear, links: [a, b], teeth: [1009, 2003]}}
driver: {turn: a, about: O, speed: 60 rpm}
loads: {m: {kind: torque, on: b, magnitude: 5 N·m}}
"""
    for cycle in ("", "cycle: {turns: 3}\n"):
        with refused("running.never_back", name="Hunting teeth", most=1000):
            steady_running(lw.solve_forces(lw.loads(text + cycle), steps=36), fluctuation=0.05)
    whole = lw.solve_forces(lw.loads(text.replace("[1009, 2003]", "[20, 40]")), steps=36)
    assert steady_running(whole, fluctuation=0.05).mean_torque == pytest.approx(2.5)  # 5 N·m · 20/40


@pytest.mark.parametrize(("inertia", "unlikely"), [("0.5", False), ("6", True)])
def test_a_crank_with_a_pulley_is_as_large_as_the_pulley(inertia: str, unlikely: bool) -> None:
    """20 kg within the pulley's 240 mm have 1.15 kg·m² at most; the crank itself is 60 mm long."""
    text = f"""
format: 1
frame: {{points: {{M: [-500 mm, 0 mm], O: [0 mm, 0 mm]}}}}
links:
  motor: {{points: [M]}}
  crank: {{points: [O, A], length: 60 mm, mass: 20 kg, inertia: {inertia} kg·m²}}
joints: {{belt: {{kind: belt, links: [motor, crank], radii: [60 mm, 240 mm]}}}}
driver: {{turn: motor, about: M, speed: 1440 rpm}}
"""
    found = [each for each in findings(text) if each.code == "unlikely"]
    assert [each.key for each in found] == ["links.crank.inertia"] * unlikely
    assert all(each.values["size"] == "0.24" for each in found)


@pytest.mark.parametrize(("base", "cut"), [("24", True), ("25", False)])
def test_check_warns_of_a_cam_that_its_follower_cuts_away(base: str, cut: bool, tmp_path: Path) -> None:
    """The radius of curvature of a flat-faced cam is r_b + s + s″: of a cycloidal rise h over β it is least where
    h(u - sin(2πu)/2π) + 2πh sin(2πu)/β² is, -24.6 mm for 15 mm over 90°."""
    u = np.linspace(0.0, 1.0, 10001)
    sine = np.sin(2 * np.pi * u)
    least = (15.0 * (u - sine / (2 * np.pi)) + 2 * np.pi * 15.0 * sine / (np.pi / 2) ** 2).min()
    assert bool(float(base) + least < 0.0) == cut
    file = tmp_path / "cam.yaml"
    file.write_text(
        f"""
format: 1
frame: {{points: {{O: [0 mm, 0 mm]}}}}
links: {{cam: {{points: [O]}}, slide: {{points: [P], mass: 1 kg}}}}
joints:
  way: {{kind: prismatic, guide: frame, through: O, direction: 90 deg, block: slide, at: P, block_angle: 90 deg}}
  lobe:
    {{kind: cam, cam: cam, follower: slide, at: P, touch: flat, base_radius: {base} mm, program: [
    {{rise: 15 mm, over: 90 deg, law: cycloidal}}, {{dwell: 90 deg}}, {{fall: 15 mm, over: 180 deg}}]}}
driver: {{turn: cam, about: O, speed: 300 rpm}}
""",
        encoding="utf-8",
    )
    code, found = checked(file)
    assert code == 0
    assert ("warning", "joints.lobe.base_radius") in {(each.severity, each.key) for each in found} or not cut
    assert cut or not [each for each in found if each.key == "joints.lobe.base_radius"]


@pytest.mark.parametrize(
    ("right", "wrong", "key"),
    [
        ("M: [-500 mm", "M: [-500", "frame.points.M.x"),
        ("O: [0 mm", "O: [0 mmm", "frame.points.O.x"),
        ("240 mm]", "900 mm]", "joints.belt.radii"),
        ("[motor, crank]", "[motor, cranc]", "joints.belt.links.1"),
    ],
)
def test_a_pulley_that_cannot_be_placed_is_told_beside_an_unlikely_inertia(right: str, wrong: str, key: str) -> None:
    """How large the crank is cannot be known then; what is wrong of the belt is."""
    text = """
format: 1
frame: {points: {M: [-500 mm, 0 mm], O: [0 mm, 0 mm]}}
links:
  motor: {points: [M]}
  crank: {points: [O, A], length: 60 mm, mass: 20 kg, inertia: 6 kg·m²}
joints: {belt: {kind: belt, links: [motor, crank], radii: [60 mm, 240 mm]}}
driver: {turn: motor, about: M, speed: 1440 rpm}
"""
    found = findings(text.replace(right, wrong))
    assert key in [each.key for each in found if each.severity == "error"]


@pytest.mark.parametrize("links", ["[ring, frame]", "[frame, ring]"])
def test_a_ring_that_is_welded_to_the_frame_is_named_as_the_frame(links: str) -> None:
    """Sun of 40, planet of 20, ring of 80 teeth: a third of the sun's speed with the ring at rest."""
    text = f"""
format: 1
frame: {{points: {{O: [0 mm, 0 mm]}}}}
links:
  sun: {{points: [O]}}
  ring: {{points: [O]}}
  arm: {{points: {{O: [0 mm, 0 mm], P: [60 mm, 0 mm]}}}}
  planet: {{points: [P]}}
joints:
  fix: {{kind: weld, links: {links}, at: O}}
  g1: {{kind: gear, links: [sun, planet], teeth: [40, 20], module: 2 mm}}
  g2: {{kind: gear, links: [ring, planet], teeth: [80, 20], module: 2 mm, mesh: internal}}
driver: {{turn: sun, about: O, speed: 3 rad/s}}
"""
    said(
        findings(text),
        "reference",
        "joints.g2.links",
        remedy='"{wheel}" is welded to "{tied}": name "{tied}" in its place',
        wheel="ring",
        tied="frame",
    )
    motion = lw.solve_motion(lw.loads(text.replace("[ring, planet]", "[frame, planet]")), steps=4)
    assert motion.link("arm").angular_velocity == pytest.approx([1.0] * 4, rel=1e-12)


@pytest.mark.parametrize(
    ("kind", "severity"),
    [
        ("kind: gear, teeth: [20, 40], module: 2.01 mm", "warning"),
        ("kind: gear, teeth: [20, 40], module: 2.04 mm", "error"),
        ("kind: gear, radii: [20.1 mm, 40.2 mm]", "error"),
    ],
)
def test_teeth_within_their_clearance_are_read_with_a_warning(kind: str, severity: str) -> None:
    """0.3 mm off is less than a quarter of the module, 1.2 mm is more; pitch radii have no clearance. So does the
    solver take them."""
    (found,) = findings(two_wheels(kind))
    said(
        [found],
        "range",
        message=(
            "the distance of the centres {centres} on {carrier!r} is {distance}, but the {mesh} pair needs {wanted}"
        ),
        mesh="external",
    )
    assert found.severity == severity
    if severity == "warning":
        assert lw.solve_motion(lw.loads(two_wheels(kind)), steps=4).ok.all()
    else:
        with refused("range", lw.ModelError, mesh="external"):
            lw.loads(two_wheels(kind))

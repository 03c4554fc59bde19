"""Parts to make: they stack up without gaps, weigh what the model says, and do not collide over the cycle."""

import math
from collections.abc import Iterator, Mapping
from functools import cache
from itertools import combinations

import pytest
import shapely
import shapely.affinity
from tests import store

import linkwright as lw
from linkwright.fabrication.outlines import outline
from linkwright.kinematics.placement import Placement, placements
from linkwright.shapes.loop import circle

CONSTRUCTION = """
construction:
  {{material: acrylic, thickness: 3 mm, width: 8 mm, pin_radius: 1.5 mm, washer: 0.5 mm, fit: {fit}}}
"""


@cache
def made(name: str, fit: str = "0 mm") -> lw.CutParts:
    """The parts of a gallery machine as it is, or with a section ``construction`` where a fit is given."""
    text = store.text(name)
    return lw.cut_parts(lw.loads(text if fit == "" else text + CONSTRUCTION.format(fit=fit)))


@pytest.mark.parametrize(
    ("name", "fit"), [("theo_jansen_leg", "0.1 mm"), ("slider_crank_offset", ""), ("shaper_quick_return", "")]
)
def test_plates_spacers_and_washers_fill_their_pins(name: str, fit: str) -> None:
    """From the lower to the upper end of every pin there is a plate, a spacer or a washer everywhere."""
    parts = made(name, fit).parts
    for pin in (each for each in parts if each.sort == "pin" and each.name.startswith("pin ")):
        low = pin.places[0].z
        stack = [(each.places[0].z, each.length) for each in parts if pin.name in {hole.pin for hole in each.holes}]
        stack += [(at.z, each.length) for each in parts if each.bore for at in each.places if at.on == pin.name]
        reached = low
        for z, length in sorted(stack):
            assert z == pytest.approx(reached, abs=1e-9)
            reached = z + length
        assert reached == pytest.approx(low + pin.length, abs=1e-9)


def test_links_weigh_what_their_shapes_give_the_model() -> None:
    """``mass: from shape`` and the list of parts agree; pins are of steel."""
    text = store.text("theo_jansen_leg") + CONSTRUCTION.format(fit="0 mm")
    weighed = lw.loads(text.replace("links:\n", "links:\n").replace("crank: {", "crank: {mass: from shape, "))
    found = made("theo_jansen_leg", "0 mm")
    assert found["crank"].mass == pytest.approx(weighed.link("crank").mass, rel=1e-12)
    length = math.dist(*weighed.link("tie").points.values())
    area = 8e-3 * length + math.pi * (4e-3**2 - 2 * 1.5e-3**2)
    assert found["tie"].mass == pytest.approx(1190 * 3e-3 * area, rel=1e-12)
    pin = found["pin X"]
    assert pin.material == "steel"
    heads = sum(pin.heads) * (0.5 * pin.head) ** 2
    assert pin.mass == pytest.approx(7850 * math.pi * (1.5e-3**2 * pin.length + heads), rel=1e-12)


Body = tuple[str, str, float, float, shapely.Geometry]


def bodies(found: lw.CutParts) -> Iterator[Body]:
    """Name, carrier, heights and polygon in the carrier's axes of everything that is made."""
    for part in found.parts:
        for prism in part.prisms():
            loops = [*outline(prism.shape), *(circle(*hole) for hole in prism.shape.holes)]
            rings = [loop.points(1e-6) for loop in loops]
            for place in part.places:
                moved = [shapely.Polygon([(z.real, z.imag) for z in ring + place.at]) for ring in rings]
                moved.sort(key=lambda ring: -ring.area)
                polygon = moved[0].difference(shapely.union_all(moved[1:]))
                yield part.name, place.carrier, place.z + prism.low, place.z + prism.high, polygon


@pytest.mark.parametrize(("name", "fit"), [("theo_jansen_leg", "0.1 mm"), ("shaper_quick_return", "")])
def test_nothing_that_is_made_collides_over_the_cycle(name: str, fit: str) -> None:
    """Shapely finds no overlap of what lies at one height and does not move as one; arcs are chords 1 µm off."""
    found = made(name, fit)
    placed = placements(lw.solve_motion(found.mechanism, steps=8))
    every = [*bodies(found)]
    pairs = [(a, b) for a, b in combinations(every, 2) if a[1] != b[1] and min(a[3], b[3]) - max(a[2], b[2]) > 1e-9]
    assert len(pairs) > 20
    for index in range(8):
        at = {id(each): moved(placed, each, index) for each in every}
        for one, other in pairs:
            overlap = at[id(one)].intersection(at[id(other)]).area
            assert overlap < 1e-6 * one[4].length, (one[0], other[0], index)


def moved(placed: Mapping[str, Placement], body: Body, index: int) -> shapely.Geometry:
    """The polygon of a body at a position."""
    (c, s), (x, y) = placed[body[1]].direction[index], placed[body[1]].origin[index]
    return shapely.affinity.affine_transform(body[4], [c, -s, s, c, x, y])


def test_a_block_has_the_fit_as_play_in_its_slot() -> None:
    """The slot of the gallery's plate linkage is as wide as the slider by rule, 24 mm; the fit is 0.1 mm."""
    found = lw.cut_parts(store.machine("plate_linkage"))
    low, high = found["slider"].edge[0].box
    (slot,) = [loop for loop in found["guide slide"].edge if loop.area < 0.0]
    assert (high - low).imag == pytest.approx(23.9e-3, abs=1e-12)
    assert (slot.box[1] - slot.box[0]).imag == pytest.approx(24e-3, abs=1e-12)


CAM = """
format: 1
name: cam with a roller
frame: {points: {O: [0 mm, 0 mm]}}
links:
  shaft: {points: [O], also: {K: [10 mm, 0 mm]}}
  follower: {points: [R], also: {T: [120 mm, 0 mm]}}
joints:
  slide: {kind: prismatic, guide: frame, through: O, direction: 90 deg, block: follower, at: R}
  contact: {kind: cam, cam: shaft, follower: follower, at: R, touch: roller, base_radius: 40 mm, roller_radius: 10 mm,
    program: [{rise: 20 mm, over: 180 deg, law: cycloidal}, {fall: 20 mm, over: 180 deg, law: cycloidal}]}
driver: {turn: shaft, about: O, speed: 60 rpm}
construction: {thickness: 8 mm, width: 16 mm, pin_radius: 4 mm, fit: 0.1 mm}
"""


def test_a_roller_turns_on_its_pin() -> None:
    """The pin, half as thick as the roller, is pressed into the follower; the roller has the fit of 0.1 mm."""
    found = lw.cut_parts(lw.loads(CAM))
    (hole,) = found["roller follower"].holes
    assert not hole.fixed and hole.radius == pytest.approx(0.004 + 0.00005)
    (held,) = [each for each in found["follower"].holes if each.pin == hole.pin]
    assert held.fixed and held.radius == pytest.approx(0.004)


def test_a_block_in_the_slot_of_a_lever_is_no_cylinder() -> None:
    assert not [note for note in made("shaper_quick_return", "").notes if "barrel" in str(note)]

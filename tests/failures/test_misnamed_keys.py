"""Keys under other names: one finding each, and the findings of what stands under them."""

from __future__ import annotations

import pytest
from tests import store
from tests.refusals import said

import linkwright as lw
from linkwright import gallery, parts

MODEL = """
format: 1
frame: {points: {A: [0 m, 0 m], D: [1 m, 0 m]}}
links:
  crank: {points: [A, B], length: 0.3 m}
  coupler: {points: [B, C], length: 0.9 m, mass: 1 kg, inertia: 0.1 kg·m²}
  rocker: {points: [D, C], length: 0.7 m}
driver: {turn: crank, about: A, speed: 60 rpm}
assembly: {C: left}
loads: {push: {kind: force, on: rocker, at: C, magnitude: 3 kN, direction: 180 deg}}
"""


@pytest.mark.parametrize(
    ("key", "wrong"),
    [
        ("frame", "ground"),
        ("links", "link"),
        ("points", "point"),
        ("length", "lenght"),
        ("driver", "drive"),
        ("turn", "tuurn"),
        ("speed", "speeds"),
        ("about", "abuot"),
        ("loads", "forces"),
        ("kind", "type"),
        ("magnitude", "magnitud"),
        ("frame", "机架"),
        ("links", "构件"),
        ("length", "长度"),
        ("driver", "原动件"),
        ("speed", "转速"),
        ("loads", "载荷"),
        ("kind", "类型"),
        ("magnitude", "大小"),
        ("length", "l"),
        ("speed", "n"),
        ("speed", "omega"),
        ("speed", "角速度"),
        ("loads", "torques"),
        ("driver", "motor"),
    ],
)
def test_a_key_that_is_nearly_known_is_one_finding(key: str, wrong: str) -> None:
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(MODEL.replace(f"{key}:", f"{wrong}:", 1))
    (finding,) = refused.value.findings
    said([finding], "unknown-key", key_=wrong, offer=key)


SLIDE = """
format: 1
frame: {points: {O: [0 m, 0 m]}}
links: {block: {points: [B], mass: 1 kg}}
joints: {way: {kind: prismatic, guide: frame, through: O, direction: 0 deg, block: block, at: B, offset: 3 mm}}
driver: {slide: way, speed: 1 m/s}
loads: {gust: {kind: pressure, joint: way, area: 1 m², pushes: forward, magnitude: 3 Pa}}
"""


@pytest.mark.parametrize(
    ("kind", "habit"),
    [
        ("prismatic", "slider"),
        ("prismatic", "rail"),
        ("prismatic", "滑块"),
        ("prismatic", "移动副"),
        ("prismatic", "cylinder"),
        ("pressure", "gas"),
        ("pressure", "液压"),
    ],
)
def test_a_kind_by_habit_is_pointed_to_the_right_word_and_the_rest_is_checked(kind: str, habit: str) -> None:
    text = SLIDE.replace(f"kind: {kind}", f"kind: {habit}").replace("1 m²", "1").replace("offset: 3 mm", "offset: 3")
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(text)
    first, *others = sorted(refused.value.findings, key=lambda each: each.code, reverse=True)
    said([first], "unknown-word", text=habit, offer=kind)
    assert [each.key for each in others] == ["joints.way.offset", "loads.gust.area"]


@pytest.mark.parametrize(
    ("load", "key", "habit"),
    [
        ("{kind: spring, between: [frame.A, rocker.C], k: 5 N/mm}", "stiffness", "k"),
        ("{kind: spring, between: [frame.A, rocker.C], 刚度: 5 N/mm}", "stiffness", "刚度"),
        ("{kind: spring, between: [frame.A, rocker.C], stiffness: 5 N/mm, l0: 1 m}", "free_length", "l0"),
        ("{kind: damper, between: [frame.A, rocker.C], c: 5 N·s/m}", "damping", "c"),
    ],
)
def test_symbols_of_books_are_pointed_to_the_key(load: str, key: str, habit: str) -> None:
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(f"{MODEL.partition('loads:')[0]}loads: {{push: {load}}}")
    (finding,) = refused.value.findings
    said([finding], "unknown-key", f"loads.push.{habit}", offer=key)


@pytest.mark.parametrize(("key", "habit"), [("links", "wheels"), ("teeth", "z"), ("teeth", "齿数")])
def test_symbols_of_wheels_are_pointed_to_the_key(key: str, habit: str) -> None:
    wheel = "joints: {mesh: {kind: gear, links: [crank, rocker], teeth: [20, 30]}}"
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(MODEL + wheel.replace(key, habit, 1))
    (finding,) = refused.value.findings
    said([finding], "unknown-key", f"joints.mesh.{habit}", offer=key)


@pytest.mark.parametrize(("habit", "kind"), [("hinge", "revolute"), ("铰", "revolute"), ("rigid", "weld")])
def test_other_habits_of_joints_are_pointed_to_the_right_word(habit: str, kind: str) -> None:
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(f"{MODEL}joints: {{C: {{kind: {habit}}}}}")
    said(refused.value.findings, "unknown-word", "joints.C.kind", offer=kind)


@pytest.mark.parametrize(
    ("kind", "section"), [("gravity", "gravity:"), ("weight", "gravity:"), ("friction", "joints")]
)
def test_what_is_no_kind_of_load_is_told_where_it_stands(kind: str, section: str) -> None:
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(MODEL.replace("kind: force", f"kind: {kind}"))
    (finding,) = refused.value.findings
    said([finding], "unknown-word", "loads.push.kind", text=kind)
    assert section in finding.remedy


@pytest.mark.parametrize("section", ["sliders", "hinges", "gears", "运动副"])
def test_a_section_by_habit_is_pointed_to_the_right_one(section: str) -> None:
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(SLIDE.replace("joints:", f"{section}:"))
    (finding,) = refused.value.findings
    said([finding], "unknown-key", section, offer="joints")


def test_a_key_that_only_looks_a_little_alike_is_offered_and_not_read() -> None:
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(MODEL.replace("length: 0.3 m", "length: 0.3 m, image: steel"))
    (finding,) = refused.value.findings
    said([finding], "unknown-key", "links.crank.image", offer="angle")


@pytest.mark.parametrize(
    ("right", "wrong"), [("head: {points", "head: {poits"), ("floor: {kind", "floor: {kin"), ("{slide:", "{slides:")]
)
def test_names_that_others_refer_to_are_known_under_misnamed_keys(right: str, wrong: str) -> None:
    text = store.text("double_slider")
    assert right in text
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(text.replace(right, wrong, 1))
    assert [each.code for each in refused.value.findings] == ["unknown-key"]


@pytest.mark.parametrize(
    ("name", "right", "wrong"),
    [
        ("lightest_spring", "parameters:", "parameterss:"),
        ("lightest_spring", "D: {from:", "D: {frm:"),
        ("lightest_spring", "n: {from:", "n: {from: 1 apple, start:"),
        ("shaft_diameters", "values:", "valuess:"),
    ],
)
def test_calculations_too(name: str, right: str, wrong: str) -> None:
    """What follows from a variable that is wrong itself is not told beside it."""
    text = gallery.file(name).read_text(encoding="utf-8")
    assert right in text
    with pytest.raises(lw.ModelError) as refused:
        parts.loads(text.replace(right, wrong, 1))
    assert len(refused.value.findings) == 1


def test_what_stands_under_misnamed_keys_is_checked_with_the_rest() -> None:
    text = MODEL.replace("links:", "构件:").replace("length: 0.9 m", "长度: 0.9")
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(text)
    assert [each.code for each in refused.value.findings] == ["unknown-key", "unknown-key", "missing-unit"]


def test_a_key_that_is_there_is_not_taken_from_another() -> None:
    text = MODEL.replace("length: 0.3 m", "length: 0.3 m, lenght: 5 kg")
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(text)
    assert [each.code for each in refused.value.findings] == ["unknown-key"]

"""Sections and elements at another level than their own: one finding each, and those of what stands in them."""

from __future__ import annotations

import pytest
from tests.refusals import said

import linkwright as lw
from linkwright import Finding

MODEL = """
format: 1
frame: {points: {A: [0 m, 0 m], D: [1 m, 0 m], G: [0 m, 1 m]}}
links:
  crank: {points: [A, B], length: 0.3 m}
  coupler: {points: [B, C], length: 0.9 m}
  rocker: {points: [D, C], length: 0.7 m}
joints:
  C: {kind: revolute, friction: 0.1, pin_radius: 5 mm}
assembly: {C: left}
driver: {turn: crank, about: A, speed: 60 rpm}
loads:
  push: {kind: force, on: rocker, at: C, magnitude: 3 kN, direction: 180 deg}
"""


def findings(text: str) -> list[Finding]:
    with pytest.raises(lw.ModelError) as refused:
        lw.loads(text)
    return list(refused.value.findings)


def changed(*pairs: tuple[str, str]) -> str:
    text = MODEL
    for old, new in pairs:
        assert old in text
        text = text.replace(old, new, 1)
    return text


def test_the_model_is_right_as_it_stands() -> None:
    lw.loads(MODEL)


@pytest.mark.parametrize(
    ("line", "section"), [("  rocker: {", "links"), ("  C: {kind", "joints"), ("  push: {", "loads")]
)
def test_an_element_beside_its_section_is_one_finding(line: str, section: str) -> None:
    (found,) = findings(changed((line, line.lstrip())))
    said(
        [found],
        "misplaced",
        message='"{name}" is at the level of the section "{section}", not in it',
        name=line.split(":", maxsplit=1)[0].strip(),
        section=section,
    )


@pytest.mark.parametrize("section", ["joints", "assembly", "driver", "loads"])
def test_a_section_within_another_one_is_one_finding(section: str) -> None:
    head, _, rest = MODEL.partition("\njoints:")
    indented = "\n".join(f"  {line}" if line else line for line in f"joints:{rest}".splitlines())
    told = findings(f"{head}\n{indented}\n")
    assert [each.key for each in told] == [f"links.{each}" for each in ("joints", "assembly", "driver", "loads")]
    said(
        told,
        "misplaced",
        f"links.{section}",
        message='the section "{section}" is inside "{within}"',
        section=section,
        within="links",
    )


@pytest.mark.parametrize("indent", [None, "", "  ", "    "])
@pytest.mark.parametrize(("section", "within"), [("links", "frame"), ("joints", "links"), ("loads", "drivers")])
def test_the_line_of_a_section_that_is_missing_or_indented_is_one_finding(
    section: str, within: str, indent: str | None
) -> None:
    """What stood below it is read where it belongs."""
    text = MODEL.replace("driver: {turn", "driver:\n  motor: {turn").replace("driver:", "drivers:")
    text = text.replace("frame: {points: {A", "frame:\n  points: {A").replace("1 m]}}", "1 m]}")
    line = "" if indent is None else f"{indent}{section}:\n"
    broken = text.replace(f"{section}:\n", line)
    if indent == "":
        lw.loads(broken)
    elif indent == "    ":
        assert {each.code for each in findings(broken)} == {"syntax"}
    else:
        (found,) = findings(broken)
        message = (
            '"{within}" contains what belongs in "{section}": {names}'
            if indent is None
            else 'the section "{section}" is inside "{within}"'
        )
        said([found], "misplaced", message=message, section=section, within=within)


def test_elements_in_each_other_s_sections_are_told_with_their_names() -> None:
    """Joints, loads and drivers tell by their kinds and keys what they are."""
    model = changed(
        ("  C: {kind: revolute, friction: 0.1, pin_radius: 5 mm}\n", ""),
        ("assembly", "  push: {kind: force, on: rocker, at: C, magnitude: 3 kN, direction: 180 deg}\nassembly"),
        ("loads:\n  push", "loads:\n  C: {kind: revolute, friction: 0.1, pin_radius: 5 mm}\n  pull"),
    )
    told = findings(model)
    assert [(each.key, each.code) for each in told] == [("joints.push", "misplaced"), ("loads.C", "misplaced")]
    said(told, "misplaced", "joints.push", names=("push",), section="loads", within="joints")


@pytest.mark.parametrize("section", ["links", "joints", "loads", "frame"])
def test_a_line_of_a_section_twice_is_one_finding(section: str) -> None:
    model = MODEL.replace("frame: {points", "frame:\n  points").replace("1 m]}}", "1 m]}")
    (found,) = findings(model.replace(f"{section}:\n", f"{section}:\n{section}:\n"))
    assert found.code == "duplicate-key"


def test_elements_may_have_names_of_sections() -> None:
    model = lw.loads(
        changed(("  coupler: {points", "  drawing: {points"), ("driver: {turn", "drivers: {driver: {turn"))
        .replace("60 rpm}", "60 rpm}}")
        .replace("push:", "assembly:")
    )
    assert "drawing" in model.links and "driver" in model.drivers and "assembly" in model.loads


@pytest.mark.parametrize("form", ["- {{name: {name}, ", "- {name}: {{"])
def test_a_list_of_links_is_one_finding(form: str) -> None:
    names = ("crank", "coupler", "rocker")
    (found,) = findings(changed(*((f"{name}: {{", form.format(name=name)) for name in names)))
    said([found], "type", "links", message='"{section}" is a list; expected a mapping with each entry under its name')
    assert "crank: {" in found.remedy


def test_what_stands_in_a_list_of_links_is_checked_with_the_rest() -> None:
    listed = tuple((f"{name}: {{", f"- {{name: {name}, ") for name in ("crank", "coupler", "rocker"))
    told = findings(changed(*listed, ("0.9 m", "0.9")))
    assert [each.code for each in told] == ["type", "missing-unit"]


def test_links_without_names_are_one_finding() -> None:
    without = tuple((f"{name}: {{", "- {") for name in ("crank", "coupler", "rocker"))
    (found,) = findings(changed(*without))
    assert found.key == "links"


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("frame: {points: {A: [0 m, 0 m], D: [1 m, 0 m], G: [0 m, 1 m]}}\n", ""),
        ("rocker: {points: [D, C], ", "rocker: {"),
        ("points: [B, C]", "points: [B, B]"),
    ],
)
def test_points_that_cannot_be_read_are_missed_once(old: str, new: str) -> None:
    assert len(findings(changed((old, new)))) == 1

"""Beams and links that cannot be calculated say why, with the motion that is left."""

import re
from importlib.resources import files
from pathlib import Path

import pytest

import linkwright as lw
from linkwright import parts
from linkwright.parts.file import check as parts_check

STEEL, SECTION = parts.Material(210e9), parts.Section(1e-6)


def refusal(supports: dict, **given: object) -> str:
    held = {name: parts.BeamSupport(*each) for name, each in supports.items()}
    with pytest.raises(lw.ModelError) as error:
        parts.Beam(2.0, STEEL, SECTION, held, **given).solve()  # type: ignore[arg-type]
    assert error.value.say("zh") != str(error.value)
    return str(error.value)


@pytest.mark.parametrize(
    ("supports", "given", "words"),
    [
        ({}, {}, ["move up and down", "turn about x = 0 mm"]),
        ({"A": ("pinned", 0.5)}, {}, ["turn about x = 500 mm"]),
        ({"A": ("guided", 0.0)}, {}, ["move up and down"]),
        ({"A": ("pinned", 0.0), "B": ("roller", 2.0)}, {"hinges": (1.0,)}, ["fold at the hinge at 1000 mm"]),
        ({"A": ("pinned", 2.5), "B": ("roller", 0.0)}, {}, ["2500 mm lies outside the beam"]),
        ({"A": ("spring", 0.0), "B": ("fixed", 1.0)}, {}, ["the spring has no stiffness"]),
        ({"A": ("fixed", 0.0)}, {"loads": {"P": parts.BeamLoad(force=1.0)}}, ["neither complete nor unique"]),
        (
            {"A": ("fixed", 0.0)},
            {"loads": {"q": parts.BeamLoad(line=(1.0,), start=1.0, end=0.5)}},
            ["ends where"],
        ),
        ({"A": ("fixed", 0.0)}, {"own_weight": True}, ["needs the material's density"]),
        ({"A": ("fixed", 0.0)}, {"safety": 2.0}, ["has no strength"]),
    ],
)
def test_beams(supports: dict, given: dict, words: list[str]) -> None:
    text = refusal(supports, **given)
    assert all(each in text for each in words)
    assert len(text.splitlines()) == len(words)


def test_all_findings_of_a_file_with_their_places() -> None:
    text = """format: 1
kind: beam
length: 2 m
material: S236
section: {rectangle: [20 mm, 40 mm], circle: [3 mm]}
supports: {A: {kind: fixd, at: 0 m}}
loads: {P: {force: 2 kN, at: 1,5 m}}
"""
    found = parts.check(write(text))
    assert [each.where.split(":")[1] for each in found] == ["4", "5", "6", "7"]
    assert 'did you mean "S235"?' in str(found[0]) and "2 shapes of the section" in str(found[1])


def write(text: str) -> str:
    import tempfile
    from pathlib import Path

    path = Path(tempfile.mkdtemp()) / "beam.yaml"
    path.write_text(text, encoding="utf-8")
    return str(path)


@pytest.mark.parametrize(
    ("link", "words"),
    [
        ("bar", 'there is no link "bar"'),
        ("slider", "has no length"),
        ("rocker", "do not lie on its axis (C)"),
    ],
)
def test_links(link: str, words: str) -> None:
    mechanism = lw.load("gallery:swing_conveyor")
    if link == "rocker":
        mechanism = mechanism.with_dimensions({"rocker.C.y": 0.05})
    problem = parts.LinkBending(mechanism, link, STEEL, parts.Section(1e-6, 1e-3, 1e-5))
    with pytest.raises(lw.ModelError) as error:
        problem.solve()
    assert words in str(error.value)


def test_stress_needs_the_whole_section() -> None:
    problem = parts.LinkBending(lw.load("gallery:crank_rocker"), "coupler", STEEL, SECTION)
    with pytest.raises(lw.ModelError, match="area and modulus"):
        problem.solve()


@pytest.mark.parametrize(
    ("axis", "words"),
    [
        (("A", "Q"), "cannot run through Q"),
        (("A", "B", "A"), "each once"),
        (("A",), "two or more"),
    ],
)
def test_an_axis_runs_through_points_of_the_link(axis: tuple[str, ...], words: str) -> None:
    mechanism, section = lw.load("gallery:crank_rocker"), parts.Section(1e-6, 1e-3, 1e-5)
    problem = parts.LinkBending(mechanism, "coupler", STEEL, section, axis=axis)
    with pytest.raises(lw.ModelError, match=words):
        problem.solve()


def test_a_mechanism_whose_file_is_not_there_is_a_finding_of_the_calculation(tmp_path: Path) -> None:
    text = (files("linkwright.gallery") / "parts/pitman_bending.yaml").read_text("utf-8")
    file = tmp_path / "bending.yaml"
    file.write_text(re.sub("(?m)^mechanism: .*", "mechanism: nowhere.yaml", text))
    (missing,) = parts_check(file)
    assert (missing.where, missing.key, missing.code) == ("bending.yaml:6:12", "mechanism", "reference")
    assert "nowhere.yaml: there is no such file" in str(missing)


@pytest.mark.parametrize(
    "shape",
    [
        "box: [120 mm, 0 mm, 12 mm]",
        "tube: [0 mm, 2 mm]",
        "circle: [0 mm]",
        "tube: [40 mm, 25 mm]",
        "box: [40 mm, 80 mm, 21 mm]",
        "i_beam: [80 mm, 40 mm, 50 mm, 5 mm]",
        "i_beam: [80 mm, 40 mm, 5 mm, 41 mm]",
    ],
)
def test_a_section_without_height_is_a_finding(tmp_path: Path, shape: str) -> None:
    text = (files("linkwright.gallery") / "parts/pitman_bending.yaml").read_text("utf-8")
    file = tmp_path / "bending.yaml"
    file.write_text(re.sub("(?m)^section: .*", f"section: {{{shape}}}", text))
    (found,) = parts_check(file)
    assert (found.where, found.key, found.code) == ("bending.yaml:9:10", "section", "range")
    assert "these dimensions make no section; give lengths above zero" in str(found)

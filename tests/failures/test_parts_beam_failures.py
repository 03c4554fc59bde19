"""Beams and links that cannot be calculated say why, with the motion that is left."""

import re
from importlib.resources import files
from pathlib import Path

import pytest
from tests import store
from tests.refusals import faulty, said

import linkwright as lw
from linkwright import parts

STEEL, SECTION = parts.Material(210e9), parts.Section(1e-6)


def told(supports: dict, **given: object) -> list[lw.Finding]:
    """What is found of a beam on these supports, which cannot be calculated."""
    held = {name: parts.BeamSupport(*each) for name, each in supports.items()}
    with pytest.raises(lw.ModelError) as caught:
        parts.Beam(2.0, STEEL, SECTION, held, **given).solve()  # type: ignore[arg-type]
    return list(caught.value.findings)


@pytest.mark.parametrize(
    ("supports", "given", "found"),
    [
        (
            {},
            {},
            [
                ("can_move", {"how": "turn about x = {place}", "place": "0 mm"}),
                ("can_move", {"how": "move up and down"}),
            ],
        ),
        ({"A": ("pinned", 0.5)}, {}, [("can_move", {"how": "turn about x = {place}", "place": "500 mm"})]),
        ({"A": ("guided", 0.0)}, {}, [("can_move", {"how": "move up and down"})]),
        (
            {"A": ("pinned", 0.0), "B": ("roller", 2.0)},
            {"hinges": (1.0,)},
            [("can_move", {"how": "fold at the hinge at {places}", "places": ("1000 mm",)})],
        ),
        ({"A": ("pinned", 2.5), "B": ("roller", 0.0)}, {}, [("outside", {"x": "2500 mm", "length": "2000 mm"})]),
        ({"A": ("spring", 0.0), "B": ("fixed", 1.0)}, {}, [("no_stiffness", {})]),
        ({"A": ("fixed", 0.0)}, {"loads": {"P": parts.BeamLoad(force=1.0)}}, [("load_form", {})]),
        (
            {"A": ("fixed", 0.0)},
            {"loads": {"q": parts.BeamLoad(line=(1.0,), start=1.0, end=0.5)}},
            [("empty_line", {})],
        ),
        ({"A": ("fixed", 0.0)}, {"own_weight": True}, [("no_weight", {})]),
        ({"A": ("fixed", 0.0)}, {"safety": 2.0}, [("no_strength", {})]),
    ],
)
def test_beams(supports: dict, given: dict, found: list[tuple[str, dict]]) -> None:
    for each, (code, values) in zip(told(supports, **given), found, strict=True):
        said([each], code, **values)


def test_all_findings_of_a_file_with_their_places(tmp_path: Path) -> None:
    text = """format: 1
kind: beam
length: 2 m
material: S236
section: {rectangle: [20 mm, 40 mm], circle: [3 mm]}
supports: {A: {kind: fixd, at: 0 m}}
loads: {P: {force: 2 kN, at: 1,5 m}}
"""
    file = tmp_path / "beam.yaml"
    file.write_text(text, encoding="utf-8")
    found = lw.check(file)
    assert [each.where.split(":")[1] for each in found] == ["4", "5", "6", "7"]
    said(found, "unknown-name", "material", name="S236", offer="S235")
    said(found, "choice", "section", message="{count} shapes of the section are given", count=2)
    said(found, "unknown-word", "supports.A.kind", offer="fixed")
    said(found, "decimal-comma", "loads.P.at", right="1.5 m")


@pytest.mark.parametrize(
    ("link", "code", "values"),
    [
        ("bar", "no_link", {"link": "bar"}),
        ("slider", "one_point", {"link": "slider"}),
        ("rocker", "crooked", {"names": "C"}),
    ],
)
def test_links(link: str, code: str, values: dict[str, object]) -> None:
    mechanism = store.machine("swing_conveyor")
    if link == "rocker":
        mechanism = mechanism.with_dimensions({"rocker.C.y": 0.05})
    problem = parts.LinkBending(mechanism, link, STEEL, parts.Section(1e-6, 1e-3, 1e-5))
    with faulty(code, "link", **values):
        problem.solve()


def test_stress_needs_the_whole_section() -> None:
    problem = parts.LinkBending(store.machine("crank_rocker"), "coupler", STEEL, SECTION)
    with faulty("no_modulus", "section"):
        problem.solve()


@pytest.mark.parametrize(("axis", "names"), [(("A", "Q"), "Q"), (("A", "B", "A"), "A, B, A"), (("A",), "A")])
def test_an_axis_runs_through_points_of_the_link(axis: tuple[str, ...], names: str) -> None:
    mechanism, section = store.machine("crank_rocker"), parts.Section(1e-6, 1e-3, 1e-5)
    problem = parts.LinkBending(mechanism, "coupler", STEEL, section, axis=axis)
    with faulty("axis", "axis", link="coupler", names=names):
        problem.solve()


def test_a_mechanism_whose_file_is_not_there_is_a_finding_of_the_calculation(tmp_path: Path) -> None:
    text = (files("linkwright.gallery") / "parts/pitman_bending.yaml").read_text("utf-8")
    file = tmp_path / "bending.yaml"
    file.write_text(re.sub("(?m)^mechanism: .*", "mechanism: nowhere.yaml", text))
    (missing,) = lw.check(file)
    assert (missing.where, missing.key, missing.code) == ("bending.yaml:10:12", "mechanism", "reference")
    said([missing], "reference", name="nowhere.yaml")


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
    (found,) = lw.check(file)
    said([found], "range", "section", message="these dimensions make no section")
    assert found.where == "bending.yaml:13:10"

"""Statics that has no answer is refused with the reason and the way out."""

import pytest
from tests.refusals import faulty, said

import linkwright as lw
from linkwright import parts


def body(*supports: parts.Support) -> parts.RigidBody:
    named = {f"S{i}": each for i, each in enumerate(supports)}
    return parts.RigidBody(named, {"load": parts.Force(force=(10, -600), at=(1.5, 0.0))})


def test_a_body_that_slides_says_which_way() -> None:
    with faulty("can_move", "supports", how="statics.slides", way="(1, 0)"):
        body(parts.Support((0.0, 0.0), ("y",)), parts.Support((3.0, 0.0), ("y",))).solve()


def test_a_body_that_turns_says_about_which_point() -> None:
    with faulty("can_move", "supports", how="statics.turns_plane", place="(1, 0.5)"):
        body(parts.Support((1.0, 0.5), ("x", "y"))).solve()


def test_a_motion_that_the_loads_do_not_start_is_told_apart() -> None:
    level = parts.RigidBody(
        {"A": parts.Support((0.0, 0.0), ("y",)), "B": parts.Support((3.0, 0.0), ("y",))},
        {"load": parts.Force(force=(0, -600), at=(1.5, 0.0))},
    )
    with faulty("loose", "supports", how="statics.slides", way="(1, 0)"):
        level.solve()


def test_a_body_held_too_often_is_indeterminate() -> None:
    with faulty("indeterminate", "supports", unknowns=4, equations=3):
        body(parts.Support((0.0, 0.0), ("x", "y")), parts.Support((3.0, 0.0), ("x", "y"))).solve()


def test_a_structure_that_can_move_says_how() -> None:
    frame = (
        "format: 1\nframe: {points: {A: [0 m, 0 m], D: [2 m, 0 m]}}\n"
        "links:\n  ab: {points: [A, B], length: 1 m, mass: 1 kg}\n  bc: {points: [B, C], length: 1.5 m}\n"
        "  cd: {points: [D, C], length: 1 m}\ngravity: [0, -9.81 m/s²]\n"
    )
    with faulty("structure_moves", "links", how=("ab turns", "bc turns", "cd turns")):
        parts.equilibrium(lw.loads(frame))


def test_files_say_where() -> None:
    text = (
        "format: 1\nkind: forces\nforces:\n  F1: [1 N, 2 N]\n  F2: {size: 3 N}\n  F3: [1 N, 2 N, 3 N, 4 N]\n"
    )
    with pytest.raises(lw.ModelError) as error:
        parts.loads(text, "f.yaml")
    first, second = error.value.findings
    assert first.where == "f.yaml:5:7" and first.key == "forces.F2"
    assert second.where == "f.yaml:6:7"
    said([first], "force_form", "forces.F2")
    said([second], "components", "forces.F3.force", count=4)


@pytest.mark.parametrize(
    ("text", "key", "code", "values"),
    [
        ("format: 1\nforces: {F: [1 N, 2 N]}\n", "kind", "kind", {"message": "part.no_kind"}),
        ("format: 1\nkind: belts\n", "kind", "unknown-word", {"offer": "belt"}),
        ("format: 1\nkind: belt\nfriction: 0.3\nwrap: 180 deg\n", "", "belt_choice", {"count": 0}),
        (
            "format: 1\nkind: belt\nfriction: 0.3\nwrap: 3 m\ntight: 1 N\n",
            "wrap",
            "wrong-dimension",
            {"wrong": "nouns.a_length", "noun": "nouns.a_angle"},
        ),
        (
            "format: 1\nkind: belt\nfriction: 0.5\nwrap: 800 rev\nslack: 1 N\n",
            "wrap",
            "belt_grip",
            {"most": "34377.5"},
        ),
        (
            "format: 1\nkind: wedge\nload: 1 kN\nangle: 80 deg\nfriction: 0.3\n",
            "friction",
            "wedge_stuck",
            {"sum": "113.398"},
        ),
    ],
)
def test_bad_files(text: str, key: str, code: str, values: dict[str, object]) -> None:
    with faulty(code, key, **values):
        parts.loads(text)

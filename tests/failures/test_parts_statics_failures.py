"""Statics that has no answer is refused with the reason and the way out."""

from pathlib import Path

import pytest
from tests.refusals import faulty, said

import linkwright as lw
from linkwright import parts


def body(*supports: parts.Support) -> parts.RigidBody:
    named = {f"S{i}": each for i, each in enumerate(supports)}
    return parts.RigidBody(named, {"load": parts.Force(force=(10, -600), at=(1.5, 0.0))})


def test_a_body_that_slides_says_which_way() -> None:
    with faulty("can_move", "supports", how="slide along {way}", way="(1, 0)"):
        body(parts.Support((0.0, 0.0), ("y",)), parts.Support((3.0, 0.0), ("y",))).solve()


def test_a_body_that_turns_says_about_which_point() -> None:
    with faulty("can_move", "supports", how="turn about the point {place} m", place="(1, 0.5)"):
        body(parts.Support((1.0, 0.5), ("x", "y"))).solve()


def test_a_motion_that_the_loads_do_not_start_is_told_apart() -> None:
    level = parts.RigidBody(
        {"A": parts.Support((0.0, 0.0), ("y",)), "B": parts.Support((3.0, 0.0), ("y",))},
        {"load": parts.Force(force=(0, -600), at=(1.5, 0.0))},
    )
    with faulty("loose", "supports", how="slide along {way}", way="(1, 0)"):
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
    text = "format: 1\nkind: forces\nforces:\n  F1: [1 N, 2 N]\n  F2: {magnitude: 3 N}\n  F3: [1 N, 2 N, 3 N, 4 N]\n"
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
        (
            "format: 1\nforces: {F: [1 N, 2 N]}\n",
            "kind",
            "kind",
            {"message": "the file does not say what is calculated"},
        ),
        ("format: 1\nkind: belts\n", "kind", "unknown-word", {"offer": "belt"}),
        ("format: 1\nkind: belt\nfriction: 0.3\nwrap: 180 deg\n", "", "belt_choice", {"count": 0}),
        (
            "format: 1\nkind: belt\nfriction: 0.3\nwrap: 3 m\ntight: 1 N\n",
            "wrap",
            "wrong-dimension",
            {"wrong": "a length", "noun": "an angle"},
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


def system(body: str) -> str:
    return f"format: 1\nkind: forces\nforces:\n{body}"


@pytest.mark.parametrize(
    ("text", "code", "key", "values"),
    [
        (
            system("  W: [0 N, -5 N]\n  S: {direction: 90 deg}\n  T: {direction: [0, -2]}\n"),
            "point_unknown",
            "forces",
            {"count": 2, "equations": 1, "names": ("S", "T")},
        ),
        (system("  W: [1 N, -5 N]\n  S: {direction: [0, 1]}\n"), "point_open", "forces", {"names": ("S",)}),
        (system("  W: {force: [1 N, 2 N], at: [1 m, 0 m]}\n  S: {direction: [0, 1]}\n"), "one_point", "forces", {}),
        (
            system("  W: [1 N, 2 N]\n  S: {direction: [0, 1]}\ncouples: {C: [0 N·m, 0 N·m, 1 N·m]}\n"),
            "one_point",
            "couples",
            {},
        ),
        (system("  W: {magnitude: 2 N, direction: [0, 0]}\n"), "no_direction", "forces.W.direction", {}),
        (system("  W: {magnitude: 2 N, from: [0 m, 0 m]}\n"), "line_form", "forces.W", {}),
        (system("  W: {magnitude: 2 N, from: [1 m, 0 m], to: [1 m, 0 m]}\n"), "no_direction", "forces.W.to", {}),
        (
            system("  W: [1 N, 2 N]\ncomponents: {c: {of: V, direction: [1, 0]}}\n"),
            "no_force",
            "components.c.of",
            {"name": "V", "known": ("W",)},
        ),
        (system("  W: [1 N, 2 N]\ncomponents: {c: {of: W}}\n"), "line_form", "components.c", {}),
        (system("  W: [1 N, 2 N]\nangles: {c: [W]}\n"), "pair", "angles.c", {"count": 1}),
        (
            "format: 1\nkind: rigid_body\nsupports: {A: {at: [0 m, 0 m], holds: [x, y, turn_z]}}\n"
            "loads: {F: {direction: [1, 0]}}\n",
            "unknown_load",
            "loads.F",
            {},
        ),
        (
            "format: 1\nkind: rigid_body\nsupports: {A: {at: [0 m, 0 m], holds: [x, y, turn_z]}}\n"
            "loads: {F: {force: [1 N, 0 N], couple: 2 N·m}}\n",
            "load_form",
            "loads.F",
            {},
        ),
    ],
)
def test_points_lines_and_loads_that_cannot_be(text: str, code: str, key: str, values: dict[str, object]) -> None:
    with faulty(code, key, **values):
        parts.loads(text)


OLD_WORDS = [
    (system("  P: {size: 3 N, along: [3, 4]}\n"), {"forces.P.size": "magnitude", "forces.P.along": "direction"}),
    (
        "format: 1\nkind: rigid_body\nsupports: {A: {at: [0 m, 0 m], holds: [x, y]}, "
        "B: {at: [1 m, 0 m], along: [0, 1]}}\nforces: {F: [0 N, -2 N]}\ncouples: {C: [0 N·m, 0 N·m, 1 N·m]}\n",
        {"supports.B.along": "direction", "forces": "loads", "couples": "loads"},
    ),
    (
        "format: 1\nkind: vibration\nmasses: {a: 2 kg·m²}\n"
        "springs: {s: {between: [ground, a], stiffness: 2 N·m/rad}}\n",
        {"masses": "inertias"},
    ),
    (lw.gallery.content("cam_oscillating").decode().replace("inertia: 0.05", "mass: 0.05"), {"mass": "inertia"}),
]


@pytest.mark.parametrize(("text", "renamed"), OLD_WORDS)
def test_old_words_go_on_being_read_and_are_told(text: str, renamed: dict[str, str], tmp_path: Path) -> None:
    """The same result as with the new words."""
    path = tmp_path / "old.yaml"
    path.write_text(text, encoding="utf-8")
    found = lw.check(path)
    assert {each.severity for each in found} == {"warning"}
    for key, new in renamed.items():
        said(found, "old-key", key, new=new)
    assert len(found) == len(renamed)
    assert parts.load(path).solve().data()


def test_old_and_new_words_mean_the_same() -> None:
    old = parts.loads(system("  P: {size: 3 N, along: [3, 4]}\n")).solve()
    new = parts.loads(system("  P: {magnitude: 3 N, direction: [3, 4]}\n")).solve()
    assert old.force == pytest.approx(new.force)
    angle = parts.loads(system("  P: {magnitude: 3 N, direction: 0.9272952180016122 rad}\n")).solve()
    assert angle.force == pytest.approx([1.8, 2.4, 0.0])
    both = system("  P: {size: 3 N, magnitude: 4 N, direction: [1, 0]}\n")
    with faulty("unknown-key", "forces.P.size"):
        parts.loads(both)


def test_inertia_of_a_translating_follower_is_refused() -> None:
    text = lw.gallery.content("cam_roller").decode().replace("mass: 1.2 kg", "inertia: 0.1 kg·m²")
    with faulty("inertia_or_mass", "inertia"):
        parts.loads(text)

"""Statics that has no answer is refused with the reason and the way out."""

import pytest

import linkwright as lw
from linkwright import parts


def refusal(problem: parts.Problem) -> str:
    with pytest.raises(lw.ModelError) as error:
        problem.solve()
    assert "数" not in str(error.value) and error.value.say("zh") != str(error.value)
    return str(error.value)


def body(*supports: parts.Support) -> parts.RigidBody:
    named = {f"S{i}": each for i, each in enumerate(supports)}
    return parts.RigidBody(named, {"load": parts.Force(force=(10, -600), at=(1.5, 0.0))})


def test_a_body_that_slides_says_which_way() -> None:
    text = refusal(body(parts.Support((0.0, 0.0), ("y",)), parts.Support((3.0, 0.0), ("y",))))
    assert "nothing keeps it from moving; it can slide along (1, 0)" in text


def test_a_body_that_turns_says_about_which_point() -> None:
    text = refusal(body(parts.Support((1.0, 0.5), ("x", "y"))))
    assert "turn about the point (1, 0.5) m" in text


def test_a_motion_that_the_loads_do_not_start_is_told_apart() -> None:
    level = parts.RigidBody(
        {"A": parts.Support((0.0, 0.0), ("y",)), "B": parts.Support((3.0, 0.0), ("y",))},
        {"load": parts.Force(force=(0, -600), at=(1.5, 0.0))},
    )
    assert "though these forces do not start it" in refusal(level)


def test_a_body_held_too_often_is_indeterminate() -> None:
    text = refusal(body(parts.Support((0.0, 0.0), ("x", "y")), parts.Support((3.0, 0.0), ("x", "y"))))
    assert "4 reactions" in text and "3 equations" in text


def test_a_structure_that_can_move_says_how() -> None:
    frame = (
        "format: 1\nframe: {points: {A: [0 m, 0 m], D: [2 m, 0 m]}}\n"
        "links:\n  ab: {points: [A, B], length: 1 m, mass: 1 kg}\n  bc: {points: [B, C], length: 1.5 m}\n"
        "  cd: {points: [D, C], length: 1 m}\ngravity: [0, -9.81 m/s²]\n"
    )
    with pytest.raises(lw.ModelError) as error:
        parts.equilibrium(lw.loads(frame))
    assert "the structure can move: ab turns, bc turns, cd turns" in str(error.value)
    assert "结构可以运动：ab 转动" in error.value.say("zh").replace(":", "：")


def test_files_say_where() -> None:
    text = (
        "format: 1\nkind: forces\nforces:\n  F1: [1 N, 2 N]\n  F2: {size: 3 N}\n  F3: [1 N, 2 N, 3 N, 4 N]\n"
    )
    with pytest.raises(lw.ModelError) as error:
        parts.loads(text, "f.yaml")
    first, second = error.value.findings
    assert first.where == "f.yaml:5:7" and first.key == "forces.F2"
    assert second.where == "f.yaml:6:7" and "the number of components is 4" in second.message


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("format: 1\nforces: {F: [1 N, 2 N]}\n", "does not say what is calculated"),
        ("format: 1\nkind: belts\n", 'did you mean "belt"'),
        ("format: 1\nkind: belt\nfriction: 0.3\nwrap: 180 deg\n", "0 of tight, slack and torque"),
        ("format: 1\nkind: belt\nfriction: 0.3\nwrap: 3 m\ntight: 1 N\n", "is a length, where an angle"),
        ("format: 1\nkind: belt\nfriction: 0.5\nwrap: 800 rev\nslack: 1 N\n", "below 34377.5°"),
        ("format: 1\nkind: wedge\nload: 1 kN\nangle: 80 deg\nfriction: 0.3\n", "no push raises the load"),
    ],
)
def test_bad_files(text: str, words: str) -> None:
    with pytest.raises(lw.ModelError) as error:
        parts.loads(text)
    assert words in str(error.value)

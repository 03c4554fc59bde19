"""Numbers that no machine has, in every field of every calculation and in options: findings or a result."""

import random
import re
from contextlib import suppress
from pathlib import Path

import pytest
from tests.refusals import faulty

import linkwright as lw
from linkwright import parts
from linkwright.cli import main

FOLDER = Path(lw.__file__).parent / "gallery/parts"
EXTREME = [
    "--1",
    "+-1",
    "²",
    "½",
    "١",
    "1e400",
    "-1e400",
    "1e308",
    "1e100",
    "-1e100",
    "1e30",
    "1e12",
    "1e-9",
    "1e-30",
    "1e-300",
    "0",
    "-1",
    "1.5",
    "9" * 30,
    "nan",
    "inf",
    "1_0",
    "0x10",
    "1e",
]
#: Kinds that search or simulate.
LONG = ("program", "cam", "follower", "tolerance", "vibration")
NUMBER = re.compile(r"(?<![\w.])-?\d+\.?\d*(?:e[+-]?\d+)?(?![\w.])")
HEADING = re.compile(r"\s*(?:#|(?:format|name|purpose|source|en|zh|expected)\b)")


def places(text: str) -> list[tuple[int, int]]:
    """Where the numbers of a file stand, those of its heading left out."""
    found, at = [], 0
    for line in text.splitlines(keepends=True):
        if not HEADING.match(line):
            found += [(at + each.start(), at + each.end()) for each in NUMBER.finditer(line)]
        at += len(line)
    return found


def tried(name: str, text: str) -> bool:
    """A result that can be shown, or findings that say where."""
    try:
        problem = parts.loads(text, f"{name}.yaml", FOLDER)
    except lw.ModelError as error:
        return places_said(error, name)
    with suppress(lw.LinkwrightError):
        result = problem.solve()
        assert result.text() and result.data() and result.worked("zh")
    return True


def places_said(error: lw.ModelError, name: str) -> bool:
    """Whether every finding says where."""
    return all(each.where.startswith(f"{name}.yaml:") for each in error.findings)


def kind_of(name: str) -> str:
    """What a file of the gallery calculates."""
    (found,) = re.findall(r"(?m)^kind: *(\w+)", (FOLDER / f"{name}.yaml").read_text("utf-8"))
    return found


SHORT = [name for name in parts.gallery_names() if kind_of(name) not in LONG]


def answered(name: str, count: int, seed: str = "") -> None:
    """Of a calculation with one of its numbers replaced, as often as is asked for."""
    text = (FOLDER / f"{name}.yaml").read_text("utf-8")
    rng = random.Random(seed + name)
    for _ in range(count):
        start, end = rng.choice(places(text))
        changed = f"{text[:start]}{rng.choice(EXTREME)}{text[end:]}"
        assert tried(name, changed), changed


@pytest.mark.parametrize("name", SHORT)
def test_any_number_of_a_calculation(name: str) -> None:
    answered(name, 12)


@pytest.mark.rotating
@pytest.mark.parametrize("name", SHORT)
def test_more_numbers_of_a_calculation(name: str) -> None:
    answered(name, 48, "more of ")


@pytest.mark.long
@pytest.mark.parametrize("name", [name for name in parts.gallery_names() if name not in SHORT])
def test_any_number_of_a_calculation_that_takes_long(name: str) -> None:
    answered(name, 12)


@pytest.mark.parametrize("given", ["--1", "+-1", "²", "9" * 30, "1.5", "1e400"])
@pytest.mark.parametrize("key", ["samples", "steps", "seed"])
def test_whole_numbers_of_a_tolerance_study(key: str, given: str) -> None:
    text = (FOLDER / "pressed_pins.yaml").read_text("utf-8")
    changed = re.sub(rf"(?m)^{key}: .*\n", "", text) + f"{key}: {given}\n"
    with faulty("range", key, message='"{text}" is not an integer from {minimum} to {maximum}') as caught:
        parts.loads(changed, "pressed_pins.yaml", FOLDER)
    assert re.match(r"pressed_pins.yaml:\d+:\d+", caught.value.findings[0].where)


@pytest.mark.parametrize(
    ("name", "old", "new", "key", "code", "values"),
    [
        (
            "spring_rate",
            "51.3",
            "-1e100",
            "samples.force.values.2",
            "range",
            {"message": "{shown} is more than any machine has", "shown": "-1e100"},
        ),
        (
            "shaft_diameters",
            "19.998",
            "1e308",
            "samples.lathe_1.values.1",
            "range",
            {"message": "{shown} is more than any machine has", "shown": "1e308"},
        ),
        ("production_mix", "<= 4", "<= 1e400", "subject_to.shop_1", "not-finite", {"text": "1e400"}),
        (
            "production_mix",
            "from: 0",
            "from: -1e100",
            "variables.doors.from",
            "range",
            {"message": "{shown} is more than any machine has", "shown": "-1e100"},
        ),
        ("tuned_absorber", "machine: 100 kg", "machine: 1e-300 kg", "masses.machine", "mass_above_zero", {}),
        (
            "two_masses",
            "4 kN/m",
            "1e100 kN/m",
            "springs.k1.stiffness",
            "range",
            {"message": "{shown} is more than any machine has", "shown": "1e100 kN/m"},
        ),
    ],
)
def test_what_no_machine_has(name: str, old: str, new: str, key: str, code: str, values: dict[str, object]) -> None:
    text = (FOLDER / f"{name}.yaml").read_text("utf-8")
    assert old in text
    with faulty(code, key, **values):
        parts.loads(text.replace(old, new, 1), f"{name}.yaml", FOLDER).solve()


def test_a_drag_below_rounding_is_none() -> None:
    """The flight is that in a vacuum."""
    text = (FOLDER / "thrown_ball.yaml").read_text("utf-8")
    thin = parts.loads(re.sub(r"(?m)^(drag_coefficient): .*", r"\1: 1e-30", text)).solve()
    vacuum = parts.loads(re.sub(r"(?m)^(area|drag_coefficient): .*\n", "", text)).solve()
    assert thin.duration == pytest.approx(vacuum.duration, rel=1e-9)  # type: ignore[attr-defined]


def test_the_unit_of_an_objective_does_not_matter() -> None:
    """Wyndor Glass with doors and windows worth 1e100 times as much: the same plan, prices as many times higher."""
    text = (FOLDER / "production_mix.yaml").read_text("utf-8")
    usual, dear = (
        parts.loads(re.sub(r"(?m)^maximize: .*", f"maximize: {size}*(3*doors + 5*windows)", text)).solve()
        for size in ("1", "1e100")
    )
    assert dear.x == pytest.approx(usual.x)  # type: ignore[attr-defined]
    assert dear.prices["shop_2"] == pytest.approx(1.5e100)  # type: ignore[attr-defined]


@pytest.mark.parametrize(
    "command",
    [
        ["machine", "gallery:crank_rocker", "--ratio=1e-300"],
        ["machine", "--torque", "200", "--load", "1e308"],
        ["solve", "gallery:crank_rocker", f"--steps={'9' * 25}"],
        ["study", "gallery:crank_rocker", "--vary", "crank.length=0.9..1.1 m:²"],
    ],
)
def test_options(command: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(command) == 2
    assert capsys.readouterr().err

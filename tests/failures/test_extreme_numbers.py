"""Numbers that no machine has, in every field of every calculation and in options: findings at places, or a result.

``LINKWRIGHT_EXTREME=20000 python -m pytest tests/failures/test_extreme_numbers.py`` tries more of them, in the
calculations that take long as well.
"""

import os
import random
import re
from contextlib import suppress
from pathlib import Path

import pytest

import linkwright as lw
from linkwright import parts
from linkwright.cli import main
from linkwright.parts.file import kind_of

COUNT = int(os.environ.get("LINKWRIGHT_EXTREME", "0"))
FOLDER = Path(lw.__file__).parent / "gallery/parts"
EXTREME = [
    "--1", "+-1", "²", "½", "١", "1e400", "-1e400", "1e308", "1e100", "-1e100", "1e30", "1e12", "1e-9", "1e-30",
    "1e-300", "0", "-1", "1.5", "9" * 30, "nan", "inf", "1_0", "0x10", "1e",
]  # fmt: skip
#: Kinds that search or simulate.
LONG = ("program", "cam", "follower", "tolerance", "vibration")
NUMBER = re.compile(r"(?<![\w.])-?\d+\.?\d*(?:e[+-]?\d+)?(?![\w.])")
HEADING = re.compile(r"\s*(?:#|(?:format|name|purpose|source|expected)\b)")


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


@pytest.mark.parametrize("name", parts.gallery_names())
def test_any_number_of_a_calculation(name: str) -> None:
    kind, text = kind_of(f"gallery:{name}"), (FOLDER / f"{name}.yaml").read_text("utf-8")
    if kind in LONG and not COUNT:
        pytest.skip("takes long: a command of its own")
    rng = random.Random(name)
    for _ in range(max(24, COUNT // len(parts.gallery_names()))):
        start, end = rng.choice(places(text))
        changed = f"{text[:start]}{rng.choice(EXTREME)}{text[end:]}"
        assert tried(name, changed), changed


@pytest.mark.parametrize("given", ["--1", "+-1", "²", "9" * 30, "1.5", "1e400"])
@pytest.mark.parametrize("key", ["samples", "steps", "seed"])
def test_whole_numbers_of_a_tolerance_study(key: str, given: str) -> None:
    text = (FOLDER / "pressed_pins.yaml").read_text("utf-8")
    changed = re.sub(rf"(?m)^{key}: .*\n", "", text) + f"{key}: {given}\n"
    with pytest.raises(
        lw.ModelError, match=rf"pressed_pins.yaml:\d+:\d+: {key}: .* is not a whole number from"
    ):
        parts.loads(changed, "pressed_pins.yaml", FOLDER)


@pytest.mark.parametrize(
    ("name", "old", "new", "said"),
    [
        ("spring_rate", "51.3", "-1e100", r"samples.force.values.2: -1e100 is more than any machine has"),
        ("shaft_diameters", "19.998", "1e308", r"samples.lathe_1.values.1: .* more than any machine has"),
        ("production_mix", "<= 4", "<= 1e400", r'"1e400" is not a finite number'),
        ("production_mix", "from: 0", "from: -1e100", r"variables.doors.from: .* more than any machine has"),
        (
            "tuned_absorber",
            "machine: 100 kg",
            "machine: 1e-300 kg",
            r"masses.machine: the mass is not above 1e-12 kg",
        ),
        ("two_masses", "4 kN/m", "1e100 kN/m", r"springs.k1.stiffness: .* more than any machine has"),
    ],
)
def test_what_no_machine_has(name: str, old: str, new: str, said: str) -> None:
    text = (FOLDER / f"{name}.yaml").read_text("utf-8")
    with pytest.raises(lw.ModelError, match=said):
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
    assert main(command) in (1, 2)
    assert "should not have happened" not in "".join(capsys.readouterr())

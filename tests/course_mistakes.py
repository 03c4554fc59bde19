"""``python -m tests.course_mistakes [SHEETS]``: synthetic sheets with mistakes of their own arithmetic, graded."""

from __future__ import annotations

import random
import sys
from collections import Counter
from typing import Any

from tests.course_sheets import FOUR_BAR, LEVER, SLIPS, Pen, four_bar, lever

import linkwright as lw

TASKS = {"four_bar": FOUR_BAR, "lever": LEVER}


def keys(count: int = 10) -> dict[str, dict[str, Any]]:
    """Answer keys of both tasks."""
    return {name: lw.variants(lw.loads(text), count, seed=5).key() for name, text in TASKS.items()}


def sheet(name: str, variant: dict[str, Any], pen: Pen) -> dict[str, float]:
    """The answers of one sheet."""
    sizes = variant["dimensions"]
    if name == "lever":
        return lever(sizes["crank.length"], sizes["lever.mass"], pen)
    return four_bar(sizes["crank.length"], sizes["coupler.length"], sizes["rocker.length"], pen)


def outcome(key: dict[str, Any], name: str, rng: random.Random) -> tuple[str, str]:
    """One random sheet: the mistake in it ("" for none, also for one that no answer shows), and the one named."""
    variant = rng.choice(key["variants"])
    slip, where = rng.choice((*SLIPS[name], ("", ""), ("", ""), ("", "")))
    answers = sheet(name, variant, Pen(slip, where))
    right = {q["name"]: a for q, a in zip(key["questions"], variant["answers"], strict=True)}
    shown = [abs(answers[n] - right[n]) > 0.03 * abs(right[n]) for n in right if not n.endswith(".angle")]
    shown += [abs((answers[n] - right[n] + 180) % 360 - 180) > 1.5 for n in right if n.endswith(".angle")]
    row = {n: f"{a * (1 + rng.uniform(-1e-3, 1e-3)):.4g}" for n, a in answers.items()}
    (grade,) = lw.grade(key, [{"student": "s", "variant": str(variant["number"]), **row}])
    return (slip if any(shown) else ""), (
        grade.mistakes[0] if grade.mistakes else "?" if False in grade.right else ""
    )


def main(count: int = 1000) -> int:
    rng = random.Random(11)
    held = keys()
    results: Counter[tuple[str, str]] = Counter()
    for _ in range(count):
        name = rng.choice(sorted(TASKS))
        results[outcome(held[name], name, rng)] += 1
    wrong = sum(n for (slip, _), n in results.items() if slip)
    named = sum(n for (slip, found), n in results.items() if slip and slip == found)
    false = sum(n for (slip, found), n in results.items() if not slip and found)
    for (slip, found), n in sorted(results.items()):
        print(f"{n:5}  {slip or 'right':24} -> {found or 'nothing named'}")
    print(
        f"{named} of {wrong} mistakes named rightly ({100 * named / wrong:.1f} %); {false} named on "
        f"{count - wrong} right sheets"
    )
    return int(named < 0.95 * wrong or false > 0)


if __name__ == "__main__":
    sys.exit(main(*map(int, sys.argv[1:])))

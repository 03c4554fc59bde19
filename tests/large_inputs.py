"""``python -m tests.large_inputs``: models that grow in one direction up to a megabyte, and the time for each."""

import time
from collections.abc import Callable
from math import cos, sin

from tests.refusals import findings

MODEL = """\
format: 1
frame: {points: {O1: [0 m, 0 m], O2: [4 m, 0 m]}}
links:
  crank: {points: [O1, A], length: LENGTH}
  coupler: {points: [A, B], length: 3.5 m}
  rocker: {points: [O2, B], length: 3 m}
assembly: {B: left}
driver: {turn: crank, about: O1, speed: 10 rpm}
"""


def with_length(text: str, before: str = "", after: str = "") -> str:
    return before + MODEL.replace("LENGTH", text) + after


def chain(dyads: int) -> str:
    """A crank and a row of dyads, each driven by the one before it."""
    pivots = ", ".join(f"O{i}: [{4 * i} m, 0 m]" for i in range(dyads + 1))
    links = ["  crank: {points: [O0, B0], length: 1 m}"]
    for i in range(1, dyads + 1):
        links += [
            f"  c{i}: {{points: [B{i - 1}, B{i}], length: 4 m}}",
            f"  r{i}: {{points: [O{i}, B{i}], length: 2 m}}",
        ]
    words = ", ".join(f"B{i}: left" for i in range(1, dyads + 1))
    driver = "driver: {turn: crank, about: O0, speed: 10 rpm}\n"
    return (
        f"format: 1\nframe: {{points: {{{pivots}}}}}\nlinks:\n"
        + "\n".join(links)
        + f"\nassembly: {{{words}}}\n"
        + driver
    )


def parallelograms(count: int) -> str:
    """A row of parallelograms, each with a third rocker that the others make redundant, drawn."""
    across, up = 0.4 * cos(0.9), 0.4 * sin(0.9)
    pivots = [f"O{i}: [{i} m, 0 m], M{i}: [{i + 0.5} m, 0 m]" for i in range(count + 1)]
    links = [f"  r{i}: {{points: [O{i}, A{i}], length: 0.4 m}}" for i in range(count + 1)]
    for i in range(count):
        links += [
            f"  c{i}: {{points: [A{i}, A{i + 1}], length: 1 m, also: {{B{i}: [0.5 m, 0 m]}}}}",
            f"  m{i}: {{points: [M{i}, B{i}], length: 0.4 m}}",
        ]
    places = {f"A{i}": i for i in range(count + 1)} | {f"B{i}": i + 0.5 for i in range(count)}
    drawn = [f"{name}: [{place + across} m, {up} m]" for name, place in places.items()]
    return (
        f"format: 1\nframe: {{points: {{{', '.join(pivots)}}}}}\nlinks:\n"
        + "\n".join(links)
        + f"\ndrawing: {{{', '.join(drawn)}}}\ndriver: {{turn: r0, about: O0, speed: 10 rpm}}\n"
    )


def parameters(rows: list[str]) -> str:
    return "parameters:\n" + "".join(f"  {row}\n" for row in rows)


#: (text, whether it is a model)
INPUTS: dict[str, tuple[Callable[[], str], bool]] = {
    "digits": (lambda: with_length("1" * 900_000), False),
    "nearly a number": (lambda: with_length("1 " + "m" * 990), False),
    "exponents": (lambda: with_length("1e" * 490), False),
    "superscripts": (lambda: with_length("1 m" + "²" * 900), False),
    "units": (lambda: with_length("1 m" + "*m" * 450), False),
    "dashes": (lambda: with_length("1 " + "a-" * 450), False),
    "minus signs": (lambda: with_length('"' + "-" * 990 + '1"'), False),
    "parentheses": (lambda: with_length("(" * 400 + "1 m" + ")" * 400), False),
    "spaces": (lambda: with_length("1" + " " * 900_000 + "x"), False),
    "eighty factors": (lambda: with_length("a*" * 80 + "l", "parameters: {a: 1, l: 1 m}\n"), True),
    "three hundred factors": (lambda: with_length("a*" * 300 + "l", "parameters: {a: 1, l: 1 m}\n"), True),
    "chained parameters": (
        lambda: with_length("p2999", parameters(["p0: 1 m", *(f"p{i}: p{i - 1}" for i in range(1, 3000))])),
        True,
    ),
    "parameters defined below": (
        lambda: with_length("p2999", parameters([*(f"p{i}: p{i - 1}" for i in range(2999, 0, -1)), "p0: 1 m"])),
        False,
    ),
    "a broken parameter": (
        lambda: with_length("p2999", parameters(["p0: 1 xx", *(f"p{i}: p{i - 1}" for i in range(1, 3000))])),
        False,
    ),
    "unknown names": (lambda: with_length("1 m", parameters([f"p{i}: q{i} + 1 m" for i in range(9000)])), False),
    "a long block": (lambda: with_length("1 m", "purpose: |\n" + ("  " + "x" * 78 + "\n") * 12_000), True),
    "a long line": (lambda: with_length("1 m", "purpose: " + "x " * 450_000 + "\n"), True),
    "a comment": (lambda: with_length("1 m", "#" * 900_000 + "\n"), True),
    "empty lines": (lambda: with_length("1 m", "\n" * 900_000), True),
    "tabs": (lambda: "a \t \t\t" * 140_000, False),
    "six hundred links": (lambda: chain(299), True),
    "deep lists": (lambda: "a: " + "[" * 500_000, False),
    "deep mappings": (lambda: "a: " + "{a: " * 200_000, False),
    "deep dashes": (lambda: "- " * 400_000, False),
    "deep blocks": (lambda: "".join(" " * i + "a:\n" for i in range(1300)), False),
    "question marks": (lambda: "? " * 400_000, False),
    "exploding aliases": (
        lambda: (
            "a: &a [x,x,x,x,x,x,x,x,x,x]\n"
            + "".join(f"{c}: &{c} [{','.join(['*' + chr(ord(c) - 1)] * 10)}]\n" for c in "bcdefghij")
        ),
        False,
    ),
    "unknown keys": (lambda: with_length("1 m", "".join(f"key{i}: 1\n" for i in range(14_000))), False),
    "a long key": (lambda: with_length("1 m", '? "' + "k" * 900_000 + '"\n: 1\n'), False),
    "a long word": (lambda: with_length("1 m").replace("turn: crank", "turn: " + "c" * 900_000), False),
    "many links": (
        lambda: (
            "format: 1\nframe: {points: {O1: [0 m, 0 m]}}\nlinks:\n"
            + "".join(f"  l{i}: {{points: [O1, A], length: 1 m}}\n" for i in range(3500))
        ),
        False,
    ),
    "many points": (
        lambda: (
            "format: 1\nframe: {points: {O1: [0 m, 0 m]}}\nlinks:\n  a: {points: [O1, A], length: 1 m, also: {"
            + ", ".join(f"P{i}: [1 m, {i + 1} mm]" for i in range(7000))
            + "}, mass: 1 kg, inertia: 1 kg*m^2}\ndriver: {turn: a, about: O1, speed: 1 rpm}\n"
        ),
        True,
    ),
    "many loads": (
        lambda: with_length(
            "1 m",
            after="loads:\n"
            + "".join(
                f'  l{i}: {{kind: force, on: crank, at: A, direction: 0 deg, magnitude: "1 N*sin(crank)"}}\n'
                for i in range(1500)
            ),
        ),
        True,
    ),
    "a long table": (
        lambda: with_length("1 m").replace(
            "speed: 10 rpm",
            f"table: {{time: [{', '.join(f'{i} s' for i in range(13_000))}], "
            f"position: [{', '.join(f'{i % 7} deg' for i in range(13_000))}]}}",
        ),
        True,
    ),
}


def _times() -> None:
    """Prints the processor seconds of each, the longest first."""
    found = []
    for name, (make, _) in INPUTS.items():
        text = make()
        began = time.process_time()
        findings(text, "m.yaml")
        found.append((time.process_time() - began, name))
    print("\n".join(f"{seconds:8.3f} s  {name}" for seconds, name in sorted(found, reverse=True)))


if __name__ == "__main__":
    _times()

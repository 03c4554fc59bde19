"""Which buffer holds which line: a value's place is reused after its last use."""

from __future__ import annotations

from dataclasses import dataclass

from linkwright.formula.lines import Lines

#: Kinds of places: a row of the result, a number buffer, a truth buffer.
ROW, NUMBER, TRUTH = "row", "number", "truth"
Place = tuple[str, int]


@dataclass(frozen=True, slots=True)
class Registers:
    """Places of the lines that vary; numbers of buffers; result rows filled by copying."""

    places: dict[int, Place]
    numbers: int
    truths: int
    copies: tuple[tuple[int, int], ...]

    @classmethod
    def of(cls, lines: Lines) -> Registers:
        """Give every line that varies a place; an output is found where it is wanted."""
        last = _last_uses(lines)
        places: dict[int, Place] = {}
        copies: list[tuple[int, int]] = []
        for row, index in enumerate(lines.outputs):
            line = lines.lines[index]
            if line.varies and line.is_operation and not line.truth and index not in places:
                places[index] = (ROW, row)
            else:
                copies.append((row, index))
        free: dict[str, list[int]] = {NUMBER: [], TRUTH: []}
        counts = {NUMBER: 0, TRUTH: 0}
        for index, line in enumerate(lines.lines):
            if not (line.varies and line.is_operation):
                continue
            dying = {a for a in line.args if last.get(a) == index and places.get(a, (ROW, 0))[0] != ROW}
            early = {a for a in dying if line.op != "select" or a == line.args[2]}
            _release(places, free, early)
            if index not in places:
                kind = TRUTH if line.truth else NUMBER
                if free[kind]:
                    number = free[kind].pop()
                else:
                    number = counts[kind]
                    counts[kind] += 1
                places[index] = (kind, number)
            _release(places, free, dying - early)
        return cls(places, counts[NUMBER], counts[TRUTH], tuple(copies))


def _last_uses(lines: Lines) -> dict[int, int]:
    last = {a: index for index, line in enumerate(lines.lines) for a in line.args}
    last.update(dict.fromkeys(lines.outputs, len(lines.lines)))
    return last


def _release(places: dict[int, Place], free: dict[str, list[int]], indices: set[int]) -> None:
    for index in sorted(indices):
        kind, number = places[index]
        free[kind].append(number)

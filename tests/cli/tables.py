"""Printed tables, read by their cells; widths as a terminal counts them."""

import re
from collections.abc import Iterable
from unicodedata import combining, east_asian_width


def width(text: str) -> int:
    """Columns of a terminal that a text takes: two for each wide character."""
    return sum(0 if combining(each) else 2 if east_asian_width(each) in "WF" else 1 for each in text)


def widest(lines: Iterable[str]) -> int:
    """Columns of the widest line."""
    return max(map(width, lines))


def cells(line: str) -> list[str]:
    """What stands in the cells of a row, between two spaces or more."""
    return re.split(" {2,}", line.strip())


def rows(shown: str, begins: str = "") -> list[list[str]]:
    """The rows of all tables, of two cells or more; those whose first cell begins with a text."""
    found = [cells(line) for line in shown.splitlines()]
    return [each for each in found if len(each) > 1 and each[0].startswith(begins)]


def rows_of_numbers(shown: str) -> list[list[float]]:
    """The rows of numbers of the first table, behind the first empty line."""
    found = []
    for line in shown.split("\n\n")[1].splitlines():
        try:
            found.append([float(each) for each in line.split()])
        except ValueError:
            continue
    assert found, shown
    return found


def numbers(text: str) -> list[float]:
    """The numbers of a text, in their order."""
    return [float(each) for each in re.findall(r"(?<![\w.])[-−]?\d+(?:\.\d+)?(?:e[-+]?\d+)?", text)]

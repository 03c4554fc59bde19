"""Tables as notebooks show them."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from html import escape
from typing import Any

#: Rows that a notebook shows of a long table.
MOST = 40


def html_table(
    title: str, head: Sequence[str], rows: Sequence[Sequence[str]], below: Sequence[str] = ()
) -> str:
    """A table with a title and lines below it; the first column to the left, the others to the right."""
    style = "text-align:right"
    body = "".join(
        "<tr>"
        + "".join(
            f'<td style="{style if i else "text-align:left"}">{escape(cell)}</td>'
            for i, cell in enumerate(row)
        )
        + "</tr>"
        for row in rows
    )
    heads = "".join(f"<th>{escape(word)}</th>" for word in head)
    lines = "".join(f"<p>{escape(line)}</p>" for line in below)
    top = f"<caption>{escape(title)}</caption><thead><tr>{heads}</tr></thead>"
    return f"<table>{top}<tbody>{body}</tbody></table>{lines}"


def columns_html(title: str, columns: Mapping[str, Any], notes: Sequence[str] = ()) -> str:
    """The first rows of named columns, numbered, with notes below."""
    count = max(map(len, columns.values()), default=0)
    rows = [[str(i), *(f"{column[i]:.6g}" for column in columns.values())] for i in range(min(count, MOST))]
    below = [f"{MOST} / {count}"] if count > MOST else []
    return html_table(title, ["", *columns], rows, [*below, *map(str, notes)])

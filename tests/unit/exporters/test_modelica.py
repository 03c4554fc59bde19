"""Names and texts of Modelica models."""

import re

from linkwright.exporters.modelica_equations import Names, quoted


def test_names_are_distinct_identifiers() -> None:
    names = Names()
    found = [names.of("link", "a-b"), names.of("pin", "a_b"), names.of("guide", "a_b"), names.of("link", "曲柄")]
    assert len(set(found)) == 4 and all(re.fullmatch(r"[A-Za-z]\w*", each, re.ASCII) for each in found)
    assert names.of("link", "a-b") == found[0]


def test_texts_cannot_end_early() -> None:
    assert quoted('a "b" \\ \n c') == '"a \\"b\\" \\\\ c"'

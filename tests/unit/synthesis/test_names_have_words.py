"""Names that the code of synthesis gives to numbers have words in both languages."""

import re
from pathlib import Path

import linkwright as lw
from linkwright.synthesis.names import NAMES


def test_names_of_synthesis_have_words() -> None:
    """Counts and values are keys of mappings in the code: each has its word."""
    known = {name: each.translate("zh") for name, each in NAMES.items()}
    root = Path(lw.__file__).parent / "synthesis"
    code = "".join(path.read_text(encoding="utf-8") for path in root.rglob("*.py"))
    with_units = set(re.findall(r'"(\w+) \[(?:rad|m)\]":', code)) - {"lengths", "points"}
    counted = set(re.findall(r'(?:counts=|counts = |"exact_path", [^\n]*|target, )\{"(\w+)": ', code))
    assert len(with_units) > 12 and len(counted) > 5
    assert (with_units | counted) - {"transmission_angle_min", "longest", "extent"} <= set(known)
    assert all(re.search("[一-鿿]", text) for text in known.values())

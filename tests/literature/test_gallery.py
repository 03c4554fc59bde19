"""The groups of every gallery model; its numbers are compared with all other published ones."""

import pytest

import linkwright as lw
from linkwright import gallery

ROMAN = {3: "III", 4: "IV"}


@pytest.mark.parametrize("name", gallery.names())
def test_structure(name: str) -> None:
    expected = lw.load(f"gallery:{name}").expected
    found = lw.structure(lw.load(f"gallery:{name}"))
    assert found.mobility == expected["mobility"]
    assert found.grubler == expected.get("grubler", expected["mobility"])
    if "groups" in expected:
        groups = [group for group in found.groups if group.assur_class > 1]
        words = [
            group.signature
            if group.assur_class == 2
            else f"class {ROMAN[group.assur_class]}, order {group.assur_order}"
            for group in groups
        ]
        assert sorted(words) == sorted(expected["groups"])
        assert max((group.assur_class for group in groups), default=1) == expected["class"]

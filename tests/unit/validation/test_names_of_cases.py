"""Published cases are named in every language."""

import re

from tests.every import every

from linkwright.validation.validate import published
from linkwright.words import in_language

CHINESE = re.compile("[一-鿿]")


def test_published_cases_are_told_in_every_language() -> None:
    for each in every(published(), least=100):
        assert CHINESE.search(in_language(each.case, "zh")) and not CHINESE.search(each.case)

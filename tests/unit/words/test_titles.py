"""Titles that files of the package and published cases have are known in Chinese."""

import re

from tests.every import every

from linkwright import gallery
from linkwright.cli.commands.gallery import _heading
from linkwright.validation.published import from_data
from linkwright.words.titles import CHINESE


def test_titles_of_the_gallery() -> None:
    names = (*gallery.names(), *gallery.calculations(), *gallery.tasks())
    titles = {_heading(name)["title"] for name in names}
    assert set(every(titles, least=70)) <= set(CHINESE)
    assert all(re.search("[一-鿿]", title) for title in CHINESE.values())


def test_titles_of_published_cases() -> None:
    assert {each.case for each in every(from_data())} <= set(CHINESE)

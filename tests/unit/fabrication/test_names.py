"""Names of files for parts of any name."""

import pytest

from linkwright.fabrication.names import file_names


@pytest.mark.parametrize(
    ("name", "file"),
    [
        ("crank", "crank"),
        ("guide slide", "guide-slide"),
        ("曲柄", "曲柄"),
        ("連桿 一", "連桿-一"),
        ("../../etc/passwd", "etc-passwd"),
        ("a:b*c?", "a-b-c"),
        (".hidden", "hidden"),
        ("CON", "part-CON"),
        ("aux.1", "part-aux.1"),
        ("\u202eevil", "evil"),
        ("/", "part"),
    ],
)
def test_a_name_is_safe_on_every_system(name: str, file: str) -> None:
    assert file_names([name])[name] == file


def test_names_differ_without_regard_to_case() -> None:
    assert [*file_names(["Rod", "rod", "ROD"]).values()] == ["Rod", "rod-2", "ROD-3"]


def test_long_names_are_cut_between_letters() -> None:
    (found,) = file_names(["杆" * 300]).values()
    assert len(found.encode()) <= 120 and set(found) == {"杆"}

"""Values that are found once per object, whatever thread asks."""

from concurrent.futures import ThreadPoolExecutor
from threading import Barrier

from linkwright.core.cached_property import cached_property


class Found:
    def __init__(self) -> None:
        self.times, self.both = 0, Barrier(2, timeout=60.0)

    @cached_property
    def alone(self) -> list[int]:
        """A list of its own."""
        self.times += 1
        return [self.times]

    @cached_property
    def at_the_same_time(self) -> list[int]:
        self.both.wait()
        return []


def test_a_value_is_found_once_per_object() -> None:
    found, other = Found(), Found()
    assert found.alone is found.alone and found.times == 1
    assert other.alone is not found.alone
    assert Found.alone.__doc__ == "A list of its own."


def test_two_threads_that_find_a_value_go_on_with_the_same_one() -> None:
    found = Found()
    with ThreadPoolExecutor(2) as pool:
        first, second = pool.map(lambda _: found.at_the_same_time, range(2))
    assert first is second is found.at_the_same_time

"""Values that threads share are found once."""

from concurrent.futures import ThreadPoolExecutor
from threading import Event, RLock
from time import sleep

from linkwright.kinematics.programs import locked_property


class Shared:
    def __init__(self) -> None:
        self.lock, self.started = RLock(), Event()

    @locked_property
    def value(self) -> list[int]:
        """A list of its own."""
        self.started.set()
        sleep(0.05)
        return []


def test_two_threads_share_the_value_of_the_first() -> None:
    shared = Shared()
    with ThreadPoolExecutor(2) as pool:
        first = pool.submit(lambda: shared.value)
        assert shared.started.wait(60.0)
        assert shared.value is first.result()
    assert Shared.value.__doc__ == "A list of its own."

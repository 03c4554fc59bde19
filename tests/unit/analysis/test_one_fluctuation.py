"""One coefficient of speed fluctuation where none is asked for."""

from linkwright.analysis.flywheel import SIZED
from linkwright.machine.flywheel import FLUCTUATION
from linkwright.reports.settings import Settings


def test_flywheels_are_laid_out_for_the_same_coefficient_everywhere() -> None:
    assert {FLUCTUATION, Settings().fluctuation, *(metric().fluctuation for metric in SIZED.values())} == {0.02}

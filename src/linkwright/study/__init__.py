"""Many designs of one mechanism: repeated solving, sweeps, sensitivities, comparison, parameter studies."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.study.compare import Comparison as Comparison
    from linkwright.study.compare import compare as compare
    from linkwright.study.designs import Sweep as Sweep
    from linkwright.study.designs import sweep as sweep
    from linkwright.study.prepared import Prepared as Prepared
    from linkwright.study.prepared import prepare as prepare
    from linkwright.study.sensitivity import Sensitivity as Sensitivity
    from linkwright.study.sensitivity import sensitivity as sensitivity
    from linkwright.study.study import Study as Study
    from linkwright.study.study import study as study

offer(__name__)

"""Many designs of one mechanism: repeated solving, sweeps, sensitivities, comparison, parameter studies."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.designs.compare import Comparison as Comparison
    from linkwright.designs.compare import compare as compare
    from linkwright.designs.designs import Sweep as Sweep
    from linkwright.designs.designs import sweep as sweep
    from linkwright.designs.prepared import Prepared as Prepared
    from linkwright.designs.prepared import prepare as prepare
    from linkwright.designs.sensitivity import Sensitivity as Sensitivity
    from linkwright.designs.sensitivity import sensitivity as sensitivity
    from linkwright.designs.study import Study as Study
    from linkwright.designs.study import study as study

offer(__name__)

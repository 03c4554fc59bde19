"""Many designs of one mechanism: repeated solving, sweeps, sensitivities, comparison, parameter studies."""

from linkwright.study.prepared import Prepared as Prepared
from linkwright.study.prepared import prepare as prepare

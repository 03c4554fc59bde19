"""Machine-part calculations: statics, beams, vibration, trajectories, optimisation programs, statistics.

Every calculation is a problem, from a small file (:func:`load`) or from its class, whose ``solve`` gives a result
with ``text``, ``worked``, ``data``, ``columns`` and ``plot``.
"""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.designs.tolerance.problem import Clearance as Clearance
    from linkwright.designs.tolerance.problem import Tolerance as Tolerance
    from linkwright.designs.tolerance.study import ToleranceStudy as ToleranceStudy
    from linkwright.parts.base import Problem as Problem
    from linkwright.parts.base import Result as Result
    from linkwright.parts.beams.beam import Beam as Beam
    from linkwright.parts.beams.beam import BeamLoad as BeamLoad
    from linkwright.parts.beams.beam import BeamSupport as BeamSupport
    from linkwright.parts.beams.link import LinkBending as LinkBending
    from linkwright.parts.beams.materials import Material as Material
    from linkwright.parts.beams.sections import Section as Section
    from linkwright.parts.fields import Numbers as Numbers
    from linkwright.parts.file import gallery_names as gallery_names
    from linkwright.parts.file import load as load
    from linkwright.parts.file import loads as loads
    from linkwright.parts.file import schema as schema
    from linkwright.parts.programs.problem import Variable as Variable
    from linkwright.parts.programs.program import Program as Program
    from linkwright.parts.statics.belt import Belt as Belt
    from linkwright.parts.statics.body import RigidBody as RigidBody
    from linkwright.parts.statics.body import Support as Support
    from linkwright.parts.statics.force_system import ForceSystem as ForceSystem
    from linkwright.parts.statics.forces import Along as Along
    from linkwright.parts.statics.forces import Force as Force
    from linkwright.parts.statics.rotor import BalancingPlane as BalancingPlane
    from linkwright.parts.statics.rotor import HeavyPoint as HeavyPoint
    from linkwright.parts.statics.rotor import Rotor as Rotor
    from linkwright.parts.statics.structure import equilibrium as equilibrium
    from linkwright.parts.statics.wedge import Wedge as Wedge
    from linkwright.parts.statistics.samples import Asked as Asked
    from linkwright.parts.statistics.samples import Fitting as Fitting
    from linkwright.parts.statistics.samples import Limits as Limits
    from linkwright.parts.statistics.samples import Samples as Samples
    from linkwright.parts.trajectories.conveyor import Conveyor as Conveyor
    from linkwright.parts.trajectories.particle import Particle as Particle
    from linkwright.parts.vibration.excitation import Excitation as Excitation
    from linkwright.parts.vibration.follower import FollowerSpring as FollowerSpring
    from linkwright.parts.vibration.mounts import Mounts as Mounts
    from linkwright.parts.vibration.system import Start as Start
    from linkwright.parts.vibration.system import Tie as Tie
    from linkwright.parts.vibration.system import VibratingSystem as VibratingSystem

offer(__name__)

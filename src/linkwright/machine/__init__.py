"""Machine dynamics at steady running: equivalent inertia and torque, motor, flywheel, true speed."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.machine.balancing import Balancing as Balancing
    from linkwright.machine.balancing import balance as balance
    from linkwright.machine.energy import EnergyFluctuation as EnergyFluctuation
    from linkwright.machine.energy import energy_fluctuation as energy_fluctuation
    from linkwright.machine.energy import fluctuation_from_areas as fluctuation_from_areas
    from linkwright.machine.equivalent import Equivalent as Equivalent
    from linkwright.machine.equivalent import equivalent as equivalent
    from linkwright.machine.equivalent import equivalent_inertia as equivalent_inertia
    from linkwright.machine.equivalent import equivalent_torque as equivalent_torque
    from linkwright.machine.equivalent import inertia_slope as inertia_slope
    from linkwright.machine.flywheel import FlywheelSize as FlywheelSize
    from linkwright.machine.flywheel import disk as disk
    from linkwright.machine.flywheel import flywheel_inertia as flywheel_inertia
    from linkwright.machine.flywheel import on_faster_shaft as on_faster_shaft
    from linkwright.machine.flywheel import rim as rim
    from linkwright.machine.flywheel import speed_fluctuation as speed_fluctuation
    from linkwright.machine.motor import Motor as Motor
    from linkwright.machine.motor import motor as motor
    from linkwright.machine.running import SteadyRunning as SteadyRunning
    from linkwright.machine.running import steady_running as steady_running
    from linkwright.machine.speed import SpeedCurve as SpeedCurve
    from linkwright.machine.speed import true_speed as true_speed
    from linkwright.machine.torque_curve import TorqueCurve as TorqueCurve

offer(__name__)

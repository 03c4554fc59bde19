"""Servos of the drivers, their laws as tables, and the key frame from which a model starts."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np

from linkwright.core.arrays import Floats
from linkwright.exporters.mjcf.bodies import Chains
from linkwright.exporters.mjcf.elements import HEAVY, numbers
from linkwright.mechanism.mechanism import Mechanism

#: Natural frequency of the position servo times the time step.
SERVO = 0.5
#: Samples of a law; MuJoCo 3 reads 500 numbers at most.
SAMPLES = 481


def reflected_inertia(chains: Chains) -> dict[str, float]:
    """Inertia (kg·m² or kg) of all links as each driver feels it, largest over the motion: Σ(m v² + I ω²)/q̇²."""
    motion, mechanism = chains.motion, chains.mechanism
    twice_energy = np.zeros(motion.steps)
    for name, link in mechanism.links.items():
        moving = motion.link(name)
        speed = (moving.centre.velocity**2).sum(axis=1)
        twice_energy += link.mass * speed + link.inertia * moving.angular_velocity**2
    most = float(np.nanmax(twice_energy, initial=0.0))
    found = {}
    for name, (_, rate, _) in motion.positions.coordinates.items():
        fastest = float(np.max(np.abs(rate), initial=0.0))
        found[name] = most / fastest**2 if most > 0 and fastest > 0 else 1.0
    return found


def steady(mechanism: Mechanism) -> bool:
    """Whether all drivers have a constant speed, so that no control changes."""
    return all(driver.law.constant_speed is not None for driver in mechanism.drivers.values())


def actuators(chains: Chains, reflected: dict[str, float], step: float) -> ET.Element:
    """Two servos a driver, on position and on rate; with constant speed the position is the rate's integral."""
    found = ET.Element("actuator")
    joints = chains.joint_of
    for name, driver in chains.mechanism.drivers.items():
        inertia = HEAVY * reflected[name]
        stiffness = inertia * (SERVO / step) ** 2
        gains = {"gainprm": numbers([stiffness]), "biastype": "affine", "biasprm": numbers([0.0, -stiffness, 0.0])}
        if driver.law.constant_speed is not None:
            gains["dyntype"] = "integrator"
        ET.SubElement(found, "general", {"name": name, "joint": joints[name], **gains})
        damping = numbers([2 * inertia * SERVO / step])
        ET.SubElement(found, "velocity", name=f"{name}.rate", joint=joints[name], kv=damping)
    return found


def controls(mechanism: Mechanism, times: Floats) -> Floats:
    """The controls of all drivers at times, (n, controls): position, or the rate of a constant speed, and rate."""
    found: list[Floats] = []
    for driver in mechanism.drivers.values():
        position, rate, _unused = driver.law.coordinate(times)
        found += [position if driver.law.constant_speed is None else rate, rate]
    return np.stack(found, axis=1)


def laws_and_ranges(chains: Chains) -> ET.Element:
    """Samples of the laws that are not a constant speed; of a constant speed over an open cycle its smallest and
    largest coordinate."""
    custom = ET.Element("custom")
    motion = chains.motion
    time = np.linspace(float(motion.time.min()), float(motion.time.max()), SAMPLES)
    for name, driver in chains.mechanism.drivers.items():
        if driver.law.constant_speed is None:
            position, rate, _ = driver.law.coordinate(time)
            for kind, values in (("time", time), ("position", position), ("rate", rate)):
                ET.SubElement(custom, "numeric", name=f"{name}.{kind}", data=numbers(values))
        elif motion.positions.cycle and not motion.positions.closed:
            ends = sorted(motion.inputs[name][[0, -1]])
            ET.SubElement(custom, "numeric", name=f"{name}.range", data=numbers(ends))
    return custom


def key(chains: Chains) -> ET.Element:
    """The key frame ``start``: coordinates, rates, states of integrators and controls."""
    index, motion = chains.index, chains.motion
    states, signals = [], []
    for name, driver in chains.mechanism.drivers.items():
        position, rate, _ = (values[index] for values in motion.positions.coordinates[name])
        constant = driver.law.constant_speed is not None
        states += [position] if constant else []
        signals += [rate if constant else position, rate]
    attributes = {
        "name": "start",
        "time": numbers([motion.time[index]]),
        "qpos": numbers(each.values[index] for each in chains.coordinates),
        "qvel": numbers(each.rates[index] for each in chains.coordinates),
    }
    attributes |= {name: numbers(values) for name, values in (("act", states), ("ctrl", signals)) if values}
    frame = ET.Element("keyframe")
    ET.SubElement(frame, "key", attributes)
    return frame

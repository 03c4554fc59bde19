"""Drivers of a MuJoCo model: servos on their joints, their laws, and the key frame to start from."""

from __future__ import annotations

import xml.etree.ElementTree as ET

import numpy as np

from linkwright.exporters.mjcf.bodies import HEAVY, Bodies, numbers
from linkwright.exporters.results import Results

#: Natural frequency of the position servo times the time step.
SERVO = 0.2
SAMPLES = 241


def reflected_inertia(results: Results) -> dict[str, float]:
    """Inertia (kg·m² or kg) of all links as each driver feels it, largest over the motion: Σ(m v² + I ω²)/q̇²."""
    motion, mechanism = results.motion, results.mechanism
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


def actuators(results: Results, bodies: Bodies, step: float) -> ET.Element:
    """Two servos a driver, on position and on rate; with constant speed the position is the rate's integral."""
    found = ET.Element("actuator")
    for name, driver in results.mechanism.drivers.items():
        inertia = HEAVY * bodies.reflected[name]
        stiffness = inertia * (SERVO / step) ** 2
        gains = {"gainprm": numbers([stiffness]), "biastype": "affine", "biasprm": numbers([0.0, -stiffness, 0.0])}
        if driver.law.constant_speed is not None:
            gains["dyntype"] = "integrator"
        ET.SubElement(found, "general", {"name": name, "joint": bodies.joint_of[name], **gains})
        damping = numbers([2 * inertia * SERVO / step])
        ET.SubElement(found, "velocity", name=f"{name}.rate", joint=bodies.joint_of[name], kv=damping)
    return found


def laws(results: Results) -> ET.Element:
    """Samples of the laws that are not a constant speed."""
    custom = ET.Element("custom")
    time = np.linspace(float(results.motion.time.min()), float(results.motion.time.max()), SAMPLES)
    for name, driver in results.mechanism.drivers.items():
        if driver.law.constant_speed is None:
            position, rate, _ = driver.law.coordinate(time)
            for kind, values in (("time", time), ("position", position), ("rate", rate)):
                ET.SubElement(custom, "numeric", name=f"{name}.{kind}", data=numbers(values))
    return custom


def key(results: Results, bodies: Bodies, index: int) -> ET.Element:
    """The key frame ``start``: coordinates, rates, states of integrators and controls."""
    coordinates = results.motion.positions.coordinates
    states, controls = [], []
    for name, driver in results.mechanism.drivers.items():
        position, rate, _ = (values[index] for values in coordinates[name])
        steady = driver.law.constant_speed is not None
        states += [position] if steady else []
        controls += [rate if steady else position, rate]
    frame = ET.Element("keyframe")
    attributes = {
        "name": "start",
        "time": numbers([results.motion.time[index]]),
        "qpos": numbers(each.value for each in bodies.coordinates),
        "qvel": numbers(each.rate for each in bodies.coordinates),
    }
    signals = {"act": states, "ctrl": controls}
    attributes |= {name: numbers(values) for name, values in signals.items() if values}
    ET.SubElement(frame, "key", attributes)
    return frame

"""Sheets that students might hand in: worked by plain arithmetic of its own, with one of the usual mistakes in it.

Nothing of the package is used. ``python -m tests.course_mistakes`` has a thousand of them graded.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

FOUR_BAR = """
format: 1
name: Four-bar with masses
frame: {points: {O1: [0 m, 0 m], O4: [-0.5 m, 0.1 m]}}
links:
  crank: {points: [O1, A], length: 0.12 m}
  coupler: {points: [A, B], length: 0.42 m, mass: 3 kg, inertia: 0.4 kg·m², mass_centre: [0.12 m, 0 m]}
  rocker: {points: [O4, B], length: 0.35 m, mass: 4 kg, inertia: 0.6 kg·m², mass_centre: [0.22 m, 0 m]}
assembly: {B: right}
driver: {turn: crank, about: O1, speed: 300 rpm}
gravity: [0, -9.81 m/s²]
course:
  at: 70 deg
  vary: {crank.length: 8 %, coupler.length: 8 %, rocker.length: 8 %}
  ask: [coupler.angle, rocker.angle, coupler.angular_velocity, rocker.angular_velocity, coupler.angular_acceleration,
        rocker.angular_acceleration, B on coupler.magnitude, O4 on rocker.magnitude, driver.effort]
"""
LEVER = """
format: 1
name: Slotted lever
frame: {points: {O1: [0 m, 0 m], O3: [0 m, -0.4 m]}}
links:
  crank: {points: [O1, A], length: 0.12 m}
  die: {points: [A]}
  lever: {points: [O3, E], length: 0.6 m, mass: 8 kg, inertia: 0.9 kg·m², mass_centre: [0.2 m, 0 m]}
joints: {slot: {kind: prismatic, guide: lever, through: O3, direction: [O3, E], block: die, at: A}}
assembly: {slot: forward}
driver: {turn: crank, about: O1, speed: 120 rpm}
gravity: [0, -9.81 m/s²]
course:
  at: 130 deg
  vary: {crank.length: 8 %, lever.mass: 10 %}
  ask: [lever.angle, slot.displacement, lever.angular_velocity, slot.velocity, lever.angular_acceleration,
        slot.acceleration, O3 on lever.magnitude, driver.effort]
"""
G = 9.81


@dataclass
class Pen:
    """Writes a sheet; ``slip``: the mistake that it makes, ``where`` there are several places."""

    slip: str = ""
    where: str = ""
    used: set[str] = field(default_factory=set)

    def makes(self, slip: str, where: str = "") -> bool:
        """Whether the mistake is made here."""
        return self.slip == slip and self.where in ("", where)

    def quotient(self, terms: tuple[float, float], below: tuple[float, ...], name: str) -> float:
        """(a + b) / (c d …), or with its parentheses forgotten above or below."""
        whole = math.prod(below)
        if self.makes("missing_parenthesis", f"{name} above"):
            return terms[0] + terms[1] / whole
        if self.makes("missing_parenthesis", f"{name} below"):
            return sum(terms) / below[0] * math.prod(below[1:])
        return sum(terms) / whole

    def arctangent(self, y: float, x: float) -> float:
        """The direction of (x, y), or its tangent's principal value."""
        return math.atan(y / x) if self.makes("arctangent_quadrant") else math.atan2(y, x)

    def input(self, degrees: float) -> float:
        """The input's angle in radians, or its degrees."""
        return degrees if self.makes("degrees_for_radians", "input") else math.radians(degrees)

    def speed(self, rpm: float) -> float:
        """The speed in rad/s, or in revolutions per minute."""
        return rpm if self.makes("rpm_for_radians") else rpm * 2 * math.pi / 60

    def couple(self, inertia: float, alpha: float, link: str) -> float:
        """The inertia couple."""
        return inertia * alpha if self.makes("inertia_couple_sign", link) else -inertia * alpha

    def centre(self, distance: float, length: float, link: str) -> float:
        """Distance of the mass centre from the link's first point."""
        return length - distance if self.makes("mass_centre_wrong_end", link) else distance

    def answered(self, angle: float) -> float:
        """An angle as it is answered, in degrees unless they are forgotten."""
        return angle if self.makes("degrees_for_radians", "answer") else math.degrees(angle)


def four_bar(crank: float, coupler: float, rocker: float, pen: Pen) -> dict[str, float]:
    """Positions by circles, rates by Cramer's rule, forces group by group; side: B right of the ray A→O4."""
    theta, w = pen.input(70.0), pen.speed(300.0)
    dx4, dy4 = -0.5, 0.1
    ax, ay = crank * math.cos(theta), crank * math.sin(theta)
    vax, vay = -w * ay, w * ax
    aax, aay = -w * w * ax, -w * w * ay
    dx, dy = dx4 - ax, dy4 - ay
    dd = dx * dx + dy * dy
    t = dd + coupler**2 - rocker**2
    root = math.sqrt(4 * coupler**2 * dd - t * t)
    side = 1.0 if pen.makes("wrong_assembly_mode") else -1.0
    bx = ax + pen.quotient((t * dx, -side * root * dy), (2.0, dd), "B")
    by = ay + pen.quotient((t * dy, side * root * dx), (2.0, dd), "B")
    p2, p3 = pen.arctangent(by - ay, bx - ax), pen.arctangent(by - dy4, bx - dx4)
    rx, ry, sx, sy = bx - ax, by - ay, bx - dx4, by - dy4
    # v_A + w2 × r = w3 × s
    j = ((ry, -sy), (-rx, sx))
    det = j[0][0] * j[1][1] - j[0][1] * j[1][0]
    w2 = pen.quotient((vax * j[1][1], -j[0][1] * vay), (det,), "w2")
    w3 = pen.quotient((j[0][0] * vay, -vax * j[1][0]), (det,), "w3")
    cx = aax - w2 * w2 * rx + w3 * w3 * sx
    cy = aay - w2 * w2 * ry + w3 * w3 * sy
    e2 = pen.quotient((cx * j[1][1], -j[0][1] * cy), (det,), "e2")
    e3 = pen.quotient((j[0][0] * cy, -cx * j[1][0]), (det,), "e3")
    g2, g3 = pen.centre(0.12, coupler, "coupler"), pen.centre(0.22, rocker, "rocker")
    ux, uy, vx, vy = g2 * math.cos(p2), g2 * math.sin(p2), g3 * math.cos(p3), g3 * math.sin(p3)
    k2x, k2y = -3 * (aax - e2 * uy - w2 * w2 * ux), 3 * (-G - (aay + e2 * ux - w2 * w2 * uy))
    k3x, k3y = -4 * (-e3 * vy - w3 * w3 * vx), 4 * (-G - (e3 * vx - w3 * w3 * vy))
    m2, m3 = pen.couple(0.4, e2, "coupler"), pen.couple(0.6, e3, "rocker")
    # force F of the coupler on the rocker at B: moments about A (coupler) and O4 (rocker)
    q2 = ux * k2y - uy * k2x + m2
    q3 = vx * k3y - vy * k3x + m3
    # rocker: sx Fy - sy Fx + q3 = 0; coupler: -(rx Fy - ry Fx) + q2 = 0
    det = sy * rx - sx * ry
    fx, fy = (rx * q3 + sx * q2) / det, (sy * q2 + ry * q3) / det
    o4x, o4y = -(fx + k3x), -(fy + k3y)
    # coupler at A: force of the crank on it
    apx, apy = fx - k2x, fy - k2y
    effort = ax * apy - ay * apx
    return {
        "coupler.angle": pen.answered(p2),
        "rocker.angle": pen.answered(p3),
        "coupler.angular_velocity": w2,
        "rocker.angular_velocity": w3,
        "coupler.angular_acceleration": e2,
        "rocker.angular_acceleration": e3,
        "B on coupler.magnitude": math.hypot(fx, fy),
        "O4 on rocker.magnitude": math.hypot(o4x, o4y),
        "driver.effort": effort,
    }


def lever(crank: float, mass: float, pen: Pen) -> dict[str, float]:
    """The die's place, rates resolved along and across the slot, the lever's moments about its pivot."""
    theta, w = pen.input(130.0), pen.speed(120.0)
    ax, ay = crank * math.cos(theta), crank * math.sin(theta)
    vax, vay, aax, aay = -w * ay, w * ax, -w * w * ax, -w * w * ay
    x, y = ax, ay + 0.4
    s = math.hypot(x, y) * (-1.0 if pen.makes("wrong_assembly_mode") else 1.0)
    nx, ny = x / s, y / s
    phi = pen.arctangent(ny, nx)
    along, across = vax * nx + vay * ny, -vax * ny + vay * nx
    omega = across / s
    coriolis = 0.0 if pen.makes("missing_coriolis") else 2 * omega * along
    second = aax * nx + aay * ny + omega * omega * s
    alpha = (-aax * ny + aay * nx - coriolis) / s
    g = pen.centre(0.2, 0.6, "lever")
    gx, gy = g * math.cos(phi), g * math.sin(phi)
    kx, ky = -mass * (-alpha * gy - omega * omega * gx), mass * (-G - (alpha * gx - omega * omega * gy))
    moment = gx * ky - gy * kx + pen.couple(0.9, alpha, "lever")
    push = -moment / s  # of the die on the lever, across the slot
    fx, fy = -push * ny, push * nx
    o3 = math.hypot(fx + kx, fy + ky)
    return {
        "lever.angle": pen.answered(phi),
        "slot.displacement": s,
        "lever.angular_velocity": omega,
        "slot.velocity": along,
        "lever.angular_acceleration": alpha,
        "slot.acceleration": second,
        "O3 on lever.magnitude": o3,
        "driver.effort": ax * fy - ay * fx,
    }


#: Mistakes with the places where they can be made, by task.
SLIPS = {
    "four_bar": (
        ("degrees_for_radians", "input"),
        ("degrees_for_radians", "answer"),
        ("wrong_assembly_mode", ""),
        ("missing_parenthesis", "B above"),
        ("missing_parenthesis", "B below"),
        ("missing_parenthesis", "w2 above"),
        ("missing_parenthesis", "w3 above"),
        ("missing_parenthesis", "e2 above"),
        ("missing_parenthesis", "e3 above"),
        ("arctangent_quadrant", ""),
        ("inertia_couple_sign", ""),
        ("inertia_couple_sign", "coupler"),
        ("inertia_couple_sign", "rocker"),
        ("mass_centre_wrong_end", ""),
        ("mass_centre_wrong_end", "coupler"),
        ("mass_centre_wrong_end", "rocker"),
        ("rpm_for_radians", ""),
    ),
    "lever": (
        ("degrees_for_radians", "input"),
        ("degrees_for_radians", "answer"),
        ("wrong_assembly_mode", ""),
        ("arctangent_quadrant", ""),
        ("inertia_couple_sign", ""),
        ("missing_coriolis", ""),
        ("mass_centre_wrong_end", ""),
        ("rpm_for_radians", ""),
    ),
}

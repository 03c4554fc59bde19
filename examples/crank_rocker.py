"""A crank-rocker built in code: positions over a turn, swing, quick return and transmission angle."""

from math import degrees, pi

import numpy as np

import linkwright as lw

CRANK, COUPLER, ROCKER, FRAME = 0.060, 0.160, 0.120, 0.180  # m

model = lw.Model("crank-rocker")
model.frame(O1=(0, 0), O2=(FRAME, 0))
model.link("crank", ["O1", "A"], length=CRANK)
model.link("coupler", ["A", "B"], length=COUPLER)
model.link("rocker", ["O2", "B"], length=ROCKER)
model.assemble(B="left")
model.drive("crank", about="O1", speed="120 rpm")
machine = model.build()
print(lw.structure(machine).text())

motion = lw.solve_motion(machine, steps=12)
rocker = motion.link("rocker")
print("crank, °   rocker, °   rocker, rad/s")
for crank, angle, velocity in zip(motion.input, rocker.angle, rocker.angular_velocity, strict=True):
    print(f"{degrees(crank):8.1f}{degrees(angle):12.3f}{velocity:16.4f}")

# Metrics belong to the continuous cycle, not to the solved positions.
table = lw.metrics(motion, ["swing_angle", "quick_return_ratio", "transmission_angle"])
print(table.text())

# By hand: at the limits coupler and crank are in line, stretched (sum) or folded (difference); law of cosines.
reach = np.array([COUPLER + CRANK, COUPLER - CRANK])
at_rocker = np.arccos((FRAME**2 + ROCKER**2 - reach**2) / (2 * FRAME * ROCKER))
at_crank = np.arccos((FRAME**2 + reach**2 - ROCKER**2) / (2 * FRAME * reach))
swing, theta = at_rocker[0] - at_rocker[1], abs(at_crank[0] - at_crank[1])
quick_return = (pi + theta) / (pi - theta)
pins = np.array([FRAME - CRANK, FRAME + CRANK])  # distance A to O2 with crank and frame in line
worst = np.arccos(abs(COUPLER**2 + ROCKER**2 - pins**2) / (2 * COUPLER * ROCKER)).min()
print(f"by hand: swing {degrees(swing):.4f}°, K {quick_return:.5f}, transmission angle {degrees(worst):.4f}°")

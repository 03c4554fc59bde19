"""Joint forces, drive torque, motor and flywheel of a six-bar jaw crusher, and its forces drawn to scale."""

import numpy as np

import linkwright as lw

crusher = lw.load("gallery:jaw_crusher_sixbar")
motion = lw.solve_motion(crusher, steps=360)
forces = lw.solve_forces(motion)

pivot = np.hypot(*forces.reaction("O5", on="jaw").T)  # N
torque = forces.input_torque  # N·m, counter-clockwise positive
print(f"pivot of the jaw: {pivot.max() / 1e3:.2f} kN, crank: {torque.min():.0f} to {torque.max():.0f} N·m")
print(f"power of the crank less that of all other forces: {np.abs(forces.power_residual).max():.0e} W")

# Metrics lie between the positions, too: the crushing force ends at a limit position of the jaw.
peaks = lw.metrics(forces, ["peak_reaction", "peak_input_torque"])
print(peaks.text())

running = lw.steady_running(forces, fluctuation=0.03, efficiency=0.9, margin=1.2)
print(running.text())

peak = peaks["peak_reaction", "O5"].at  # rad
picture = lw.draw(motion, at=peak, forces=forces)
print("written:", picture.save("crusher.svg", force=True))

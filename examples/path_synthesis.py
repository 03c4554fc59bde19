"""Four-bars whose coupler point passes five given points; the best one is solved and all are written as models."""

import numpy as np

import linkwright as lw

POINTS = np.array([(20, 20), (20, 30), (20, 40), (18, 48), (12, 52)]) * 1e-3  # m

found = lw.path_generation(POINTS, count=4)
print(found.text())

machine = found.best.mechanism()
curve = lw.solve_motion(machine, steps=3600).point("P").position  # (3600, 2) m
distances = np.array([np.hypot(*(curve - point).T).min() for point in POINTS])
print("distances of the points from the solved positions, mm:", np.round(distances * 1e3, 3))

for path in found.write(".", "conveyor", force=True):
    print("written:", path)

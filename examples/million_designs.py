"""A million crank-rockers in one sweep; then exact gradients lead from the best of them to the optimum."""

import time

import numpy as np
from scipy.optimize import minimize

import linkwright as lw

COUNT, ANGLE = 1_000_000, np.radians(40)
SWING, TRANSMISSION = "rocker.angle range", "transmission_angle B min"

machine = lw.load("gallery:crank_rocker")
nominal = {name: machine.dimensions()[name] for name in ("crank.length", "coupler.length", "rocker.length")}
bounds = [(0.9 * value, 1.1 * value) for value in nominal.values()]
random = np.random.default_rng(1)
lengths = {name: random.uniform(*bound, COUNT) for name, bound in zip(nominal, bounds, strict=True)}

began = time.perf_counter()
designs = lw.sweep(machine, lengths, outputs=[SWING, TRANSMISSION], steps=90)
print(f"{designs.ok.sum()} of {COUNT} designs pass the cycle; {time.perf_counter() - began:.1f} s")

good = designs.ok & (designs[TRANSMISSION] > ANGLE)
best = np.argmax(np.where(good, designs[SWING], 0.0))
start = [values[best] for values in lengths.values()]
print(f"largest swing with 40° or more: {np.degrees(designs[SWING][best]):.3f}°")

swing = lw.objective(machine, SWING, vary=list(nominal))
transmission = lw.objective(machine, TRANSMISSION, vary=list(nominal))
found = minimize(
    lambda x: tuple(-part for part in swing(x)),
    start,
    jac=True,
    method="SLSQP",
    bounds=bounds,
    constraints={"type": "ineq", "fun": lambda x: transmission(x)[0] - ANGLE, "jac": lambda x: transmission(x)[1]},
    options={"ftol": 1e-12},
)
print(f"by gradients: {np.degrees(-found.fun):.3f}° in {found.nit} steps, lengths {found.x.round(4)} m")

"""A slot along a spline as a package of its own has it, and what must work with it; run by the installed one.

The lever's angle is found by bisection on SciPy's spline, its rates by differences, its torque from the energy.
"""

PROGRAM = r'''
from scipy.interpolate import CubicSpline
from scipy.optimize import brentq, minimize_scalar
CURVED = """
format: 1
name: lever with a curved slot
frame: {points: {O: [0 m, 0 m], Q: [0 m, -0.3 m]}}
links:
  crank: {points: [O, A], length: 0.1 m, mass: 1 kg, inertia: 0.01 kg·m²}
  lever: {points: [Q, E], length: 0.6 m, mass: 2 kg, inertia: 0.05 kg·m²}
joints: {slot: {kind: curved_slot, guide: lever, through: Q, block: crank, at: A}}
drawing: {A: [0.1 m, 0 m], E: [0.19 m, 0.27 m]}
driver: {turn: crank, about: O, speed: 60 rpm}
gravity: [0, -9.81 m/s²]
loads: {gust: {kind: wind, on: lever, at: E, size: 20 N}}
"""
curve = CubicSpline([0.1, 0.2, 0.3, 0.4, 0.5], [0.0, 0.01, 0.0, -0.02, 0.0], bc_type="not-a-knot")
def lever(input, length=0.1):
    """The lever's angle, rad."""
    pin = length * np.exp(1j * input) + 0.3j
    def gap(angle):
        place = pin * np.exp(-1j * angle)
        return place.imag - curve(place.real)
    middle = np.angle(pin)
    return brentq(gap, middle - 0.3, middle + 0.3, xtol=1e-15)
def energy(input, length=0.1):
    """Potential energy of the weights and the wind, and half of it by the speeds at 2π rad/s, J."""
    angle = lever(input, length)
    height = 9.81 * (1.0 * 0.5 * length * np.sin(input) + 2.0 * 0.3 * np.sin(angle))
    return height - 20.0 * 0.6 * np.cos(angle)
def slope(f, x, h=2e-4):
    return (8 * (f(x + h) - f(x - h)) - (f(x + 2 * h) - f(x - 2 * h))) / (12 * h)
def kinetic(input, length=0.1):
    w, v = 2 * np.pi, 2 * np.pi * slope(lambda x: lever(x, length), input)
    return 0.5 * ((0.01 + 0.25 * length**2) * w * w + (0.05 + 2.0 * 0.09) * v * v)
def torque(input, length=0.1):
    return slope(lambda x: energy(x, length) + kinetic(x, length), input, 1e-3)
curved = lw.loads(CURVED)
found = lw.solve_forces(lw.solve_motion(curved, steps=24))
motion = found.motion
angles = np.array([lever(x) for x in motion.input])
assert np.abs(np.exp(1j * motion.link("lever").angle) - np.exp(1j * angles)).max() < 1e-12
rates = 2 * np.pi * np.array([slope(lever, x) for x in motion.input])
assert np.abs(motion.link("lever").angular_velocity - rates).max() < 1e-7
knots = np.array([np.abs(np.subtract([0.2, 0.3, 0.4], abs(0.1 * np.exp(1j * x) + 0.3j))).min() for x in motion.input])
away = knots > 2e-3  # at a knot the third derivative jumps, and with it the error of differences
wanted = np.array([torque(x) for x in motion.input])
assert away.sum() > 18 and np.abs(found.input_torque - wanted)[away].max() < 1e-5 * np.abs(wanted).max()
assert found.balance_residual.max() < 1e-9 and np.abs(found.power_residual).max() < 1e-9
lengths = np.array([0.09, 0.1, 0.11])
swept = lw.sweep(curved, {"crank.length": lengths}, outputs=[("lever.angle", "range")], steps=24)
for length, span in zip(lengths, swept["lever.angle", "range"]):
    every = np.unwrap([lever(x, length) for x in motion.input])
    assert abs(span - np.ptp(every)) < 1e-9, (length, span, np.ptp(every))
problem = lw.objective(curved, "driver.effort rms", vary=["crank.length", "frame.Q.y", "lever.length"], steps=24)
value, gradient = problem(problem.start)
for k, step in enumerate(np.eye(3) * 1e-5):
    near = [problem(problem.start + sign * step)[0] for sign in (1.0, -1.0)]
    assert abs((near[0] - near[1]) / 2e-5 - gradient[k]) < 1e-5 * np.abs(gradient).max(), k
assert lw.input_range(curved).full
lean = lever(0.0)
end = 0.6 * complex(np.exp(1j * lean)) - 0.3j
drawn = f"E: [{end.real!r} m, {end.imag!r} m]"
driven = CURVED.replace("turn: crank, about: O", f"turn: lever, about: Q, start: {lean!r} rad")
swung = lw.input_range(lw.loads(driven.replace("E: [0.19 m, 0.27 m]", drawn)))
for end, sign in ((swung.start, 1.0), (swung.end, -1.0)):
    least = min((minimize_scalar(lambda x: sign * lever(x), bounds=(a, a + 1.0), method="bounded",
        options={"xatol": 1e-12}).fun for a in np.arange(-4.0, 4.0, 0.5)))
    assert abs(end - sign * least) < 1e-9, (end, sign * least)
open("curved.yaml", "w").write(CURVED)
assert main(["check", "curved.yaml"]) == 0
assert main(["draw", "curved.yaml", "--output", "curved.svg"]) == 0
assert open("curved.svg").read().count('<circle class="lw-ground"') == 1
assert main(["export", "curved.yaml", "--to", "curved.html"]) == 0
print("the curved slot too")
'''

"""Numbers of a cycle by quadrature over very many positions."""

import numpy as np

import linkwright as lw


def dense(machine: lw.Mechanism, period: float, panels: int = 360) -> tuple[float, float]:
    """Mean power and root mean square torque: panels that are halved until rules of 13 places with their ends agree,
    as the ends see jumps beside them."""
    places = -np.cos(np.pi * np.arange(13) / 12)
    weights = np.linalg.solve(np.polynomial.legendre.legvander(places, 12).T, np.eye(13)[0] * 2.0)

    def integrals(low: np.ndarray, high: np.ndarray) -> np.ndarray:
        half = 0.5 * (high - low)
        time = low[:, None] + half[:, None] * (1.0 + places)
        torque = lw.solve_forces(lw.solve_motion(machine, times=time.ravel())).input_torque
        torque = torque.reshape(time.shape)
        return np.stack([(torque @ weights) * half, (torque**2 @ weights) * half])

    low = np.linspace(0.0, period, panels + 1)
    low, high = low[:-1], low[1:]
    known, total = integrals(low, high), np.zeros(2)
    limit = 1e-14 * np.abs(known).sum(axis=1)[:, None]
    for _ in range(44):
        middle = 0.5 * (low + high)
        first, second = integrals(low, middle), integrals(middle, high)
        rough = (np.abs(first + second - known) > limit).any(axis=0)
        total += (first + second)[:, ~rough].sum(axis=1)
        low, high = np.append(low[rough], middle[rough]), np.append(middle[rough], high[rough])
        known = np.concatenate([first[:, rough], second[:, rough]], axis=1)
        if not len(low):
            break
    mean, square = (total + known.sum(axis=1)) / period
    (driver,) = machine.drivers.values()
    return mean * driver.law.constant_speed, np.sqrt(square)

"""Engineering statistics: samples described, fitted, tested, regressed; process capability."""

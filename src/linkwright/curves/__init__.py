"""Functions as polynomials on pieces of their way: integrals, means and extremes."""

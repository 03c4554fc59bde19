"""Bending: beams on any supports, and the links of mechanisms under their own loads.

Signs: x to the right, y and the deflection w up, forces and line loads q up, couples counter-clockwise. Shear force
V(x) is the sum of the forces left of x, bending moment M positive where the beam sags: V' = q, M' = V, EI w'' = M.
"""

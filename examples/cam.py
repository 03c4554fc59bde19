"""A plate cam from its motion program: base circle and spring chosen, checks, profile as DXF for a mill."""

from math import radians

import numpy as np

import linkwright as lw

LIFT, RISE = 0.024, radians(100)  # m, rad of the cam

program = lw.MotionProgram(
    (
        lw.Segment(RISE, rise=LIFT, law="polynomial_345"),
        lw.Segment(radians(60)),  # dwell
        lw.Segment(radians(100), to=0.0, law="cycloidal"),
        lw.Segment(radians(100)),
    )
)
cam = lw.Cam(
    program,
    lw.Follower(kind="roller", roller_radius=0.010),
    limits=lw.CamLimits(pressure_angle=radians(30), curvature_radius=0.008, contact_force=20.0),
    loading=lw.CamLoading(speed=31.4, mass=1.2),
    spring_wanted=True,
)
design = cam.solve()
print(design.text())

profile = design.profile(720)  # (720, 2) m, exact points
print(f"base circle {design.cam.base_radius * 1e3:.2f} mm, largest radius {np.hypot(*profile.T).max() * 1e3:.2f} mm")
print("written:", design.save_profile("cam.dxf", force=True))
print("written:", design.draw(RISE / 2).save("cam.svg", force=True))

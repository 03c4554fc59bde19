"""The command ``cam``."""

WORDS = {
    "summary": "cams: profile, checks, diagrams, points for a mill",
    "description": """\
Makes a cam from the motion program in a file: the profile for a roller, knife-edge or
flat-faced follower, translating or oscillating, a groove, a conjugate pair or a barrel
cam; pressure angle, curvature, undercut, spring, contact force and pressure, torque,
vibration; what is left out (base circle, offset, roller, spring) is chosen.""",
    "kind_help": "kind of diagram for --plot",
    "profile_help": "write the profile to a .dxf, .csv or .txt file (x y z in mm for a mill)",
    "points_help": "points of the profile (default: 720)",
    "draw_help": "draw cam and follower in a .svg, .pdf or .png file",
    "at_help": "angle of the cam in the drawing, degrees (default: 0)",
    "bad_angle": "--at is {angle}; give an angle in degrees",
}

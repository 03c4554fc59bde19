"""Titles of published cases."""

WORDS = {
    "crusher_kinematics": "Jaw crusher, six-bar, kinematics",
    "crusher_forces": "Jaw crusher, six-bar, forces with the load as coded in the report",
    "crusher_fourbar": "Jaw crusher, four-bar, first row",
    "conveyor": "Swinging conveyor, positions of the outer limit",
    "press_metrics": "Offset slider-crank of the flat-bed press",
    "press_synthesis": "Slider-crank of the press from stroke, connecting-rod ratio and eccentricity",
    "shifted_gears": "Pair of shifted gears, m 3, z 12 and 24",
    "ring_and_pinion": "Ring and pinion, m 3, z 16 and 24",
    "involute": "Involute function",
    "turning_moment": "Turning moment diagram of six areas",
    "engine_mean": "Engine against its mean torque",
    "engine_varying": "Engine against a varying load",
    "two_bars": "Two heavy bars in equilibrium",
    "bracket": "Wall bracket",
    "wyndor": "Production mix of Wyndor Glass",
    "five_points": "Five timed points, phase, pivot and direction given",
    "eighteen_points": "Eighteen timed points",
    "peak_factors": "Peak factors of motion laws",
    "norris": "Regression of the data set Norris",
}

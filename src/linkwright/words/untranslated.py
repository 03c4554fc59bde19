"""Texts that are the same in every language: examples of commands, symbols."""

WORDS = {
    "beam.examples": """\
linkwright beam gallery:cantilever
linkwright beam gallery:propped_cantilever --worked
linkwright beam gallery:pitman_bending --plot bending.svg""",
    "cams.drawing": "{name}",
    "optimize.examples": """\
linkwright optimize crusher.yaml --output better.yaml
linkwright optimize gallery:jaw_crusher_sixbar --vary pitman.length=1.1..1.4m toggle.length=1..1.3m \\
    --minimize peak_input_torque --keep "jaw.angle range=same within 1 %"
linkwright optimize crusher.yaml --minimize peak_input_torque flywheel --plot front.svg --state front.state""",
    "program.examples": """\
linkwright program gallery:production_mix
linkwright program gallery:lightest_spring --worked
linkwright program gallery:gear_pair --json""",
    "report.name_paragraph": "{number}",
    "report.name_source": "{number}",
    "statics.examples": """\
linkwright statics gallery:force_system
linkwright statics gallery:two_bars_equilibrium --worked
linkwright statics bracket.yaml --plot bracket.svg""",
    "statics.pull": "T1 − T2",
    "statistics.examples": """\
linkwright statistics gallery:shaft_diameters
linkwright statistics gallery:spring_rate --plot rate.svg
linkwright statistics gallery:shaft_diameters --worked --lang zh""",
    "statistics.sigma": "σ",
    "study.examples": """\
linkwright study gallery:jaw_crusher_sixbar --vary "pitman.length=1.2..1.3 m:11"
linkwright study crusher.yaml --vary "pitman.length=1.2..1.3 m:5" "jaw.mass=700, 900 kg" \\
    --metrics peak_input_torque "reaction O5 on jaw max" --output study.csv
linkwright study linkage.yaml --vary "coupler.length=2..4 m" --sampling sobol --samples 256""",
    "synthesize.examples": """\
linkwright synthesize slider_crank stroke="397.5 mm" rod_ratio=3.55 offset_ratio=0.305
linkwright synthesize crank_rocker swing_angle="40 deg" quick_return_ratio=1.2 frame="300 mm" --output designs
linkwright synthesize path points="[[20, 20], [20, 30], [20, 40]]" unit=mm --plot path.svg
linkwright synthesize free_curve file=letter.svg joints=10 --output designs --plot letter.png
linkwright synthesize press.yaml --json""",
    "synthesize.column.transmission": "μ min",
    "synthesize.values": "  {values}",
    "synthesize.motion.defects": "{defects}",
    "tolerance.examples": """\
linkwright tolerance gallery:crank_rocker_tolerance
linkwright tolerance gallery:pressed_pins --plot pins.svg
linkwright tolerance study.yaml --output machines.csv""",
    "tolerance.part": "∂y/∂p = {slope}",
    "trajectory.examples": """\
linkwright trajectory gallery:thrown_ball
linkwright trajectory gallery:conveyor_load --plot load.svg
linkwright trajectory gallery:conveyor_load --worked""",
    "vibration.examples": """\
linkwright vibration gallery:two_masses
linkwright vibration gallery:tuned_absorber --plot absorber.svg
linkwright vibration gallery:machine_on_mounts --worked""",
    "vibration.mode": "f{index}",
    "vibration.step_modes": "det(K − ω²M) = 0",
}

"""Texts that are the same in every language: examples of commands, symbols."""

WORDS = {
    "optimize.examples": """\
linkwright optimize crusher.yaml --output better.yaml
linkwright optimize gallery:jaw_crusher_sixbar --vary pitman.length=1.1..1.4m toggle.length=1..1.3m \\
    --minimize peak_input_torque --keep "jaw.angle range=same within 1 %"
linkwright optimize crusher.yaml --minimize peak_input_torque flywheel --plot front.svg --state front.state""",
    "report.name_paragraph": "{number}",
    "report.name_source": "{number}",
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
}

"""Texts that are the same in every language: examples of commands, symbols."""

WORDS = {
    "animate.examples": """\
linkwright animate gallery:theo_jansen_leg --paths leg.T --output leg.svg
linkwright animate crusher.yaml --paths C --curves jaw.angle --output crusher.gif
linkwright animate crusher.yaml --forces --curves driver.effort --seconds 4 --output crusher.mp4""",
    "balance.examples": """\
linkwright balance gallery:jaw_crusher_fourbar --radius "crank=200 mm, jaw=500 mm"
linkwright balance press.yaml --radius 120mm --share 0.5
linkwright balance linkage.yaml --radius 80mm --output balanced.yaml""",
    "balance.column.x": "x mm",
    "balance.column.y": "y mm",
    "beam.examples": """\
linkwright beam gallery:cantilever
linkwright beam gallery:propped_cantilever --worked
linkwright beam gallery:pitman_bending --plot bending.svg""",
    "cam.examples": """\
linkwright cam gallery:cam_flat_face
linkwright cam gallery:cam_roller --plot motion.svg --draw cam.svg
linkwright cam gallery:cam_roller --kind cam_profile --plot pressure.svg
linkwright cam gallery:cam_roller --profile cam.dxf --points 1440""",
    "cams.drawing": "{name}",
    "completion.examples": "linkwright completion bash >> ~/.bashrc\nlinkwright completion zsh > "
    "~/.zfunc/_linkwright\nlinkwright completion fish > ~/.config/fish/completions/linkwright.fish",
    "draw.examples": """\
linkwright draw gallery:jaw_crusher_sixbar --output crusher.svg
linkwright draw crusher.yaml --at "30 deg" --overlay limits --paths C,jaw.D --output crusher.pdf
linkwright draw crusher.yaml --overlay faded:8 --velocities A B C --output crusher.png --width 1600
linkwright draw crusher.yaml --forces --output crusher.svg --force
linkwright draw crusher.yaml --dimensions pitman jaw O1:O3 --output crusher.svg
linkwright draw gallery:excavator --time "2 s" --lang zh --output excavator.svg""",
    "finding.error": "{body}",
    "finding.below": "{first}\n{second}",
    "form.just": "{value}",
    "grade.examples": "linkwright grade exercise/key.json answers.csv",
    "machine.examples": """\
linkwright machine gallery:jaw_crusher_sixbar --fluctuation 0.03
linkwright machine crusher.yaml --fluctuation 0.03 --ratio 5 --efficiency 0.9 --margin 1.2
linkwright machine crusher.yaml --rim density=7200kg/m³,width=0.15,thickness=0.1
linkwright machine --areas "+295, -685, +40, -340, +960, -270" --scale "5 N·m/mm, 1 deg/mm" \\
    --speed 1800rpm --mass 36kg --gyration 150mm
linkwright machine --torque "20000 + 9500*sin(2*theta) - 5700*cos(2*theta)" \\
    --speed 180rpm --fluctuation 0.01
linkwright machine --torque "5000 + 600*sin(2*theta)" --load "5000 + 500*sin(theta)" \\
    --speed 150rpm --mass 500kg --gyration 0.4m""",
    "metrics.examples": """\
linkwright metrics gallery:jaw_crusher_sixbar
linkwright metrics press.yaml --names stroke,quick_return_ratio,transmission_angle
linkwright metrics crusher.yaml --output numbers.csv""",
    "model.form_length": "length: 0.5 m",
    "motion.coordinate": "{name} = {value}",
    "optimize.examples": """\
linkwright optimize crusher.yaml --output better.yaml
linkwright optimize gallery:jaw_crusher_sixbar --vary pitman.length=1.1..1.4m toggle.length=1..1.3m \\
    --minimize peak_input_torque --keep "jaw.angle range=same within 1 %"
linkwright optimize crusher.yaml --minimize peak_input_torque flywheel --plot front.svg --state front.state""",
    "page.where": "{name} = {value}",
    "plot.step": "{dimension} + {step}",
    "program.examples": """\
linkwright program gallery:production_mix
linkwright program gallery:lightest_spring --worked
linkwright program gallery:gear_pair --json""",
    "report.name_paragraph": "{number}",
    "report.name_source": "{number}",
    "schema.examples": "linkwright schema --output linkwright.schema.json\nlinkwright schema | less",
    "solve.quantity.": "",
    "solve.quantity.position.x": "x",
    "solve.quantity.position.y": "y",
    "solve.quantity.velocity.x": "vx",
    "solve.quantity.velocity.y": "vy",
    "solve.quantity.acceleration.x": "ax",
    "solve.quantity.acceleration.y": "ay",
    "solve.quantity.x": "Fx",
    "solve.quantity.y": "Fy",
    "solve.quantity.magnitude": "F",
    "solve.x_there": "Fx N",
    "solve.y_there": "Fy N",
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
    "structure_text.willis": "  (n_{wheel} - n_{carrier}) / (n_{first} - n_{carrier}) = {ratio}",
    "studio.examples": "linkwright studio\nlinkwright studio crusher.yaml",
    "studio.demand_hint": "at least 40 deg",
    "study.examples": """\
linkwright study gallery:jaw_crusher_sixbar --vary "pitman.length=1.2..1.3 m:11"
linkwright study crusher.yaml --vary "pitman.length=1.2..1.3 m:5" "jaw.mass=700, 900 kg" \\
    --metrics peak_input_torque "reaction O5 on jaw max" --output study.csv
linkwright study linkage.yaml --vary "coupler.length=2..4 m" --sampling sobol --samples 256""",
    "sweep.examples": """\
linkwright sweep gallery:crank_rocker --vary coupler.length=3..4m:300 rocker.length=2..3m:300 \\
    --numbers "rocker.angle range" transmission_angle --folder designs
linkwright sweep crusher.yaml --vary pitman.length=1.1..1.4m --sampling sobol --samples 1000000 \\
    --numbers peak_input_torque --folder torques --best peak_input_torque --cluster tcp://10.0.0.1:8786""",
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
    "validate.examples": """\
linkwright validate
linkwright validate --case crusher --every
linkwright validate --json""",
    "variants.examples": """\
linkwright variants gallery:jaw_crusher_fourbar --count 3 --seed 7
linkwright variants crusher.yaml --count 30 --to sheets key moodle --output exercise""",
    "vibration.examples": """\
linkwright vibration gallery:two_masses
linkwright vibration gallery:tuned_absorber --plot absorber.svg
linkwright vibration gallery:machine_on_mounts --worked""",
    "vibration.mode": "f{index}",
    "vibration.step_modes": "det(K − ω²M) = 0",
}

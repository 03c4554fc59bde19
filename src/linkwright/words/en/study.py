"""The command ``study``."""

WORDS = {
    "summary": "vary dimensions or parameters and see what becomes of any metric",
    "description": """\
Varies one or several dimensions (pitman.length, frame.O3.x, jaw.mass) or named
parameters of a model, over a grid or a Sobol sequence, and prints the chosen
metrics of every design. Designs that cannot move are counted and explained.""",
    "examples": """\
linkwright study gallery:jaw_crusher_sixbar --vary "pitman.length=1.2..1.3 m:11"
linkwright study crusher.yaml --vary "pitman.length=1.2..1.3 m:5" "jaw.mass=700, 900 kg" \\
    --metrics peak_input_torque "reaction O5 on jaw max" --output study.csv
linkwright study linkage.yaml --vary "coupler.length=2..4 m" --sampling sobol --samples 256""",
    "vary_help": 'what varies: "ADDRESS=FROM..TO UNIT:NUMBER" or "ADDRESS=VALUE, VALUE UNIT"; several make a '
    "grid",
    "metrics_help": "design numbers (see linkwright.metrics), travel, flywheel, or summaries of outputs in "
    'quotes ("driver.effort rms", "C.velocity max")',
    "sampling_help": "grid: every combination (default); sobol: evenly spread designs between the ends",
    "samples_help": "designs of a Sobol sequence (default 64)",
    "seed_help": "seed of the Sobol sequence (default 0)",
    "of_help": "the link or guide whose travel counts (default: the last one solved)",
    "fluctuation_help": "coefficient of speed fluctuation for flywheels (default 0.02)",
    "steps_help": "positions over the cycle (default 360)",
    "rows_help": "rows of the printed table (default 40)",
    "output_help": "write all designs to a .csv or .json file",
    "plot_help": "draw the metrics over what varies in a .svg, .pdf or .png file",
    "bad_vary": '--vary: "{text}" says no range; write ADDRESS=FROM..TO UNIT:NUMBER, '
    'such as "crank.length=20..30 mm:11"',
    "twice": "--vary: {name} is given twice; give one range for it",
    "counts": "{name}: {designs} designs, {movable} can move",
    "number": "no.",
    "left_out": "({shown} of {designs} designs shown; write all of them with --output FILE.csv)",
    "best": "Best designs",
    "best_of": "{name}: {value} in design {number} ({place})",
    "failed": "Designs that fail",
    "failed_at": "{count} at the group ({group}); the first: {example}",
    "failed_otherwise": "{count} by loads or metrics; the first: {example}",
}

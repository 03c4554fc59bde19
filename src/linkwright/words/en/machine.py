"""The command ``machine``."""

WORDS = {
    "summary": "motor and flywheel for steady running, and the speed that results",
    "description": """\
Finds what a machine needs to run steadily: mean torque and motor, energy
fluctuation, flywheel for a required coefficient of speed fluctuation (by the usual
formula and exactly), and the true speed over the cycle. Instead of a machine, a
torque diagram can be given by its areas or a torque as an expression of theta.""",
    "examples": """\
linkwright machine gallery:jaw_crusher_sixbar --fluctuation 0.03
linkwright machine crusher.yaml --fluctuation 0.03 --ratio 5 --efficiency 0.9 --margin 1.2
linkwright machine crusher.yaml --rim density=7200kg/m³,width=0.15,thickness=0.1
linkwright machine --areas "+295, -685, +40, -340, +960, -270" --scale "5 N·m/mm, 1 deg/mm" \\
    --speed 1800rpm --mass 36kg --gyration 150mm
linkwright machine --torque "20000 + 9500*sin(2*theta) - 5700*cos(2*theta)" \\
    --speed 180rpm --fluctuation 0.01
linkwright machine --torque "5000 + 600*sin(2*theta)" --load "5000 + 500*sin(theta)" \\
    --speed 150rpm --mass 500kg --gyration 0.4m""",
    "file_help": "model file, or gallery:NAME; leave it out with --areas or --torque",
    "what_title": "motor and flywheel",
    "curves_title": "a torque diagram instead of a machine",
    "form_title": "form",
    "fluctuation_help": "required coefficient of speed fluctuation (of a machine: 0.02 where left out)",
    "ratio_help": "speed of the flywheel's shaft over that of the crank (default 1)",
    "efficiency_help": "efficiency of all between motor and crank, up to 1 (default 1)",
    "margin_help": "factor on the motor's power, 1 or more (default 1)",
    "disk_help": "dimensions as a disk: density=7850kg/m³,width=0.1 (width over diameter)",
    "rim_help": "dimensions as a rim: density=…,width=0.1,thickness=0.1 (over the outer diameter)",
    "areas_help": 'areas between torque curve and mean line in mm², in turn: "+295, -685, …"; needs --scale',
    "torque_help": 'driving torque in N·m over theta in rad: "5000 + 600*sin(2*theta)"',
    "scale_help": 'scales of the diagram: "5 N·m/mm, 1 deg/mm"',
    "load_help": "resisting torque in N·m over theta (default: constant, the mean of --torque)",
    "period_help": "angle of a cycle (default 360deg; four-stroke engines 720deg)",
    "speed_help": "mean speed of the shaft: 180rpm",
    "inertia_help": 'moment of inertia that is on the shaft: "0.81 kg·m²"',
    "mass_help": "mass of the flywheel that is there, with --gyration: 36kg",
    "gyration_help": "its radius of gyration: 150mm",
    "steps_help": "positions over the cycle (default 360); what lies between them is found exactly",
    "output_help": "write the curves over the cycle in SI units to a .csv or .json file",
    "speed": "mean speed",
    "mean_torque": "mean torque",
    "mean_power": "mean power",
    "motor_power": "power of the motor, with efficiency and margin",
    "energy_fluctuation": "energy fluctuation",
    "energy_lowest_at": "slowest running, approximately, at input",
    "energy_lowest": "  lowest energy, slowest running (approximately)",
    "energy_highest_at": "fastest running, approximately, at input",
    "energy_highest": "  highest energy, fastest running (approximately)",
    "inertia_smallest": "smallest equivalent moment of inertia",
    "inertia_largest": "largest equivalent moment of inertia",
    "inertia": "moment of inertia that is there",
    "required_fluctuation": "required coefficient of speed fluctuation",
    "flywheel": "flywheel by the formula",
    "formula_fluctuation": "coefficient of speed fluctuation by the formula",
    "reached_fluctuation": "  coefficient really reached with it",
    "slowest": "  slowest",
    "fastest": "  fastest",
    "exact_flywheel": "flywheel for just the required coefficient, exact",
    "shaft_flywheel": "  the same on the flywheel's shaft",
    "acceleration_smallest": "largest retardation",
    "acceleration_largest": "largest acceleration",
    "disk_diameter": "disk, diameter",
    "rim_diameter": "rim, outer diameter",
    "width": "  width",
    "thickness": "  thickness",
    "mass": "  mass",
    "rim_speed": "  speed of the circumference (cast iron: up to about 30 m/s)",
    "after_area": "after area {number}",
    "at_begin": "at the begin",
    "areas_title": "Torque diagram of {count} areas",
    "torque_title": "T = {torque}, against {load}",
    "its_mean": "its mean",
    "none_needed": "No flywheel is needed: the machine's own inertia keeps the speed even enough.",
    "nothing_given": "name a model file, or give a torque diagram with --areas or --torque; "
    "see linkwright machine --help",
    "not_with_file": "{option} describes a torque diagram; it cannot be used together with a model file",
    "output_needs_file": "--output writes the cycle of a mechanism; name a model file",
    "needs_speed": "a flywheel or a speed fluctuation needs the mean speed; add --speed, such as --speed "
    "180rpm",
    "shape_needs_fluctuation": "the dimensions of a flywheel need to know how even the speed must be; add "
    "--fluctuation, such as --fluctuation 0.01",
    "no_scale": '--areas needs the scales of the diagram: --scale "5 N·m/mm, 1 deg/mm"',
    "bad_scale": '--scale: "{text}" does not give both scales; write torque and angle per mm above zero, '
    'such as "5 N·m/mm, 1 deg/mm"',
    "bad_area": '--areas: "{text}" is no area; give numbers in mm² separated by commas, such as "+295, -685, '
    '+390"',
    "no_number": '{option}: "{text}" is no number; write it with a point and without a unit, such as 0.9',
    "not_above_zero": '{option} is "{text}"; give a value above zero',
    "not_finite": "{option}: {text} is not finite everywhere in the cycle; check divisions and roots",
    "mass_and_gyration": "--mass and --gyration belong together; give both, or --inertia",
    "bad_shape": '{option}: "{text}" says nothing about it; write KEY=VALUE with the keys {keys}',
    "no_mean_torque": "the mean of --torque over the cycle is {mean}, so it does no work that a motor or a "
    "flywheel could be laid out for; give the driving torque, which is positive on the average",
}

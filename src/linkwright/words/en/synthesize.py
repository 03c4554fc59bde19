"""The command ``synthesize`` and the sentences of synthesis."""

WORDS = {
    "summary": "find dimensions from what the machine must do",
    "description": "Finds linkages for a task: a path, a free curve, poses, a function, or requirements "
    "such as\nstroke and quick-return ratio. Shows every candidate with its error, Grashof\n"
    "type, defects over the whole range, smallest transmission angle and ratio of\nlongest to "
    'shortest link; writes each as a model file. The task stands in the\nsection "synthesis" '
    "of a file, or on the command line as KEY=VALUE.",
    "task_help": "a file with a section synthesis, or the name of a task: {tasks}",
    "demands_help": 'demands of the task, such as stroke="40 mm"; lists in brackets as in a file',
    "output_help": "write every candidate as a model file into this folder",
    "worked_help": "how the first candidate was found: given values, equations with their numbers, check, "
    "choice",
    "plot_help": "draw target, candidates and curves in a .svg, .pdf or .png file",
    "mass_help": "also peak input torque and reaction, for links of this mass per length (kg/m)",
    "speed_help": "speed of the input link in model files and for --mass (default 60 rpm)",
}

"""The command ``report`` and the words of reports."""

WORDS = {
    "summary": "the whole report: structure, method, worked position, tables, curves, forces, flywheel",
    "description": "Writes the report of a machine as PDF, HTML or Word file: task and data, drawing,\n"
    "structure, method, one worked position with its polygons, tables over the cycle,\n"
    "curves, joint forces, driving torque by both methods, design numbers, flywheel,\n"
    'appendix, references. Several files are compared. The section "report" of a model\nfile '
    "sets title, cover, own chapters and text, sources, order and more.",
    "examples": "linkwright report gallery:swing_conveyor\nlinkwright report crusher.yaml --to docx "
    "--lang zh\nlinkwright report a.yaml b.yaml --output comparison.pdf\nlinkwright report "
    "crusher.yaml --sections task structure worked tables",
    "files_help": "model files, or gallery:NAME; several are compared",
    "to_help": "pdf, html or docx (default: what --output says, else pdf)",
    "sections_help": "sections in the order wanted, of: {names}; titles of own chapters; rest: all others",
    "position_help": 'input of the worked position: "60 deg" (default: a sixth of the cycle)',
    "positions_help": 'positions of the tables: so many (default: 24), or a list: "0..-360 deg:15 deg", "0 '
    'deg, 60 deg, limits"',
    "output_help": "file to write (default: the model's name)",
}

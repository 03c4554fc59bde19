"""The command ``sheet``, and the words on drawing sheets."""

WORDS = {
    "summary": "the drawing sheet, A0 to A4: mechanism, polygons, diagrams, tables, title block",
    "description": """\
Draws the sheet of a course design: the mechanism to a standard scale in one or two
positions, velocity, acceleration and force polygons, diagrams over the cycle and
tables, in a frame with a title block; for a cam, its profile. One millimetre on the
sheet is one on paper. The section "sheet" of the file fills the title block and
moves, scales or leaves out single panels.""",
    "examples": """\
linkwright sheet gallery:shaper_quick_return
linkwright sheet shaper.yaml --size A2 --output shaper.dxf
linkwright sheet shaper.yaml --size A1 --lang zh""",
    "size_help": "paper size, A0 to A4 (default: what the file says, else A1)",
    "kind_help": "mechanism or cam (default: what the file holds)",
    "of_help": "the part that is meant, where there are several: the joint of a cam",
    "output_help": "file to write: .pdf, .svg or .dxf (default: the model's name, .pdf)",
    "bad_ending": 'a sheet cannot be written as "{ending}"; use {endings}',
    "bad_size": 'paper size "{size}" does not exist; use {sizes}',
    "no_kind": 'there is no sheet for "{kind}"; sheets exist for {kinds}',
    "no_panel": 'the sheet has no panel "{name}"; {hint}',
    "outside": "sheet.panels.{name}: the panel, {width} mm × {height} mm with its caption, crosses the frame, which "
    "reaches from ({left}; {bottom}) to ({right}; {top}) mm; change `at`, or make it smaller with `size`",
    "no_room": "{size} has no room for: {names}. Take a larger size, or leave other panels out with `leave_out`.",
    "print_full_size": "Print at 100 %: this bar is 100 mm long.",
    "drawing_mechanism": "Kinematic and force analysis",
    "drawing_cam": "Cam",
    "block.mark": "Mark",
    "block.places": "No.",
    "block.zone": "Zone",
    "block.change_file": "Change",
    "block.signature": "Signed",
    "block.day": "Date",
    "block.designed": "Drawn",
    "block.adviser": "Advr",
    "block.checked": "Chkd",
    "block.process": "Process",
    "block.standardised": "Stand.",
    "block.approved": "Appr.",
    "block.stage": "Stage",
    "block.mass": "Mass",
    "block.scale": "Scale",
    "block.sheet_of": "Sheet {sheet} of {sheets}",
    "block.number": "No.",
    "block.class": "Class",
    "block.student_number": "Id.",
    "block.department": "Responsible dept.",
    "block.reference": "Technical reference",
    "block.created": "Created by",
    "block.approved_by": "Approved by",
    "block.owner": "Legal owner",
    "block.title": "Title, supplementary title",
    "block.kind": "Document type",
    "block.kind_value": "Kinematic drawing",
    "block.identification": "Identification number",
    "block.date": "Date of issue",
    "block.language": "Lang.",
    "block.language_value": "en",
    "block.sheet": "Sheet",
}

"""The command ``compensate``."""

WORDS = {
    "summary": "a cam that keeps an output constant in a zone, such as a bed in step with its cylinder",
    "description": """\
Finds the lift of a cam of the machine so that an output is constant while the input
goes through a zone: what the follower at rest leaves is made good exactly; outside the
zone the follower returns smoothly, with a dwell. The output is one that the model
names (outputs: {lead: bed_guide - 180 mm*cylinder}), a coordinate, an angle or a
displacement. --span looks for the zone of that length in which there is least to do.""",
    "examples": """\
linkwright compensate gallery:printing_press lead --zone "-882.734..-1449.5665 deg"
linkwright compensate press.yaml lead --span "567 deg" --output press_with_cam.yaml""",
    "of_help": "what is to be constant: an output of the model",
    "joint_help": "the cam (needed where the machine has several)",
    "zone_help": "values of the input between which it is to be constant",
    "span_help": "how long the zone is to be, of the input; its place is found",
    "steps_help": "positions over the cycle (default 1440)",
    "output_help": "write the model with the cam to a .yaml file, or the table of lifts to a .csv file",
    "kept": "{output} is constant by {joint} while the input goes from {first} to {last}",
    "before": "{output} varies in it, follower at rest, by",
    "after": "with the cam by",
    "lift": "whole lift",
    "bad_zone": '--zone: "{text}" is no zone; write where it begins and ends, such as "90..210 deg"',
}

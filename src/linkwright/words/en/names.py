"""Names that do not exist, and what was probably meant."""

WORDS = {
    "twice": 'the {noun} "{name}" is registered twice; choose another name',
    "did_you_mean": 'did you mean "{offer}"?',
    "there_is": "there is {names}",
    "there_is_none": "there is none",
    "no_such": 'there is no {noun} "{name}"; {hint}',
}

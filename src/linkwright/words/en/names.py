"""Names that do not exist, and what was probably meant."""

WORDS = {
    "twice": 'the {noun} "{name}" is registered twice; choose another name',
    "did_you_mean": 'did you mean "{offer}"?',
    "there_is": "there is {names}",
    "there_is_none": "there is none",
    "no_such": 'there is no {noun} "{name}"; {hint}',
    "one_of": "one of: {names}",
    "near_one_of": 'did you mean "{offer}"? (one of: {names})',
    "all_one_of": "one of: {names}",
    "near_known": 'did you mean "{offer}"? (known: {names})',
    "all_known": "known: {names}",
    "near_there_is": 'did you mean "{offer}"? (there is: {names})',
    "all_there_is": "there is: {names}",
    "nothing_there": "there is none",
    "it_has": "it has {names}",
    "no_such_point": 'there is no point of link {link}: "{name}"; {hint}',
    "no_language": 'there are no words in the language "{language}"; use one of {languages}',
}

"""How a remark about a model is put together."""

WORDS = {
    "warning": "warning: {body}",
    "note": "note: {body}",
    "with_remedy": "{message}; {remedy}",
    "comma": ", ",
    "and": "{first} and {last}",
    "semicolon": "; ",
}

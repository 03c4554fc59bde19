"""How a remark about a model is put together."""

WORDS = {
    "error": "{body}",
    "warning": "warning: {body}",
    "note": "note: {body}",
    "with_remedy": "{message}; {remedy}",
    "comma": ", ",
    "and": "{first} and {last}",
    "semicolon": "; ",
    "below": "{first}\n{second}",
}

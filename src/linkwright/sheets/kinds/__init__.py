"""The kinds of sheets, one module each: what panels a machine or a calculation offers."""

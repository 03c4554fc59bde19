"""The kinds of sheets: what panels a machine or a calculation offers."""

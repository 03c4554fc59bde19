"""Models: reading and checking of files, and the one type for a mechanism."""

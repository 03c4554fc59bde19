"""The worked solution of one position, in the order in which a textbook solves it."""

"""Models of robots: bodies that hang on each other in a tree, what closes loops, and the plane in which all moves."""

"""USD scenes with physics: rigid bodies, joints of the tree and of its loops, drives."""

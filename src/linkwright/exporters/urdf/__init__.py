"""URDF robots: links in a tree, joints that mimic others, and what closes their loops beside them."""

"""What a machine that solves says about a file that was meant otherwise: what rests, does nothing, or is drawn in
contradiction."""

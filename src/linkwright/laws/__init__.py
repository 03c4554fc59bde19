"""Motion laws: a rise from 0 to 1 over u from 0 to 1, one file per law, for cams and drivers."""

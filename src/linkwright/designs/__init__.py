"""Many designs of one mechanism: repeated solving, sweeps, sensitivities, comparison, parameter studies."""

"""Path generation: four-bars whose coupler point passes given points."""

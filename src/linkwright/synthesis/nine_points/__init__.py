"""All four-bars whose coupler point passes nine given points."""

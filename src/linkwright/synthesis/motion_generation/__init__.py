"""Motion generation: four-bars and slider-cranks whose coupler passes given poses (Burmester)."""

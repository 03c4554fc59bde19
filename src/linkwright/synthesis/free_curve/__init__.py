"""Free curves: linkages of four and more bars that draw a given curve."""

"""Parts to make: outlines with holes, sheets, pins and spacers, solids, and the list of parts."""

"""Models of other programs: one reader a format, one layout that all of them give, one text that is made of it."""

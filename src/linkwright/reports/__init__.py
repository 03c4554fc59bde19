"""Reports: what a course design or an engineering file needs, from a model and its results."""

"""pylinkage: mechanisms, and structures with or without dimensions."""

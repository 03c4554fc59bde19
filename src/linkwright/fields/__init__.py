"""What elements declare of themselves in files: quantities, references, signals over the cycle."""

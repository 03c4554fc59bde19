"""Reading, checking and writing model files."""

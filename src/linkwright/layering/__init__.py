"""In which layer every plate of a machine goes."""

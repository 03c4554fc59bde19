"""SVG text, and pictures made of it."""

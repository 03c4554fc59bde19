"""Finished pictures: SVG, symbols, drawings and diagrams that are saved and shown."""

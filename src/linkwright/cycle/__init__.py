"""The cycle of one machine or of many designs: events, pieces between them, summaries, and their gradients."""

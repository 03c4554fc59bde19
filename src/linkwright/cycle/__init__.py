"""The cycle of one machine or of many designs: loads over it, summaries of signals, and their gradients."""

from linkwright.cycle.summaries import Summary as Summary

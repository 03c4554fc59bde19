"""Kinds of diagrams of results that have no single motion behind them; imported when such a result is drawn."""

"""Mathematics that knows nothing of mechanisms."""

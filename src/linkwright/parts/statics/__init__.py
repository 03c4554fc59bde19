"""Forces in equilibrium: systems of forces, rigid bodies, pinned structures, belts and wedges."""

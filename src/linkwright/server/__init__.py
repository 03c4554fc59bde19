"""The studio's local server: what the living page needs Python for."""

"""The browser of the folder's tests."""

from tests.ui.tabs import chromium, fresh, kept_open, opened

__all__ = ["chromium", "fresh", "kept_open", "opened"]

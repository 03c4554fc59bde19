"""The wording of the program as one snapshot a language, made by ``python -m tests.words``."""

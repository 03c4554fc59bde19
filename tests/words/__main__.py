"""``python -m tests.words``: writes the snapshots of the wording and says what changed in them; ``--check`` compares.

What is said only once in a process must be said here: the comparison needs a process of its own.
"""

from __future__ import annotations

import argparse
from difflib import unified_diff

from tests.words.wording import HERE, LANGUAGES, snapshot


def main() -> int:
    """Writes or compares both snapshots; 1 where one differs from what is held."""
    parser = argparse.ArgumentParser(prog="python -m tests.words", description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing")
    given, changed = parser.parse_args(), False
    for language in LANGUAGES:
        path = HERE / f"{language}.txt"
        before = path.read_text("utf-8") if path.exists() else ""
        after, (said, count) = snapshot(language)
        changed |= after != before
        print(*unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0), sep="\n")
        print(f"{path.name}: {len(after.splitlines())} lines; {said} of {count} sentences are said by the program")
        if not given.check:
            path.write_text(after, "utf-8")
    return int(changed and given.check)


if __name__ == "__main__":
    raise SystemExit(main())

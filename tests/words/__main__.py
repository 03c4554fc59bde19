"""``python -m tests.words``: writes the snapshots of the wording and says what changed in them."""

from __future__ import annotations

import sys
from difflib import unified_diff

from tests.words.wording import HERE, LANGUAGES, snapshot


def main() -> int:
    """Writes both snapshots."""
    for language in LANGUAGES:
        path = HERE / f"{language}.txt"
        before = path.read_text("utf-8") if path.exists() else ""
        after, shares = snapshot(language)
        path.write_text(after, "utf-8")
        print(*unified_diff(before.splitlines(), after.splitlines(), lineterm="", n=0), sep="\n")
        said, count = map(sum, zip(*shares.values(), strict=True))
        print(
            f"{path.name}: {len(after.splitlines())} lines; {said} of {count} sentences are said by the program"
        )
        if "--areas" in sys.argv:
            print(*(f"  {area}: {found} of {of}" for area, (found, of) in shares.items()), sep="\n")
    return 0


if __name__ == "__main__":
    raise SystemExit(main())

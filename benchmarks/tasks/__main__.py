"""``python -m benchmarks.tasks``: the tasks in words, and a verdict about a folder of answers.

python -m benchmarks.tasks                    list of the tasks
python -m benchmarks.tasks ask [NAME …]       what is put to whoever answers (--lang zh)
python -m benchmarks.tasks judge FOLDER       FOLDER/NAME.yaml, one answer a task; exit code 1 where one is wrong
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path

from .judge import judge
from .task import tasks


def main() -> int:
    """Runs the command; 1 where an answer is wrong or missing."""
    parser = argparse.ArgumentParser("python -m benchmarks.tasks", description=__doc__.partition("\n")[0])
    parser.add_argument("--lang", choices=("en", "zh"), default="en")
    commands = parser.add_subparsers(dest="command")
    asked = commands.add_parser("ask")
    asked.add_argument("names", nargs="*")
    judged = commands.add_parser("judge")
    judged.add_argument("folder", type=Path)
    options = parser.parse_args()
    if options.command == "ask":
        print("\n\n---\n\n".join(tasks()[name].prompt(options.lang) for name in options.names or tasks()))
        return 0
    if options.command == "judge":
        return _judge(options.folder)
    for name, task in tasks().items():
        print(f"{name:20} {task.title[options.lang]}")
    return 0


def _judge(folder: Path) -> int:
    right = 0
    for name, task in tasks().items():
        path = folder / f"{name}.yaml"
        if not path.exists():
            print(f"{name:20} no answer")
            continue
        verdict = judge(task, path.read_text("utf-8"))
        right += verdict.right
        print(f"{name:20} {'right' if verdict.right else 'wrong'}  {verdict.held} of {verdict.of} hold")
        for sentence in verdict.wrong:
            print(f"{'':21}{sentence}")
    print(f"\n{right} of {len(tasks())} right")
    return int(right < len(tasks()))


if __name__ == "__main__":
    sys.exit(main())

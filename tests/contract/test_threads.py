"""Several threads that begin at the same time in a fresh process find every element and every module."""

import subprocess
import sys

import pytest

PROGRAM = """
import sys, threading

TASKS = {
    "load": lambda lw: lw.load("gallery:jaw_crusher_sixbar"),
    "check": lambda lw: lw.check("gallery:excavator"),
    "solve": lambda lw: lw.solve_forces(lw.solve_motion(lw.load("gallery:jaw_crusher_sixbar"), steps=12)),
    "metrics": lambda lw: lw.metrics(lw.solve_motion(lw.load("gallery:crank_rocker"), steps=24)),
    "structure": lambda lw: lw.structure(lw.load("gallery:theo_jansen_leg")),
    "limits": lambda lw: lw.limit_positions(lw.solve_motion(lw.load("gallery:crank_rocker")), "rocker"),
    "schema": lambda lw: lw.json_schema(),
    "draw": lambda lw: lw.load("gallery:kite")._repr_svg_(),
}
tasks = sys.argv[1:]
start, faults = threading.Barrier(len(tasks)), []

def work(task):
    start.wait()
    try:
        import linkwright as lw
        TASKS[task](lw)
    except BaseException as error:
        faults.append(f"{task}: {error!r}")

threads = [threading.Thread(target=work, args=(task,)) for task in tasks]
for thread in threads:
    thread.start()
for thread in threads:
    thread.join()
print(*faults, sep="\\n")
sys.exit(bool(faults))
"""
MIX = ("load", "check", "solve", "metrics", "structure", "limits", "schema", "draw")


@pytest.mark.parametrize(
    "tasks",
    [pytest.param((each,) * 8, marks=pytest.mark.rotating) for each in ("load", "check", "solve")] + [MIX, MIX[::-1]],
    ids=lambda each: each[0],
)
def test_eight_threads_at_once(tasks: tuple[str, ...]) -> None:
    done = subprocess.run(
        [sys.executable, "-c", PROGRAM, *tasks], capture_output=True, text=True, check=False, timeout=120
    )
    assert (done.returncode, done.stdout.strip()) == (0, ""), done.stderr

"""Two jaw crushers for one task: comparison with ranking and reasons, and the report of both as a web page."""

import linkwright as lw

MACHINES = ["gallery:jaw_crusher_sixbar", "gallery:jaw_crusher_fourbar"]

comparison = lw.compare(MACHINES, output="jaw", fluctuation=0.03)
print(comparison.text())

report = lw.report(MACHINES, sections=["task", "structure", "comparison", "conclusion"])
for missing in report.missing:
    print("missing:", missing)
print("written:", report.save("crushers.html", force=True))

"""The tools, one task each, in the order in which they are usually called."""

from __future__ import annotations

from linkwright.assistants.tool import Tool
from linkwright.assistants.tools.change import change_dimension
from linkwright.assistants.tools.check import check_model
from linkwright.assistants.tools.compare import compare_machines
from linkwright.assistants.tools.draw import draw_machine
from linkwright.assistants.tools.explain import explain_finding
from linkwright.assistants.tools.gallery import search_gallery
from linkwright.assistants.tools.metrics import get_metrics
from linkwright.assistants.tools.optimize import optimize_machine
from linkwright.assistants.tools.report import write_report
from linkwright.assistants.tools.schema import read_schema
from linkwright.assistants.tools.solve import solve_machine
from linkwright.assistants.tools.synthesize import synthesize_machine

TOOLS = (
    Tool("Read the schema of model files", read_schema),
    Tool("Search the gallery of models", search_gallery),
    Tool("Check a model", check_model),
    Tool("Explain a finding", explain_finding),
    Tool("Solve motion and forces", solve_machine),
    Tool("Get design numbers", get_metrics),
    Tool("Draw a machine", draw_machine),
    Tool("Change dimensions of a model", change_dimension, writes=True),
    Tool("Find dimensions for a task", synthesize_machine, writes=True),
    Tool("Optimise dimensions", optimize_machine, writes=True),
    Tool("Compare machines", compare_machines),
    Tool("Write a report", write_report, writes=True),
)

"""Linkwright: analysis and design of planar machines."""

import lazy_loader

from linkwright.core import VERSION
from linkwright.core.attached import ATTACHED, SECTIONS

__version__ = VERSION
__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

ATTACHED.update(
    {
        "CamDesign.blocks": "linkwright.cams.report:blocks",
        "CamDesign.draw": "linkwright.plotting.true_shapes:draw_cam",
        "CamDesign.save_profile": "linkwright.exporters.true_shapes:save_profile",
        "CamDesign.steps": "linkwright.cams.report:steps",
        "Comparison.evaluation": "linkwright.designs.evaluation:evaluation",
        "Comparison.tables": "linkwright.designs.evaluation:tables",
        "CutParts.data": "linkwright.fabrication.parts_list:data",
        "CutParts.save": "linkwright.fabrication.files:save",
        "CutParts.tables": "linkwright.fabrication.parts_list:tables",
        "Equilibria.remarks": "linkwright.dynamics.equilibrium_text:remarks",
        "Equilibria.tables": "linkwright.dynamics.equilibrium_text:tables",
        "Forces._repr_svg_": "linkwright.plotting.drawing.draw:picture_of",
        "Forces.balance_residual": "linkwright.kinetostatics.link_balance:balance_residual",
        "Forces.columns": "linkwright.kinetostatics.table:force_columns",
        "Forces.to_dataframe": "linkwright.kinetostatics.table:force_frame",
        "GearPair.draw": "linkwright.plotting.true_shapes:draw_pair",
        "GearPair.save_dxf": "linkwright.exporters.true_shapes:save_pair",
        "Guidance.coordinates": "linkwright.kinematics.following:coordinates",
        "Guidance.posed": "linkwright.kinematics.following:posed",
        "LayerCount.values": "linkwright.layering.metrics:layer_count",
        "LinkSizes.model_text": "linkwright.sizing.written:model_text",
        "LinkSizes.sized": "linkwright.sizing.written:sized",
        "Mechanism._repr_svg_": "linkwright.plotting.drawing.draw:picture_of",
        "Mechanism.structure": "linkwright.topology.decompose:structure",
        "MinGap.values": "linkwright.layering.metrics:smallest_gap",
        "Motion._repr_svg_": "linkwright.plotting.drawing.draw:picture_of",
        "Motion.columns": "linkwright.kinetostatics.table:motion_columns",
        "Motion._named_course": "linkwright.kinematics.output_formulas:named_course",
        "Motion.outcomes": "linkwright.kinematics.reach_messages:explain",
        "Motion.refusal": "linkwright.kinematics.refusal:refusal",
        "Motion.to_dataframe": "linkwright.kinetostatics.table:motion_frame",
        "Optimum.tables": "linkwright.designs.optimise.optimum:tables",
        "PlotMixin.plot": "linkwright.plotting.diagrams.base:plot",
        "Problem.sketch": "linkwright.plotting.sketches.base:sketch",
        "Release.worked": "linkwright.worked_solutions.released:worked",
        "Rocking.limits": "linkwright.kinematics.rocking:limits",
        "Rack.draw": "linkwright.plotting.true_shapes:draw_rack",
        "Rack.save_dxf": "linkwright.exporters.true_shapes:save_rack",
        "Run.as_driven": "linkwright.dynamics.found_course:as_driven",
        "Study.tables": "linkwright.designs.study_text:tables",
        "Synthesis.worked": "linkwright.synthesis.steps.solution:worked",
        "Variants.files": "linkwright.course.questions:files_of",
    }
)

SECTIONS.update(
    {
        "course": "linkwright.course.task:SECTION",
        "expect": "linkwright.designs.expect.section:SECTION",
        "optimize": "linkwright.designs.optimise.problem:SECTION",
        "report": "linkwright.reports.settings:SECTION",
        "synthesis": "linkwright.synthesis.tasks:SECTION",
    }
)

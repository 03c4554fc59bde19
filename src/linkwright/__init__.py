"""Linkwright: analysis and design of planar machines."""

from linkwright.core import VERSION
from linkwright.core.attached import ATTACHED, SECTIONS
from linkwright.lazy import offer

TYPE_CHECKING = False  # type checkers take it for true

if TYPE_CHECKING:
    from linkwright.analysis import MetricsTable as MetricsTable
    from linkwright.analysis import metrics as metrics
    from linkwright.cams.cam import Cam as Cam
    from linkwright.cams.compensating_cam import CompensatingCam as CompensatingCam
    from linkwright.cams.compensating_cam import compensating_cam as compensating_cam
    from linkwright.cams.compensation import compensating_lift as compensating_lift
    from linkwright.cams.fields import CamChoice as CamChoice
    from linkwright.cams.fields import CamConjugate as CamConjugate
    from linkwright.cams.fields import CamElasticity as CamElasticity
    from linkwright.cams.fields import CamLimits as CamLimits
    from linkwright.cams.follower import Follower as Follower
    from linkwright.cams.loading import CamLoading as CamLoading
    from linkwright.cams.loading import CamMaterial as CamMaterial
    from linkwright.cams.loading import CamSpring as CamSpring
    from linkwright.cams.result import CamDesign as CamDesign
    from linkwright.core.progress import reporting as reporting
    from linkwright.core.table import Tabular as Tabular
    from linkwright.course.grade import Grade as Grade
    from linkwright.course.grade import Grades as Grades
    from linkwright.course.grade import grade as grade
    from linkwright.course.variants import Variants as Variants
    from linkwright.course.variants import variants as variants
    from linkwright.designs.cluster import on_cluster as on_cluster
    from linkwright.designs.compare import Comparison as Comparison
    from linkwright.designs.compare import compare as compare
    from linkwright.designs.designs import Sweep as Sweep
    from linkwright.designs.designs import sweep as sweep
    from linkwright.designs.finished_parts import Interrupted as Interrupted
    from linkwright.designs.finished_parts import kept_in as kept_in
    from linkwright.designs.objective import Objective as Objective
    from linkwright.designs.objective import objective as objective
    from linkwright.designs.objective_terms import PathError as PathError
    from linkwright.designs.optimise.optimize import optimize as optimize
    from linkwright.designs.optimise.optimum import OptimizeError as OptimizeError
    from linkwright.designs.optimise.optimum import Optimum as Optimum
    from linkwright.designs.prepared import Prepared as Prepared
    from linkwright.designs.prepared import prepare as prepare
    from linkwright.designs.sensitivity import Sensitivity as Sensitivity
    from linkwright.designs.sensitivity import sensitivity as sensitivity
    from linkwright.designs.study import Study as Study
    from linkwright.designs.study import study as study
    from linkwright.errors import Finding as Finding
    from linkwright.errors import LinkwrightError as LinkwrightError
    from linkwright.errors import ModelError as ModelError
    from linkwright.errors import SelfCheckError as SelfCheckError
    from linkwright.events.limit_positions import LimitPosition as LimitPosition
    from linkwright.events.limit_positions import limit_positions as limit_positions
    from linkwright.exporters.export import export as export
    from linkwright.exporters.sweep_parts import SweepParts as SweepParts
    from linkwright.exporters.sweep_parts import sweep_parts as sweep_parts
    from linkwright.file_check import check as check
    from linkwright.files.build import Model as Model
    from linkwright.files.model_file import gallery_names as gallery_names
    from linkwright.files.model_file import load as load
    from linkwright.files.model_file import loads as loads
    from linkwright.files.model_file import read_document as read_document
    from linkwright.files.schema import json_schema as json_schema
    from linkwright.files.write import dump as dump
    from linkwright.gears.gear import Gear as Gear
    from linkwright.gears.pair import GearPair as GearPair
    from linkwright.gears.pair import gear_pair as gear_pair
    from linkwright.gears.rack import Rack as Rack
    from linkwright.kinematics import Motion as Motion
    from linkwright.kinematics import Outcome as Outcome
    from linkwright.kinematics import PositionError as PositionError
    from linkwright.kinematics import solve_motion as solve_motion
    from linkwright.kinematics.input_range import input_range as input_range
    from linkwright.kinematics.proof import prove as prove
    from linkwright.kinetostatics.forces import Forces as Forces
    from linkwright.kinetostatics.run import solve_forces as solve_forces
    from linkwright.laws.base import MotionLaw as MotionLaw
    from linkwright.laws.fitting import laws_for as laws_for
    from linkwright.laws.fitting import motion_law as motion_law
    from linkwright.laws.program import MotionProgram as MotionProgram
    from linkwright.laws.program import Segment as Segment
    from linkwright.laws.smoothest import FoundProgram as FoundProgram
    from linkwright.laws.smoothest import Window as Window
    from linkwright.machine import SteadyRunning as SteadyRunning
    from linkwright.machine import TorqueCurve as TorqueCurve
    from linkwright.machine import steady_running as steady_running
    from linkwright.machine.balancing import Balancing as Balancing
    from linkwright.machine.balancing import balance as balance
    from linkwright.mechanism.mechanism import Mechanism as Mechanism
    from linkwright.page.content import LivingPage as LivingPage
    from linkwright.page.content import living_page as living_page
    from linkwright.pictures.diagram import Diagram as Diagram
    from linkwright.pictures.drawing import Drawing as Drawing
    from linkwright.plotting.animation import Animation as Animation
    from linkwright.plotting.animation import animate as animate
    from linkwright.plotting.diagrams.diagram_by_name import plot as plot
    from linkwright.plotting.drawing.draw import draw as draw
    from linkwright.reports.report import Report as Report
    from linkwright.reports.report import report as report
    from linkwright.sheets.sheet import Sheet as Sheet
    from linkwright.sheets.sheet import sheet as sheet
    from linkwright.synthesis.free_curve.generate import free_curve as free_curve
    from linkwright.synthesis.function_generation.generate import function_generation as function_generation
    from linkwright.synthesis.motion_generation.generate import motion_generation as motion_generation
    from linkwright.synthesis.path_generation.cognates import cognates as cognates
    from linkwright.synthesis.path_generation.exact import exact_path_generation as exact_path_generation
    from linkwright.synthesis.path_generation.generate import path_generation as path_generation
    from linkwright.synthesis.result import Candidate as Candidate
    from linkwright.synthesis.result import Synthesis as Synthesis
    from linkwright.synthesis.result import SynthesisError as SynthesisError
    from linkwright.synthesis.tasks import synthesize as synthesize
    from linkwright.topology import Structure as Structure
    from linkwright.topology import StructureError as StructureError
    from linkwright.topology import structure as structure
    from linkwright.validation.validate import Validation as Validation
    from linkwright.validation.validate import validate as validate
    from linkwright.worked_solutions.solution import Worked as Worked
    from linkwright.worked_solutions.solution import worked as worked

__version__ = VERSION

ATTACHED.update(
    {
        "CamDesign.blocks": "linkwright.cams.report:blocks",
        "CamDesign.draw": "linkwright.plotting.true_shapes:draw_cam",
        "CamDesign.save_profile": "linkwright.exporters.dxf.true_shapes:save_profile",
        "CamDesign.steps": "linkwright.cams.report:steps",
        "Comparison.evaluation": "linkwright.designs.evaluation:evaluation",
        "Comparison.tables": "linkwright.designs.evaluation:tables",
        "Forces._repr_svg_": "linkwright.plotting.drawing.draw:picture_of",
        "Forces.balance_residual": "linkwright.kinetostatics.link_balance:balance_residual",
        "Forces.columns": "linkwright.kinetostatics.table:force_columns",
        "GearPair.draw": "linkwright.plotting.true_shapes:draw_pair",
        "GearPair.save_dxf": "linkwright.exporters.dxf.true_shapes:save_pair",
        "Mechanism._repr_svg_": "linkwright.plotting.drawing.draw:picture_of",
        "Mechanism.structure": "linkwright.topology.decompose:structure",
        "Motion._repr_svg_": "linkwright.plotting.drawing.draw:picture_of",
        "Motion.columns": "linkwright.kinematics.table:motion_columns",
        "Motion._named_course": "linkwright.kinematics.output_formulas:named_course",
        "Motion.outcomes": "linkwright.kinematics.reach_sentences:explain",
        "Motion.refusal": "linkwright.kinematics.refusal:refusal",
        "Motion.to_dataframe": "linkwright.kinematics.table:motion_frame",
        "Optimum.tables": "linkwright.designs.optimise.report:tables",
        "Plotted.plot": "linkwright.plotting.diagrams.diagram_by_name:plot",
        "Problem.sketch": "linkwright.plotting.sketches.base:sketch",
        "Rack.draw": "linkwright.plotting.true_shapes:draw_rack",
        "Rack.save_dxf": "linkwright.exporters.dxf.true_shapes:save_rack",
        "Study.tables": "linkwright.designs.study_text:tables",
        "Synthesis.worked": "linkwright.synthesis.steps.solution:worked",
        "Variants.files": "linkwright.course.questions:files_of",
    }
)

SECTIONS.update({
    "course": "linkwright.course.task:SECTION",
    "optimize": "linkwright.designs.optimise.problem:SECTION",
    "report": "linkwright.reports.settings:SECTION",
    "synthesis": "linkwright.synthesis.section:SECTION",
})  # fmt: skip

#: Public names by the module that has them.
PUBLIC = offer(__name__)

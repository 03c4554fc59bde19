"""A DXF sheet of one position of a mechanism at true scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

import numpy as np

from linkwright.errors import LinkwrightError
from linkwright.export.dxf.strokes import Stroke, strokes, unbroken
from linkwright.export.results import Results
from linkwright.joints.revolute import RevoluteJoint
from linkwright.plot.drawing.labels import LetterPlace
from linkwright.plot.drawing.scene import Scene, laid_out
from linkwright.plot.drawing.view import moved
from linkwright.plot.svg.element import Floats
from linkwright.plot.symbols.base import PIN

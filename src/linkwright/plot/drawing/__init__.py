"""The kinematic drawing: ``draw(motion)`` gives a Drawing with ``.svg`` and ``.save(path)``."""

from linkwright.plot.drawing.draw import draw as draw
from linkwright.plot.drawing.picture import Drawing as Drawing

"""The kinematic drawing: ``draw(motion)`` gives a Drawing with ``.svg`` and ``.save(path)``."""

from linkwright.pictures.drawing import Drawing as Drawing
from linkwright.plotting.drawing.draw import draw as draw

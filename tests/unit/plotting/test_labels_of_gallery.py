"""Labels of every gallery model keep clear of its lines and of each other, in a position of its cycle, in turn."""

import numpy as np
import pytest
from tests import store
from tests.every import every
from tests.share import in_turn

from linkwright.pictures.labels import Obstacles, place
from linkwright.plotting.drawing.scene import laid_out, link_labels, point_labels


@pytest.mark.rotating
@pytest.mark.parametrize("name", store.names())
def test_labels_keep_clear_of_lines_and_of_each_other(name: str) -> None:
    motion = store.motion(name, 48)
    indices = np.flatnonzero(motion.ok)[:: max(1, int(motion.ok.sum()) // 2)]
    for index in every(in_turn(list(indices), store.names().index(name), 1)):
        scene = laid_out(motion, int(index))
        labels = [*point_labels(scene.machine, int(index)), *link_labels(scene, int(index))]
        ink = Obstacles.of(scene.ink(int(index)))
        boxes = np.array([each.box for each in every(place(labels, ink))])
        assert not [label.text for label, under in zip(labels, ink.under(boxes), strict=True) if under > 0]
        for k, box in enumerate(boxes):
            others = np.delete(boxes, k, axis=0)
            wide = np.minimum(box[2], others[:, 2]) - np.maximum(box[0], others[:, 0])
            high = np.minimum(box[3], others[:, 3]) - np.maximum(box[1], others[:, 1])
            assert not ((wide > 0) & (high > 0)).any(), labels[k].text

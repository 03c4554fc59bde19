"""Machine-part calculations: statics, beams, vibration, trajectories, optimisation programs, statistics.

Every calculation is a problem, from a small file (:func:`load`) or from its class, whose ``solve`` gives a result
with ``text``, ``worked``, ``data``, ``columns`` and ``plot``.
"""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

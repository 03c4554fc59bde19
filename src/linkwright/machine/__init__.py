"""Machine dynamics at steady running: equivalent inertia and torque, motor, flywheel, true speed."""

import lazy_loader

__getattr__, __dir__, __all__ = lazy_loader.attach_stub(__name__, __file__)

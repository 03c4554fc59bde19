"""stub"""
from linkwright.engine import machine_code

_kept = {}
def loaded_code(key, text, entry):
    if key not in _kept:
        _kept[key]=machine_code.Loaded(machine_code.object_code(text()), entry)
    return _kept[key]

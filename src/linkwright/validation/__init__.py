"""Reference numbers next to those of the program: the data, how each is found, and the comparison."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.validation.validate import Checked as Checked
    from linkwright.validation.validate import Validation as Validation
    from linkwright.validation.validate import validate as validate

offer(__name__)

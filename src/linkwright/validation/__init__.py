"""Reference numbers next to those of the program: the data, how each is found, and the comparison."""

from linkwright.validation.validate import Checked as Checked
from linkwright.validation.validate import Validation as Validation
from linkwright.validation.validate import validate as validate

"""Course mode: variants of a task, answer keys with the usual mistakes, questions for learning platforms, grading."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.course.grade import Grade as Grade
    from linkwright.course.grade import grade as grade
    from linkwright.course.variants import Variants as Variants
    from linkwright.course.variants import variants as variants

offer(__name__)

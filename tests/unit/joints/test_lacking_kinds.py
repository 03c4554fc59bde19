"""What a kind of joint must say of itself."""

from tests.refusals import refused

from linkwright.joints.base import Joint, LackingError


def test_a_kind_that_lacks_something_says_so_when_it_is_needed() -> None:
    class Half(Joint):
        kind = "half"

    with refused("model.kind_lacks", LackingError, kind="half", what="fields"):
        Half.fields()

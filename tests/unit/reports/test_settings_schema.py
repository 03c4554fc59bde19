"""The schema that editors read names the keys that the settings of reports take."""

from tests.every import every

import linkwright as lw
from linkwright.reports.section import section_names
from linkwright.reports.settings import COVER, OWN
from linkwright.words import LANGUAGES


def test_the_schema_names_every_key_of_the_settings() -> None:
    keys = lw.json_schema()["properties"]["report"]["properties"]
    assert set(keys) == {*OWN, "positions", "numbered_from", "fluctuation", *LANGUAGES}
    for language in every(LANGUAGES):
        assert set(keys[language]["properties"]) == set(OWN)
    assert set(keys["cover"]["oneOf"][1]["properties"]) == set(COVER)
    name, chapter = keys["sections"]["items"]["anyOf"]
    assert set(name["enum"]) == {*section_names(), "rest", "calculations"}
    assert set(chapter["properties"]) == {"title", "text", "label"}
    assert set(keys["references"]["items"]["anyOf"][1]["properties"]) == {"key", "text"}
    assert set(keys["text"]["properties"]) == set(section_names())

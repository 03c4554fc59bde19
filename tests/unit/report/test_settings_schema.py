"""The schema that editors read names the keys that the settings of reports take."""

from tests.every import every

import linkwright as lw
from linkwright.report.settings import CHAPTER, COVER, KEYS, OWN, REFERENCE
from linkwright.words import LANGUAGES


def test_the_schema_names_every_key_of_the_settings() -> None:
    keys = lw.json_schema()["properties"]["report"]["properties"]
    assert set(keys) == set(KEYS)
    for language in every(LANGUAGES):
        assert set(keys[language]["properties"]) == set(OWN)
    assert set(keys["cover"]["oneOf"][1]["properties"]) == set(COVER)
    assert set(keys["sections"]["items"]["oneOf"][1]["properties"]) == set(CHAPTER)
    assert set(keys["references"]["items"]["oneOf"][1]["properties"]) == set(REFERENCE)

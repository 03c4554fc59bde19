"""Results as files for other programs: ``export(result, path)``."""

from typing import TYPE_CHECKING

from linkwright.lazy import offer

if TYPE_CHECKING:
    from linkwright.exporters.export import export as export

offer(__name__)

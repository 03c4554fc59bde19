"""Metrics of the open model as its numbers before and now: with names, limits and remarks in words."""

from __future__ import annotations

import math

from linkwright.analysis import METRICS
from linkwright.analysis.evaluate import applicable_metrics
from linkwright.core.arguments import STEPS
from linkwright.core.data import Plain
from linkwright.core.quantity import shown_factor
from linkwright.files.model_file import read_text
from linkwright.files.write import Document


def metric_rows(text: str, language: str) -> list[Plain]:
    """All metrics that apply to a text's model, SI; the first of those that come several times over the cycle.

    ``factor``: from SI to ``unit``; ``limit``: the recommended value; ``better``: in which direction designs
    improve; ``value``: None where it is infinite.
    """
    mechanism = Document(text, "model", read_text).mechanism
    found: dict[tuple[str, str], Plain] = {}
    for row in applicable_metrics(mechanism, None, forces=None, steps=STEPS).table:
        metric = METRICS[row.metric]()
        label, subject, _unused, unit, *_rest = row.cells(language)
        entry = {
            "metric": row.metric,
            "subject": row.subject,
            "label": label,
            "of": subject,
            "value": row.value if math.isfinite(row.value) else None,
            "quantity": row.dimension,
            "unit": unit,
            "factor": shown_factor(row.dimension),
            "limit": row.limit,
            "better": metric.better,
            "remark": row.sentence_in(language),
        }
        found.setdefault((row.metric, row.subject), entry)
    return list(found.values())

"""Results as students were told them: kept as JSON, read back, held against those of today."""

import json
from dataclasses import asdict, replace
from typing import Any

from ...grader.marking.verdict import Verdict
from ..ledger.term import Publication
from ..settings.times import Lateness
from .result import Attempts, Result


def result_json(result: Result) -> str:
    """All of a result that its student is told."""
    data: dict[str, Any] = {
        "verdicts": [verdict.to_json() for verdict in result.verdicts],
        "reason": result.reason,
        "late": asdict(result.late),
        "excused": result.excused,
        "attempts": asdict(result.attempts),
    }
    return json.dumps(data)


def read_result(told: Publication, now: Result) -> Result | None:
    """The result that was told; None where its row is damaged. `now` is the one of today."""
    data = told.result
    try:
        return replace(
            now,
            verdicts=tuple(Verdict.from_json(verdict) for verdict in data["verdicts"]),
            reason=str(data["reason"]),
            late=Lateness(**data["late"]),
            excused=bool(data["excused"]),
            attempts=Attempts(**data["attempts"]),
            published=told.at,
        )
    except (KeyError, TypeError, AttributeError):
        return None

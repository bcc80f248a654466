"""Values of a submission as JSON text, so that they can be marked again without being run again."""

import json
from collections.abc import Mapping
from typing import Any

import numpy as np

from ...grader.collecting.wire import Raw


def to_text(raws: Mapping[str, Raw]) -> str:
    """The values, by variable."""
    return json.dumps({name: _plain(raw) for name, raw in raws.items()})


def from_text(text: str) -> dict[str, Raw]:
    """The values that `to_text` wrote."""
    return {name: _raw(data) for name, data in json.loads(text).items()}


def _plain(raw: Raw) -> dict[str, Any]:
    data: dict[str, Any] = {"kind": raw.kind, "note": raw.note, "listed": raw.listed}
    data["absent"] = raw.absent
    if raw.kind == "calls":
        return data | {"calls": [_plain(one) for one in raw.value]}
    if raw.kind != "num":
        return data | {"said": raw.value}
    data["shape"] = list(np.shape(raw.value))
    data["re"] = _flat(np.real(raw.value))
    if np.iscomplexobj(raw.value):
        data["im"] = _flat(np.imag(raw.value))
    return data


def _flat(numbers: Any) -> list[float]:
    return np.asarray(numbers, dtype=np.float64).ravel().tolist()


def _raw(data: Mapping[str, Any]) -> Raw:
    more = {name: data[name] for name in ("note", "listed", "absent")}
    if "calls" in data:
        return Raw(data["kind"], [_raw(one) for one in data["calls"]], **more)
    if "said" in data:
        return Raw(data["kind"], data["said"], **more)
    array = np.array(data["re"], dtype=float)
    if "im" in data:
        array = array + 1j * np.array(data["im"])
    return Raw(data["kind"], array.reshape(data["shape"]), **more)

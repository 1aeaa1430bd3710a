"""Scenes as text: dictionaries, lists, numbers, words and truth values as TOML."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any

import numpy as np


def _value(value: Any) -> str:
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        text = repr(float(value))
        return {"inf": "inf", "-inf": "-inf", "nan": "nan"}.get(text, text)
    if isinstance(value, os.PathLike):
        value = os.fspath(value)
    if isinstance(value, str):
        # JSON escapes as TOML does, but for the delete character.
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, dict):
        pairs = [f"{_key(k)} = {_value(v)}" for k, v in value.items() if v is not None]
        return "{ " + ", ".join(pairs) + " }"
    if isinstance(value, (list, tuple, np.ndarray)):
        return "[" + ", ".join(_value(v) for v in value) + "]"
    raise TypeError(f"{value!r} is nothing that a scene can hold; it needs numbers, words, lists or dictionaries")


def _key(key: str) -> str:
    if key and all(c.isascii() and (c.isalnum() or c in "-_") for c in key):
        return key
    return json.dumps(key, ensure_ascii=False)


def to_toml(scene: Mapping[str, Any]) -> str:
    """The text of a scene given as a dictionary of sections."""
    lines: list[str] = []
    tables: list[tuple[str, Any]] = []
    for key, value in scene.items():
        if value is None or (isinstance(value, (dict, list)) and key != "" and not value):
            continue
        is_table = isinstance(value, dict)
        is_list_of_tables = isinstance(value, (list, tuple)) and all(isinstance(v, dict) for v in value)
        if is_table:
            tables.append((f"[{_key(key)}]", value))
        elif is_list_of_tables:
            tables.extend((f"[[{_key(key)}]]", entry) for entry in value)
        else:
            lines.append(f"{_key(key)} = {_value(value)}")
    for head, table in tables:
        lines += ["", head]
        lines += [f"{_key(k)} = {_value(v)}" for k, v in table.items() if v is not None]
    return "\n".join(lines) + "\n"

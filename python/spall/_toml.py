"""Descriptions in Python as TOML text: dicts become tables, lists of dicts arrays of tables."""
from __future__ import annotations

import json
import os
import tempfile
from typing import Any, List, Mapping, Tuple

from ._spall import Card, Specimen


class Description:
    """A description as text. Cards and specimens in it are written to a temporary folder, which lives as long as this."""

    def __init__(self, description: Mapping[str, Any]) -> None:
        self._folder: Any = None
        self._files = 0
        self.text = self._table(description, ())

    def _file_of(self, value: Any) -> str:
        if self._folder is None:
            self._folder = tempfile.TemporaryDirectory(prefix="spall-")
        self._files += 1
        # A file of its own folder: studies tell cards apart by the file's name.
        folder = os.path.join(self._folder.name, str(self._files))
        os.mkdir(folder)
        if isinstance(value, Specimen):
            file = os.path.join(folder, "specimen.h5")
        else:
            name = "".join(c if c.isalnum() or c in "-_ " else "-" for c in value.name).strip() or "card"
            file = os.path.join(folder, name + ".toml")
        value.write(file)
        return file

    def _value(self, value: Any, where: str) -> str:
        if isinstance(value, bool):
            return "true" if value else "false"
        if isinstance(value, str):
            return json.dumps(value, ensure_ascii=False)
        if isinstance(value, os.PathLike):
            return json.dumps(os.fspath(value), ensure_ascii=False)
        if isinstance(value, (Card, Specimen)):
            return json.dumps(self._file_of(value), ensure_ascii=False)
        if isinstance(value, Mapping):
            inside = ", ".join(f"{self._key(k)} = {self._value(v, where)}" for k, v in value.items())
            return "{ " + inside + " }"
        if hasattr(value, "tolist"):  # numpy
            return self._value(value.tolist(), where)
        if isinstance(value, (list, tuple, range)):
            return "[" + ", ".join(self._value(item, where) for item in value) + "]"
        if isinstance(value, int):
            return str(value)
        if isinstance(value, float):
            return repr(value)
        raise TypeError(f"{where}: {value!r} cannot stand in a description; give text, numbers, lists, dicts, paths, "
                        "cards or specimens")

    @staticmethod
    def _key(key: Any) -> str:
        text = str(key)
        plain = text and all(c.isascii() and (c.isalnum() or c in "-_") for c in text)
        return text if plain else json.dumps(text, ensure_ascii=False)

    def _table(self, table: Mapping[str, Any], path: Tuple[str, ...]) -> str:
        lines: List[str] = []
        below: List[str] = []
        for key, value in table.items():
            if value is None:
                continue
            here = path + (self._key(key),)
            name = ".".join(here)
            if isinstance(value, Mapping):
                below.append(f"[{name}]\n" + self._table(value, here))
            elif isinstance(value, (list, tuple)) and value and all(isinstance(item, Mapping) for item in value):
                below.extend(f"[[{name}]]\n" + self._table(item, here) for item in value)
            else:
                lines.append(f"{here[-1]} = {self._value(value, name)}\n")
        return "".join(lines) + "".join(below)

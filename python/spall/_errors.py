"""Spall's errors. Messages are one line: where it went wrong, what is wrong there, and what is allowed."""
from __future__ import annotations

import re
from typing import Optional


class InputError(ValueError):
    """The input is wrong.

    where: the file and the key, column or row, or the argument, as in the message.
    what: what was found there. allowed: what is allowed or would help; may be empty.
    file, line, key: the parts of `where` if it names a file, else None.
    """

    def __init__(self, message: str, where: str = "", what: str = "", allowed: str = "") -> None:
        super().__init__(message, where, what, allowed)
        self.message = message
        self.where = where
        self.what = what
        self.allowed = allowed
        self.file: Optional[str] = None
        self.line: Optional[int] = None
        self.key: Optional[str] = None
        named = re.match(r"(?P<file>[^:]*\.\w+)(?::(?P<line>\d+))?(?::\s*(?P<key>\S.*))?$", where)
        if named:
            self.file = named["file"]
            self.line = int(named["line"]) if named["line"] else None
            self.key = named["key"]
        else:
            self.key = where.rpartition(": ")[2] or None

    def __str__(self) -> str:
        return self.message


class RunError(RuntimeError):
    """The run failed although its input was acceptable: it diverged, or a file could not be written."""

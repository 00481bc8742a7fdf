# SPDX-License-Identifier: GPL-3.0-or-later
"""Exceptions: all errors of one call, each with what is needed to mend it."""
from typing import NamedTuple, Tuple


class Problem(NamedTuple):
    """One error in a user's data."""

    code: str  #: "unknown_key", "out_of_range", "file_not_found", ...
    message: str  #: what is wrong, in a sentence
    key: str  #: key of the design file, or argument; may be empty
    value: str  #: the value found; may be empty
    remedy: str  #: what would be right; may be empty
    file: str  #: may be empty
    line: int  #: 1-based; 0: unknown

    def __str__(self) -> str:
        place = self.file + (f":{self.line}" if self.line else "")
        what = self.key + (f" = {self.value}" if self.value else "")
        text = ": ".join(part for part in (place, what, self.message) if part)
        return text + (f"; {self.remedy}" if self.remedy else "")


class TrueflankError(Exception):
    """Something that the user can mend. `problems` has all of it; code, message, key, value, remedy,
    file and line are the first problem's."""

    def __init__(self, problems: Tuple[Problem, ...]) -> None:
        super().__init__("\n".join(map(str, problems)))
        self.problems = tuple(problems)
        first = self.problems[0]
        self.code = first.code
        self.message = first.message
        self.key = first.key
        self.value = first.value
        self.remedy = first.remedy
        self.file = first.file
        self.line = first.line


class InputError(TrueflankError, ValueError):
    """The data or arguments are wrong; the program would end with exit code 2."""


class SystemFailure(TrueflankError, OSError):
    """A file could not be read or written; the program would end with exit code 3."""

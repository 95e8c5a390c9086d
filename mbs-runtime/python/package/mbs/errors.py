"""What can go wrong, in the words of the mechanism."""

from __future__ import annotations

from typing import TYPE_CHECKING, TypedDict

if TYPE_CHECKING:
    from mbs.run import Run


class Note(TypedDict):
    """A place in a declaration and what there is to say about it; lines and columns from 1."""

    message: str
    line: int | None
    column: int | None
    length: int | None


class Problem(Note):
    """A problem of a declaration."""

    help: str | None
    notes: list[Note]


class Error(Exception):
    """Values that a mechanism refuses, names that it does not have, a computation that has no result."""


class DeclarationError(Error):
    """A declaration that cannot be compiled. Its text shows every problem with the underlined source."""

    def __init__(self, message: str, problems: list[Problem]) -> None:
        super().__init__(message)
        self.problems = problems

    def __str__(self) -> str:
        return str(self.args[0])


class EndedEarly(Error):
    """A run that could not go on; ``run`` is what it did until then."""

    def __init__(self, message: str, run: Run) -> None:
        super().__init__(message)
        self.run = run

    def __str__(self) -> str:
        return str(self.args[0])


class DoubtWarning(UserWarning):
    """Numbers that should not be trusted, although nothing failed."""

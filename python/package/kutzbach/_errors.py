"""What is raised where there is no answer."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

Told = tuple[str, str | None, str | None, int | None, int | None]
"""Message, help, file, line and column."""


class MechanismError(ValueError):
    """A file or a text that is not a mechanism, or a question that it has no answer to.

    >>> error = MechanismError("there is no joint type `revolut`", "did you mean `revolute`?", "arm.urdf", 4, 29)
    >>> print(error)
    arm.urdf:4:29: there is no joint type `revolut`
      did you mean `revolute`?
    >>> error.line
    4
    """

    message: str
    """What was needed and what was found."""
    help: str | None
    """How to mend it."""
    file: str | None
    """The file, or the name of the text."""
    line: int | None
    """Line, counted from 1."""
    column: int | None
    """Column in characters, counted from 1."""
    others: tuple[MechanismError, ...]
    """Further faults of the same file, in its order."""

    def __init__(
        self,
        message: str,
        help: str | None = None,
        file: str | None = None,
        line: int | None = None,
        column: int | None = None,
        others: Iterable[Told] = (),
    ) -> None:
        told = tuple(others)
        # All of them, so that an error comes whole out of another process.
        super().__init__(message, help, file, line, column, told)
        self.message = message
        self.help = help
        self.file = file
        self.line = line
        self.column = column
        self.others = tuple(MechanismError(*other) for other in told)

    def __str__(self) -> str:
        place = "" if self.file is None else f"{self.file}:{self.line}:{self.column}: "
        lines = [place + self.message]
        if self.help is not None:
            lines.append(f"  {self.help}")
        lines.extend(str(other) for other in self.others)
        return "\n".join(lines)


class Interrupted(KeyboardInterrupt):
    """Ctrl-C while many questions were being answered: ``done`` has the answers so far."""

    done: Any

    def __init__(self, done: Any) -> None:
        super().__init__("interrupted")
        self.done = done

    def __reduce__(self) -> tuple[Any, ...]:
        return (Interrupted, (self.done,))

"""The one error that a print can cause: a single line that names the token and its column."""

from __future__ import annotations

from certificates.terms import ClaimError


class PrintError(ClaimError):
    r"""A print cannot be read, or says something that has no meaning in its environment.

    >>> str(PrintError(4, r"unknown command \foo"))
    'column 5: unknown command \\foo'
    """

    def __init__(self, at: int, problem: str) -> None:
        super().__init__(f"column {at + 1}: {problem}")
        self.column = at + 1
        self.problem = problem

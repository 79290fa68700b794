"""One test for all rows of a table: it takes what a test takes, once, and says which rows fail."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import Any

Test = Callable[..., None]


def each_row(names: str | tuple[str, ...], table: Iterable[Any]) -> Callable[[Test], Test]:
    """Return a decorator as `pytest.mark.parametrize` is, of a test without fixtures.

    Raises ExceptionGroup, when all rows have been tried, where the test fails for some of them.
    """
    several = names.replace(" ", "").split(",") if isinstance(names, str) else list(names)

    def decorated(test: Test) -> Test:
        def whole(**others: Any) -> None:
            wrong, tried = list[Exception](), 0
            for row in table:
                tried += 1
                values = row if isinstance(names, tuple) or len(several) > 1 else (row,)
                try:
                    test(**dict(zip(several, values, strict=True)), **others)
                except Exception as error:
                    error.add_note(f"row {tried}: {values}")
                    wrong.append(error)
            if wrong:
                raise ExceptionGroup(f"{len(wrong)} of {tried} rows fail", wrong)
            assert tried, "a table without rows"

        whole.__name__, whole.__doc__, whole.__module__ = (
            test.__name__,
            test.__doc__,
            test.__module__,
        )
        return whole

    return decorated

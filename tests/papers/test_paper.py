"""The paper opened as data: what hangs in from it is there, and of its kind."""

from __future__ import annotations

from collections.abc import Iterator

import pytest

from juggleproof.papers import paper
from juggleproof.papers.paper import opened
from juggleproof.statements.language import ClaimError


@pytest.fixture
def nothing_opened() -> Iterator[None]:
    opened.cache_clear()
    yield
    opened.cache_clear()


def test_all_that_hangs_in_from_the_paper_loads_holds() -> None:
    for name in opened().hooks:
        assert opened().hook(name, object) is not None


def test_a_hook_that_the_paper_lacks_is_none_holds() -> None:
    assert opened().hook("of-no-paper", object) is None


def test_rejects_a_hook_of_another_kind() -> None:
    with pytest.raises(ClaimError, match="explain_state is no str, which explain-state needs"):
        opened().hook("explain-state", str)


def test_rejects_a_package_that_describes_no_paper(
    nothing_opened: None, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(paper, "PACKAGE", "juggleproof.symbolic")
    with pytest.raises(ClaimError, match="juggleproof.symbolic: PAPER describes no paper"):
        opened()

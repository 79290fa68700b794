"""The store writes one line for each statement, and nothing where nothing changed."""

from __future__ import annotations

import ast
from pathlib import Path

from hypothesis import given, settings
from hypothesis import strategies as st

from juggleproof.certificates import checker
from juggleproof.statements.store import (
    CERTIFICATES,
    DEFAULT,
    STATEMENTS,
    Store,
    WrittenOut,
    write_store,
)

TEXT = "# a title\n\nstatement b/main\nforall x\nshow x = x\n\nstatement a/main\nshow 1 < 2\n"
CERTIFIED = {
    "b": {
        "b/main": {
            "certified": ["proof", [], ["close"]],
            "point": ["b/main", [], {"x": "0"}, ["close"]],
        }
    },
    "a": {"a/main": {"unknown": "not tried"}},
}


def test_a_store_has_a_line_for_each_statement_sorted_by_name(tmp_path: Path) -> None:
    assert write_store(tmp_path, TEXT, CERTIFIED) == 2
    first, second = (tmp_path / CERTIFICATES).read_text(encoding="ascii").splitlines()
    assert first == '["a/main",{"unknown":"not tried"}]'
    assert second.startswith('["b/main",{"certified":["proof",[],["close"]],"point":')
    assert [name for name, *_ in checker.check_folder(str(tmp_path))] == ["b/main", "a/main"]
    store = Store(tmp_path)
    assert store.certificate("b/main", store.texts["b/main"]) == CERTIFIED["b"]["b/main"]
    assert store.certificate("b/main", store.texts["b/main"] + " ") is None


def test_a_store_that_did_not_change_is_not_written(tmp_path: Path) -> None:
    write_store(tmp_path, TEXT, CERTIFIED)
    before = {path.name: path.stat().st_mtime_ns for path in tmp_path.iterdir()}
    assert set(before) == {STATEMENTS, CERTIFICATES}
    assert write_store(tmp_path, TEXT, dict(reversed(CERTIFIED.items()))) == 0
    assert {path.name: path.stat().st_mtime_ns for path in tmp_path.iterdir()} == before
    assert write_store(tmp_path, TEXT, CERTIFIED | {"a": {"a/main": {"unknown": ""}}}) == 1


def test_the_committed_store_is_as_it_would_be_written() -> None:
    store = Store(DEFAULT)
    lines = (DEFAULT / CERTIFICATES).read_text(encoding="ascii").splitlines()
    assert len(lines) == len(store.texts) and lines == sorted(lines)


def test_definitions_are_not_the_text_of_a_statement(tmp_path: Path) -> None:
    text = TEXT.replace("statement b", "define half := 1/2\nstatement b")
    write_store(tmp_path, text, CERTIFIED)
    assert Store(tmp_path).texts["b/main"] == "statement b/main\nforall x\nshow x = x"
    assert checker.check_folder(str(tmp_path))[0] == ("b/main", "certified", "")


LINES = (
    "",
    " ",
    "# a comment",
    " # one that is shifted",
    "given x > 0",
    " given x > 0",
    "show x = x",
    "show same(x)",
    "forall x",
    "statement b/main",
    "statement c/main",
    "define same(t) := t = t",
    "define other(t) := t > t",
)


@settings(max_examples=400, deadline=None, derandomize=True)
@given(st.lists(st.sampled_from(LINES), max_size=9))
def test_both_readers_of_a_file_read_the_same_statements(lines: list[str]) -> None:
    """What the store says that a statement is, the checker has checked."""
    text = "\n".join(["define half := 1/2", "", "statement a/main", "forall x", *lines, ""])
    try:
        checked = checker.read_statements(text)
    except checker.Rejected:
        return
    for name, plain in WrittenOut(text).items():
        try:
            alone, *more = checker.read_statements(plain).values()
            checker.Unfolding(checked[name], checker.Context())
        except checker.Rejected:  # no text of the sources, or one that nothing can settle
            continue
        if more:
            continue
        read = [(word, ast.dump(one)) for word, one in checked[name].lines if word == "show"]
        assert read == [(word, ast.dump(one)) for word, one in alone.lines if word == "show"]
        assert [word for word, _ in checked[name].lines] == [word for word, _ in alone.lines]

"""Z3's votes: right on the whole corpus, exact where it says `fails`, silent where it does not
know.
"""

import subprocess
import sys
from concurrent.futures import ProcessPoolExecutor
from fractions import Fraction
from multiprocessing import get_context

import pytest

from juggleproof.certificates import checker
from juggleproof.statements.vote import Vote, VoteBudget
from juggleproof.votes import z3
from juggleproof.votes.questions import read_statement
from tests.rows import each_row
from tests.votes.corpus import FALSE, ITERATES, SHARP, STATEMENTS, TRUE
from tests.votes.independent import fails_at


def vote(*rows: str, budget: VoteBudget | None = None) -> Vote:
    return z3.vote(read_statement("\n".join(("statement t/t", *rows))), None, budget)


@each_row("name", STATEMENTS)
def test_every_statement_of_the_corpus_is_decided_as_it_is_known_to_be(name: str) -> None:
    statement, expected = STATEMENTS[name]
    cast = z3.vote(statement)
    assert cast.answer == ("holds" if expected else "fails"), str(cast)
    assert bool(cast.model) == (not expected)
    assert 0 < cast.work <= VoteBudget().rlimit + 1000


def test_the_corpus_is_large_and_has_both_kinds() -> None:
    assert len(TRUE) >= 20 and len(FALSE) >= 15


@pytest.mark.parametrize("name", FALSE)
def test_a_rational_model_refutes_the_text_by_an_independent_evaluator(name: str) -> None:
    model = z3.vote(STATEMENTS[name][0]).model
    if any("root" in value for _, value in model) or "exists" in FALSE[name]:
        pytest.skip("the model is algebraic, or something is said to exist")
    assert fails_at(FALSE[name], model)


def test_division_never_reaches_z3_whose_x_over_0_may_be_anything() -> None:
    assert vote("forall x y", "given y != 0", "show implies(x/y = 5, x = 5*y)").answer == "holds"
    with pytest.raises(checker.Rejected, match="division by what may vanish"):
        vote("forall x", "show x/x = 1")
    with pytest.raises(checker.Rejected, match="division by what may vanish"):
        vote("forall x y", "given y >= 0", "show implies(x/y = 5, y > 0)")


def test_strict_and_weak_are_told_apart() -> None:
    assert vote("forall x", "given x > 0", "show x >= 0").answer == "holds"
    weak = vote("forall x", "given x >= 0", "show x > 0")
    assert (weak.answer, weak.model) == ("fails", (("x", "0"),))
    assert vote("forall x y", "given x^2 + y^2 <= 1", "show x + y < 3/2").answer == "holds"
    assert vote("forall x y", "given x^2 + y^2 <= 2", "show x + y < 2").model == (
        ("x", "1"),
        ("y", "1"),
    )


def test_an_algebraic_model_counts_only_after_exact_evaluation(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    rows = ("forall x y", "given x^2 = 2 and x > 0 and y^3 = x", "show y^6 != 2")
    cast = vote(*rows)
    assert cast.answer == "fails" and "root of" in dict(cast.model)["y"]
    monkeypatch.setattr(z3.VoteSession, "_exact", lambda self, value: Fraction(3, 2))
    wrong = vote(*rows)
    assert wrong.answer == "unknown" and "does not pass exact evaluation" in wrong.detail


def test_a_have_line_that_does_not_follow_leaves_the_statement_undecided() -> None:
    cast = vote("forall x", "given x >= 0", "have x > 0", "show 1/x > 0")
    assert cast.answer == "unknown" and cast.detail.startswith("obligation 1: sat")


def test_integers_are_integers() -> None:
    assert vote("forall K", "integer K", "given 0 < K and K < 2", "show K = 1").answer == "holds"
    assert vote("forall K", "integer K", "given K > 0", "show K >= 1").answer == "holds"
    assert (
        vote("forall K", "integer K", "given 0 <= K and K <= 3", "show K^2 != 2").answer != "fails"
    )
    assert (
        vote("forall K x", "integer K", "given K >= 2 and x > 0", "show K*x^2 != 2").answer
        == "fails"
    )


def test_what_exists_is_found_and_refuted() -> None:
    assert vote("forall x", "exists y", "show y^3 + y = x").answer == "holds"
    cast = vote("forall x", "exists y", "show y^2 = x")
    assert cast.answer == "fails" and Fraction(dict(cast.model)["x"]) < 0


def test_sharp_ranges_are_asked_inside_and_outside() -> None:
    statements = checker.read_statements(SHARP)
    answers = {name: z3.vote(statements[name], statements) for name in statements if "-" in name}
    assert {name: cast.answer for name, cast in answers.items()} == {
        "sharp/trap-range": "holds",
        "sharp/trap-wrong": "fails",
        "sharp/trap-wide": "fails",
    }
    assert (
        "outside" in answers["sharp/trap-wrong"].detail
        and "inside" in answers["sharp/trap-wide"].detail
    )
    assert (
        Fraction(1, 3)
        <= Fraction(dict(answers["sharp/trap-wrong"].model)["alpha"])
        <= Fraction(1, 2)
    )


def test_recurrences_are_asked_as_identities() -> None:
    (right,) = checker.read_statements(ITERATES).values()
    (wrong,) = checker.read_statements(ITERATES.replace("K*(K - 1)", "K*(K + 1)")).values()
    assert (z3.vote(right).answer, z3.vote(wrong).answer) == ("holds", "fails")


def test_work_is_counted_and_its_end_says_nothing() -> None:
    hard = (
        "forall a b c x y z",
        "given a^2 + b^2 + c^2 = 1 and x^2 + y^2 + z^2 = 1",
        "show (a*x + b*y + c*z)^2 <= 1",
    )
    cast = vote(*hard, budget=VoteBudget(rlimit=20_000))
    assert cast.answer == "unknown" and cast.work <= 22_000
    assert (
        vote("forall x y", "show x^2 + y^2 >= 2*x*y", budget=VoteBudget(rlimit=1)).answer
        == "unknown"
    )


def test_votes_are_the_same_from_run_to_run_and_in_another_process() -> None:
    texts = [FALSE["two-roots"], TRUE["sup-is-sup"], FALSE["kinetic-decreases"]]
    here = [_vote_on(text) for text in texts]
    with ProcessPoolExecutor(1, mp_context=get_context("spawn")) as pool:
        assert list(pool.map(_vote_on, texts)) == here
    assert [_vote_on(text) for text in texts] == here


def _vote_on(text: str) -> Vote:
    return z3.vote(read_statement(text))


def test_solvers_are_loaded_only_when_they_are_asked() -> None:
    code = (
        "import sys, juggleproof.statements.vote, juggleproof.votes.z3,"
        " juggleproof.votes.boxes\n"
        "print([name for name in ('z3', 'mpmath', 'sympy') if"
        " name in sys.modules])"
    )
    assert (
        subprocess.run(
            [sys.executable, "-c", code], capture_output=True, text=True, check=True
        ).stdout.strip()
        == "[]"
    )

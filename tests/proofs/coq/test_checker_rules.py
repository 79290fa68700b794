"""The rules of the checker in Coq: they accept and reject the certificates of its tables as the
checker does, a rule that checks less is not proved, and all rest on the axioms of the reals only.
"""

from __future__ import annotations

import json
import re

import pytest

from juggleproof.certificates import checker
from tests.certificates.checker.harness import Case, judge
from tests.certificates.checker.rules import TABLES
from tests.proofs.coq.development import SOURCES, Coq, rejects, rest_on_the_reals, source, theorems
from tests.proofs.coq.model import HEAD, NotWritten, accepted
from tests.share import share

# The tables of what is not among Coq's functions.
ELSEWHERE = {"iterates"}
# One change in so many; with JUGGLEPROOF_MUTANTS=many (make exhaust) each.
SHARE = share(6, 1)
FILES = (
    *("Polynomials", "Formulas", "Bernstein", "States", "Coefficients", "Boxes"),
    *("Instances", "Leaves", "Values", "Settling", "Ranges"),
)


@pytest.mark.exhaust
def test_the_rules_rest_on_the_axioms_of_the_reals_alone_holds(development: Coq) -> None:
    asked = [
        f"{file}.{name}"
        for file in FILES
        for name in theorems(source(f"{file}.v"), "Theorem|Lemma")
    ]
    assert len(asked) > 100 and "Leaves.closes_sound" in asked
    assert rest_on_the_reals(development, asked)


def test_every_proof_rule_is_one_of_coqs_holds() -> None:
    text = source("Leaves.v")
    (cases,) = re.findall(r"^Inductive node :=\n(.*?)\.\n", text, re.DOTALL | re.MULTILINE)
    page = (SOURCES.parents[1] / "docs" / "certificates.md").read_text()
    rules = re.findall(r"^### `(\w+)`", page.split("## Proof rules")[1].split("\n## ")[0], re.M)
    assert {name.lower() for name in re.findall(r"\| (\w+)", cases)} == set(rules)


# (file, what is weakened, what stands in its place)
WEAKER = {
    "first-iterate": ("Rules", "(forall s, after O s = s) ->", "(forall s : State, s = s) ->"),
    "two-domains": (
        "Rules",
        "Exists (fun domain : Prop => domain) (inside :: outside) -> ",
        "True -> ",
    ),
    "not-refuted": ("Rules", "Forall (fun domain : Prop => domain -> ~ concluded) outside", "True"),
    "another-point": (
        "Rules",
        "other j) -> (forall j, other j = point j) ->",
        "other j) -> True ->",
    ),
    "pieces-overlap": ("Rules", "guard i s -> ~ guard k s.", "guard i s -> False -> ~ guard k s."),
    "pieces-with-gaps": (
        "Rules",
        "exists k, (k < count)%nat /\\ guard k s.",
        "exists k, guard k s.",
    ),
    "after-the-point": ("Relation", "next t u -> forall j,", "next s u -> forall j,"),
    "loss-at-the-point": ("Lyapunov", "0 <= v -> 0 <= loss s v.", "0 <= v -> -1 <= loss s v."),
    "direction-elsewhere": (
        "Lyapunov",
        "close coordinate point d (direction d) /\\",
        "close coordinate point (d + 1) (direction d) /\\",
    ),
    "inner-space-beside-the-point": (
        "Lyapunov",
        "space s -> close coordinate point radius s -> inner s) ->",
        "space s -> close coordinate point 0 s -> inner s) ->",
    ),
    "negation": (
        "Formulas",
        "| Atom p Positive => Atom (opposite p)",
        "| Atom p Positive => Atom p",
    ),
    "negated-equation": (
        "Formulas",
        "| Atom p Zero => Atom p Nonzero",
        "| Atom p Zero => Atom p Positive",
    ),
    "false-part": (
        "Formulas",
        "if existsb (is_truth false) l then Truth false",
        "if existsb (is_truth false) l then Truth true",
    ),
    "true-part": (
        "Formulas",
        "if existsb (is_truth true) l then Truth true",
        "if existsb (is_truth true) l then Truth false",
    ),
    "quotient-sign": (
        "Formulas",
        "Positive | Nonnegative => mul (fst q) (snd q)",
        "Positive | Nonnegative => fst q",
    ),
    "constant": (
        "Polynomials",
        "if forallb (Nat.eqb 0) m then option_map",
        "if true then option_map",
    ),
    "same-monomial": ("Polynomials", "if same_monomial m k then let sum", "if true then let sum"),
    "zero": (
        "Polynomials",
        "forallb (fun t => Qeq_bool (fst t) 0) p",
        "existsb (fun t => Qeq_bool (fst t) 0) p",
    ),
    "integral-coefficient": ("Polynomials", "Pos.eqb (Qden (Qred (fst t))) 1", "true"),
    "integral-variable": ("Polynomials", "only (member integers) p && forallb", "true && forallb"),
    "negative-coefficient": ("States", "if decide Positive c then", "if decide Nonzero c then"),
    "power-of-an-equation": ("States", "match r with Zero => false", "match r with Zero => true"),
    "odd-power": ("States", "Nonzero => Nat.even e", "Nonzero => true"),
    "strict-fact": (
        "States",
        "Positive | Nonzero => true",
        "Positive | Nonnegative | Nonzero => true",
    ),
    "strict-square": ("States", "(all && nonzero_constant root) || some", "(all && true) || some"),
    "nothing-strict": ("States", "some && is_zero (add s t)", "true && is_zero (add s t)"),
    "sum": ("States", "some && is_zero (add s t)", "some && is_zero []"),
    "multiple": (
        "States",
        "Some (p, Zero), Some s => Some (add",
        "Some (p, _), Some s => Some (add",
    ),
    "closed": ("States", "shut := shut st || negb b", "shut := shut st || b"),
    "one-change": (
        "Bernstein",
        "  Hypothesis at_most_0_before : forall j, (j < k)%nat -> c j <= 0.\n",
        "",
    ),
    "later-change": (
        "Bernstein",
        "  Hypothesis at_least_0_after : forall j, (k <= j <= n)%nat -> 0 <= c j.\n",
        "",
    ),
    "first-sign": ("Bernstein", "  Hypothesis first_negative : c O < 0.\n", ""),
    "last-sign": ("Bernstein", "  Hypothesis last_positive : 0 < c n.\n", ""),
    "outside-the-box": (
        "Bernstein",
        "Definition in_box (t : nat -> R) : Prop := forall i, 0 <= t i <= 1.",
        "Definition in_box (t : nat -> R) : Prop := forall i, 0 <= t i.",
    ),
    "bound-side": ("Coefficients", "if upper then - k else k", "k"),
    "bound-relation": (
        "Coefficients",
        "Some (p, (Positive | Nonnegative)) =>\n",
        "Some (p, _) =>\n",
    ),
    "bound-line": ("Coefficients", "(constant (minus p (scale slope (variable v))))", "(Some 0%Q)"),
    "degree": (
        "Coefficients",
        "(hd O m <=? n)%nat && suits axes (tl m)",
        "(0 <=? n)%nat && suits axes (tl m)",
    ),
    "axis-left-out": (
        "Coefficients",
        "(hd O m =? 0)%nat && suits axes (tl m)",
        "(0 =? 0)%nat && suits axes (tl m)",
    ),
    "ends-of-a-number": (
        "Coefficients",
        "decide Positive (high - low) && suits_all",
        "decide Nonnegative (high - low) && suits_all",
    ),
    "changes": (
        "Coefficients",
        "if (j <? k)%nat then Qle_bool (c j) 0 else",
        "if (j <? k)%nat then Qle_bool 0 (c j) else",
    ),
    "wrong-half": ("Boxes", "snd b ((hd O (fst b) - j)%nat :: tl js)", "snd b (j :: tl js)"),
    "one-half": (
        "Boxes",
        "(lower_half moved :: upper_half moved :: boxes)",
        "(lower_half moved :: boxes)",
    ),
    "wrong-face": (
        "Boxes",
        "if all Qle_bool then Some (ns, fun js => c (n :: js))",
        "if all Qle_bool then Some (ns, fun js => c (O :: js))",
    ),
    "any-face": ("Boxes", "if all Qle_bool then", "if all (fun x y => Qle_bool 0 0) then"),
    "box-left-over": ("Boxes", "  | [], [] => true\n  | Signs", "  | [], _ => true\n  | Signs"),
    "no-such-axis": (
        "Boxes",
        "(p <? length (fst b))%nat && covers",
        "(0 <? length (fst b))%nat && covers",
    ),
    "weak-sign": ("Boxes", "Nonnegative => negb (Qle_bool 0 c)", "Nonnegative => Qle_bool c 0"),
    "unused-variable": ("Boxes", "suits_all axes p && covers", "suits_all axes [] && covers"),
    "licence": ("Instances", "if strict r then Some (mul", "if strict Positive then Some (mul"),
    "integral-denominator": (
        "Instances",
        "same_poly (snd t) (number 1)",
        "same_poly (snd t) (snd t)",
    ),
    "integral-value": (
        "Instances",
        "member (exist s) i || integral_term whole_in (instance_terms s over q fresh i)",
        "true || member (exist s) i",
    ),
    "name-in-a-term": (
        "Instances",
        "forallb (fun t => uses_term (below fresh) (snd t)) q &&",
        "forallb (fun t => true) q &&",
    ),
    "existing-in-a-premise": (
        "Instances",
        "forallb (uses (absent (exist s))) (premises (lines s))",
        "forallb (fun f => true) (premises (lines s))",
    ),
    "root-that-is-negative": (
        "Instances",
        "[atom (variable v) Nonnegative; atom",
        "[atom (number 1) Nonnegative; atom",
    ),
    "case-left-out": ("Leaves", "        | [], [] => true\n", "        | [], _ => true\n"),
    "another-case": (
        "Leaves",
        "assume f (less_choice k st)",
        "assume (negate f) (less_choice k st)",
    ),
    "sign-left-out": ("Leaves", "&& close known equal (assume (atom p Zero) st)", "&& true"),
    "integral-step": ("Leaves", "(minus p (number 1))", "(minus p (number 2))"),
    "not-integral": ("Leaves", "integral (integers st) p && close", "true && close"),
    "not-fresh": ("Leaves", "uses_state (below fresh) st && fits", "true && fits"),
    "instance-of-the-goals": (
        "Leaves",
        "[negate (conjunction (map (instance terms) (premises (lines s))));",
        "[Truth false;",
    ),
    "root-not-fresh": ("Values", "&& uses_state (below v) st &&", "&& true &&"),
    "end-not-fresh": ("Values", "&& uses_term (below v) low &&", "&& true &&"),
    "ends-of-a-root": (
        "Values",
        "[compared (difference low high) Positive; compared",
        "[Truth false; compared",
    ),
    "no-crossing": (
        "Values",
        "&& close known (at_highest r) (assume (negate (compared"
        " (at_value v (equation r) high) Nonnegative)) st)",
        "&& true",
    ),
    "old-root": ("Values", "(width <=? v)%nat && uses_state", "(0 <=? v)%nat && uses_state"),
    "sign-of-values": ("Values", "&& find equal (assume (atom p Zero) st) &&", "&& true &&"),
    "have": (
        "Settling",
        "if close known n (assume (negate f) st) then prove_lines",
        "if close known n (assume f st) then prove_lines",
    ),
    "root-of-a-negative": (
        "Settling",
        "if close known n (assume (atom (opposite p) Positive) st) && uses_state",
        "if true && uses_state",
    ),
    "root-used-before": (
        "Settling",
        "&& uses_state others st && only others p",
        "&& true && only others p",
    ),
    "root-of-itself": (
        "Settling",
        "&& uses_state others st && only others p",
        "&& uses_state others st && true",
    ),
    "exists-as-for-all": (
        "Settling",
        "close known n (assume (negate (conjunction (goals s))) st) | _ => false end",
        "close known n (assume (negate (conjunction (goals s))) st) | _ => true end",
    ),
    "integral-witness": (
        "Settling",
        "forallb (fun i => integral_term (integers st) (witness_terms s q i)) (own_integers s)",
        "forallb (fun i => true) (own_integers s)",
    ),
    "witness": (
        "Settling",
        "&& close known n (assume (negate (conjunction"
        " (map (instance (witness_terms s q)) (goals s)))) st)",
        "&& true",
    ),
    "goal-of-an-adjoined": (
        "Settling",
        "forallb (uses (fun i => (i <? width)%nat || member (exist s) i)) (goals s)\n      && find",
        "forallb (fun f => true) (goals s) && find",
    ),
    "premises-of-a-counterexample": (
        "Settling",
        "shown known st s terms n\n         && close",
        "true && close",
    ),
    "counterexample": (
        "Settling",
        "&& close known m (assume (conjunction (map (instance terms) (goals s)))"
        " (more_integers (fresh_integers s fresh) st))",
        "&& true",
    ),
    "domain-of-parameters": ("Ranges", "uses (member over) domain && uses", "true && uses"),
    "condition-of-parameters": ("Ranges", "&& uses (member over) condition &&", "&& true &&"),
    "inside": (
        "Ranges",
        "prove known (with_lines [Given domain; Given condition] (stated e)) (steps e) (inside e)",
        "true",
    ),
    "possible": (
        "Ranges",
        "&& meets_premises known (with_lines [Given domain] (stated e)) (possible e)",
        "&& true",
    ),
    "outside": (
        "Ranges",
        "(assume (negate condition) (assume domain (no_facts whole_over)))",
        "(assume domain (no_facts whole_over))",
    ),
    "parameter-below": ("Ranges", "&& forallb (below width) over\n", "&& true\n"),
}


def test_every_change_is_of_a_line_that_is_there_holds() -> None:
    absent = [name for name, (file, old, _) in WEAKER.items() if old not in source(f"{file}.v")]
    assert not absent


@pytest.mark.exhaust
@pytest.mark.parametrize("name", list(WEAKER)[::SHARE])
def test_rejects_a_weaker_rule(name: str, development: Coq) -> None:
    file, old, new = WEAKER[name]
    assert rejects(development, f"{file}.v", old, new)


# What a certificate that has no shape, or names what is not there, ends in before Coq is asked.
SHAPELESS = (NotWritten, checker.Rejected, ValueError, TypeError, LookupError)


def written(case: Case) -> str:
    """What Coq is asked of the last statement of a case."""
    known, earlier = {}, {}
    *before, last = checker.read_statements(case.text).values()
    for statement in before:
        outcome, _ = checker.check_one(statement, case.earlier[statement.name], known, earlier)
        earlier[statement.name] = statement
        if outcome == "certified":
            known[statement.name] = statement
    return accepted(last, json.loads(json.dumps(case.certificate)), known, earlier)


@pytest.mark.exhaust
def test_coq_accepts_what_the_checker_accepts_and_nothing_else_holds(development: Coq) -> None:
    asked, expected = [], []
    for rule, module in TABLES.items():
        for case in [*module.ACCEPTED, *module.REJECTED]:
            outcome = judge(case)[0]
            if outcome == "unreadable":
                continue
            fine = outcome in ("certified", "refuted")
            try:
                asked.append(written(case))
            except SHAPELESS:
                assert not fine or rule in ELSEWHERE, (rule, case.defect)
                continue
            expected.append((rule, case.defect, "true" if fine else "false"))
    text = HEAD + "".join(f"Eval vm_compute in ({question}).\n" for question in asked)
    answer = development.ask(text)
    assert answer.accepted, answer.output
    said = re.findall(r"= (true|false)\s+: bool", answer.output)
    assert len(said) == len(expected)
    differ = [one for one, value in zip(expected, said) if one[2] != value]
    assert differ == []
    assert said.count("true") > 130 and said.count("false") > 130

"""The lemma of Coq that a polynomial has one root in an interval, where it changes its sign."""

from __future__ import annotations

from juggleproof.certificates import checker
from juggleproof.coq_store.boxes import BoxHypothesis, axis_of, excluded
from juggleproof.coq_store.branch import Branch
from juggleproof.coq_store.text import polynomial
from juggleproof.coq_store.transfer import value_text
from juggleproof.statements.states import SearchState


def only_root(poly: checker.Poly, low: checker.Poly, high: checker.Poly) -> tuple[str, list[str]]:
    """(the statement, its proof): the polynomial, in one variable, has different signs at two
    numbers and exactly one root between them.

    Two roots x and y would be zeros of (p(x) - p(y))/(x - y).  But on each part of a box this
    polynomial, p(x) or p(y) has one sign.
    """
    (place,) = poly.places()
    context = checker.Context()
    context.declare("x")
    context.declare("y")
    x, y = context.values["x"], context.values["y"]
    shift = checker.BITS * place
    by_power = {m >> shift: c for m, c in poly.terms.items()}

    def at(value: checker.Poly) -> checker.Poly:
        return sum(
            (context.number(c) * value**e for e, c in by_power.items()), start=context.number(0)
        )

    quotient = sum(
        (
            context.number(c) * x**k * y ** (e - 1 - k)
            for e, c in by_power.items()
            for k in range(e)
        ),
        start=context.number(0),
    )
    branch = Branch(SearchState(context), {}, [0])
    ends = [value_text(branch, end) for end in (low, high)]

    def text(value: checker.Poly, at: str = "x'") -> str:
        return polynomial(branch.names, value, values={"x": at})

    function = at(x)
    rising = function if (at(low).constant() or 0) < 0 else -function
    axes = []
    for variable in ("x", "y"):
        own = context.values[variable]
        for side in (own - low, high - own):
            branch.assume(context.atom(side, ">=", context.number(0)), branch.fresh())
        count = len(branch.facts)
        axes.append(axis_of(branch, context.index[variable], count - 2, count - 1))
    bounds = list(branch.facts)
    boxes, zeros = [], []
    for value, along in ((at(x), axes[:1]), (at(y), axes[1:]), (quotient, axes)):
        for signed in (value, -value):
            name = branch.fresh()
            boxes.append(BoxHypothesis(signed, ">=", name, along))
            zeros.append(f"assert ({name} : 0 <= {text(signed)}) by lra.")
    p, q = text(function), text(quotient)
    p_of_y = text(at(y))
    between = " -> ".join(
        f"0 <= {polynomial(branch.names, fact)}" for fact, _ in branch.state.facts
    )
    stated = (
        f"({text(function, ends[0])}) * ({text(function, ends[1])}) < 0 /\\\n"
        f"  exists x' : R, ({ends[0]} < x' /\\ x' < {ends[1]} /\\ {p} = 0) /\\\n"
        f"  forall y' : R, {ends[0]} < y' -> y' < {ends[1]} -> {p_of_y} = 0 -> y' = x'"
    )
    rows = [
        f"assert (of_one : forall x' y' : R, {between} -> {p} = 0 -> {p_of_y} = 0 -> y' = x').",
        "{",
        f"intros x' y' {' '.join(bounds)} of_x of_y.",
        "destruct (Req_dec y' x') as [of_same|of_apart]; [exact of_same|exfalso].",
        f"assert (of_quotient : {q} = 0).",
        "{ apply (Rmult_eq_reg_l (x' - y')); [|lra]. rewrite Rmult_0_r.",
        f"  transitivity (({p}) - ({p_of_y})); [ring|lra]. }}",
        *zeros,
        *excluded(branch, boxes),
        "}",
        "split; [lra|].",
        f"destruct (crossing (fun x' => {text(rising)}) {ends[0]} {ends[1]}",
        "  ltac:(continuous) ltac:(lra) ltac:(lra) ltac:(lra))",
        "  as (x' & of_low & of_high & of_zero).",
        f"assert (of_x : {p} = 0) by lra.",
        f"assert (x' <> {ends[0]}) by (intros ->; lra).",
        f"assert (x' <> {ends[1]}) by (intros ->; lra).",
        "exists x'. split; [repeat split; lra|].",
        "intros y' of_below of_above of_y. apply (of_one x' y'); lra.",
    ]
    return stated, rows

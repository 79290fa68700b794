"""Every example of the page on certificates is accepted by the checker, and no change of it is."""

from __future__ import annotations

import json
import re
from typing import NamedTuple

from tests.certificates.checker.harness import verdict
from tests.docs.pages import ROOT, blocks
from tests.rows import each_row

PAGE = ROOT / "docs/certificates.md"


class Example(NamedTuple):
    """One statement, those before it on the page, and the text of each one's entry."""

    statements: dict[str, str]
    entries: dict[str, str]


def examples() -> dict[str, Example]:
    """Each statement of the page by name."""
    statements: dict[str, str] = {}
    entries: dict[str, str] = {}
    found = {}
    for block in blocks(PAGE):
        if block.language == "statements":
            for text in block.text.strip().split("\n\n"):
                statements[text.split("\n")[0].removeprefix("statement ")] = text
        elif block.language == "certificate":
            name = list(statements)[len(entries)]
            entries[name] = block.text
            before = list(statements)[: len(entries)]
            found[name] = Example({one: statements[one] for one in before}, dict(entries))
    assert len(entries) == len(statements)
    return found


EXAMPLES = examples()
# what stands in the statement or in its entry, what is put in its place, and why that is wrong
CHANGES = [
    ("example/states", '["1", [[0, 1]], "1"], ["1", [[1, 1]]', '["1", [[1, 1]]', "no sum of 0"),
    ("example/states", '"x": "1", "s": "1"', '"x": "1", "s": "-1"', "the other root"),
    ("example/states", "have s >= 1", "have s >= 2", "not so for x = 1"),
    ("example/close", "2*x + 1", "2*x", "no identity"),
    ("example/psatz", '["1", [], "1"], ', "", "no term is strictly positive"),
    ("example/psatz", '["2", [[1', '["-2", [[1', "a negative coefficient"),
    ("example/psatz", "given y >= 0", "given y >= -2", "x = 0 for y = -1"),
    ("example/cases", "x > 1", "x > 0", "not so for x = 1"),
    (
        "example/cases",
        ',\n  ["psatz", [["1", [[0, 1]], "1"], ["1", [[1, 1]], "1"], ["1", [[1, 2]], "1"]], []]',
        "",
        "one alternative is left out",
    ),
    ("example/sign", '"sign", "y"', '"sign", "x"', "the signs of another term"),
    ("example/sign", "given x + y > 0", "given x - y > -9", "not so for x = y = -1"),
    ("example/boxes", "Ba..", "Ba.", "a half is left out"),
    ("example/boxes", "Ba..", "B.", "a coefficient is 1/4"),
    ("example/boxes", "Ba..", "A..", "the coefficients grow and fall"),
    ("example/boxes", "<= 1/4", "< 1/4", "attained at x = 1/2 and y = 1"),
    ("example/integral", "integer n\n", "", "not so for n = 1/2"),
    ("example/integral", '"integral", 0', '"integral", 1', "not the fact that was rounded"),
    ("example/use", '"b": "y - x"', '"b": "x - y"', "another instance"),
    ("example/use", '["use", "example/product"', '["use", "example/use"', "it rests on itself"),
    ("example/refuted", '"x": "-1"', '"x": "1"', "y = 1 exists"),
    ("example/refuted", '"x": "-1"', '"x": "0"', "the premise fails"),
    ("example/witness", '{"y": "-x"}', '{"y": "x"}', "negative where x is"),
    (
        "example/witness",
        '["empty", ["psatz", [["1", [[0, 2]], "1"]], [[1, "-x"]]]]',
        '["empty", ["close"]]',
        "nothing false is assumed",
    ),
    ("example/adjoined", '"0", "a + 1"', '"0", "1"', "1 < 2 for a = 2"),
    ("example/adjoined", '{"s": "t"}', '{"s": "-t"}', "the other root"),
    ("example/squares", '"a": "6"', '"a": "4"', "outside of the range"),
    ("example/sharp", "holds a <= 1", "holds a <= 2", "not so for a = 2"),
    ("example/sharp", "holds a <= 1", "holds a < 1", "so for a = 1"),
    ("example/sharp", "root(a^2 - 1, 0, 9)", "root(a^2 - 1, -9, 9)", "two roots"),
    ("example/sharp", '{"a": "1", "x": "1"}', '{"a": "1", "x": "0"}', "no point of the statement"),
    ("example/iterates", "x -> x + 2\n", "x -> x + 1\n", "the second iterate of another map"),
    ("example/iterates", "x + 2*K\n", "x + 2*K + 1\n", "not x for K = 0"),
    ("example/map", "piece x >= 1", "piece x > 1", "x = 1 has no piece"),
    ("example/map", "piece x < 1", "piece x <= 1", "x = 1 has two pieces"),
    ("example/map", "x - 1", "x - 2", "x = 1 leaves the space"),
    ("example/map", '"apart-2-1"', '"apart-1-2"', "no premise of this name"),
    ("example/relation", '"u": "0"', '"u": "2"', "no guard holds"),
    ("example/relation", "u >= 0 and u <= 1", "u <= 1", "x = 2 leaves the space for u = -1"),
    ("example/descends", "rank x", "rank x/2", "falls by 1/2"),
    ("example/descends", "stage x < 1", "stage x < 1/2", "the rank of 3/4 does not fall"),
    ("example/descends", "map example/map", "map example/none", "no earlier map"),
    ("example/contracts", "rate a", "rate a/2", "nearer by a only"),
    ("example/contracts", "radius 1/2", "radius 2", "x = 2 is not in the set"),
    ("example/contracts", "size 1", "size 1/2", "3/4 is in the set"),
    ("example/lyapunov", "radius 1/2", "radius distance/2", "no constant"),
    ("example/lyapunov", "loss (1 - a)*value", "loss (1 - a/2)*value", "falls less"),
    ("example/lyapunov", "least (1 - a)*distance", "least distance", "more than the loss"),
    ("example/lyapunov", "value x", "value value", "a function of itself"),
    ("example/attracts", "descent example/descends", "descent example/map", "no descent"),
    ("example/into", "attraction example/attracts", "attraction example/lyapunov", "no attraction"),
    ("example/into", "radius 1/2", "radius 0", "no neighbourhood"),
    ("example/integers", "integer n\n", "", "not so for n = 1/2"),
    ("example/integers", "integer n", "integer x", "a state that is an integer"),
    ("example/integers", '"n": "1", "x"', '"n": "1/2", "x"', "no integer"),
    ("example/counts", "x, y - 1", "x, y - 2", "it leaves the space"),
    ("example/descends-by-counts", "rank 2*x, y", "rank y, 2*x", "y grows where x falls"),
    ("example/descends-by-counts", "rank 2*x, y", "rank 2*x", "y alone falls"),
    ("example/descends-by-counts", "rank 2*x, y", "rank x, y", "x/2 falls by less than 1"),
    ("example/escapes", "word 2", "word 1", "another guard holds"),
    ("example/escapes", "start 1/2", "start 0", "the point itself"),
    ("example/double", "2*x", "-2*x", "x = 1 leaves the space"),
    ("example/unstable", "direction distance", "direction 2*distance", "too far"),
    ("example/unstable", "direction distance", "direction x", "not a curve"),
    ("example/unstable", "rate 2", "rate 3", "grows less"),
    ("example/unstable", "upper 1", "upper 1/2", "1 is reached at a distance of 1"),
    ("example/exactly", '"covers"', '"cover"', "a premise is missing"),
    ("example/settles", "never 1\n", "", "1 1 1 .. holds no word"),
    ("example/settles", "never 1", "never 1 2", "1 1 1 .. holds no word"),
    ("example/settles", "never 1", "never 2", "1/2 follows it"),
    ("example/settles", "word 2", "word 3", "no piece 3"),
    ("example/descends-nowhere", "stage 0 = 0", "stage x < 1", "the rank does not fall"),
    ("example/settles-by-rank", "rank x\nword 1\n", "", "1 1 1 .. holds no word"),
    ("example/settles-by-rank", "rank x", "rank x/2", "falls by 1/2"),
    ("example/settles-by-rank", "rank x", "rank x - 2", "-1 where x = 1"),
    ("example/settles-by-rank", "rank x", "rank x_0", "one state alone"),
    ("example/settles-by-rank", "word 1", "word 1 1", "no word round a circle"),
    ("example/returns", "word 1\n", "", "a piece has no word"),
    ("example/returns", "word 1", "word 1 1", "the next state need not be 1 or more"),
    ("example/returns", "word 1", "word 2", "the guard is another"),
]


def outcome(example: Example) -> str:
    """The outcome of the last statement."""
    text = "\n\n".join(example.statements.values()) + "\n"
    entries = {name: json.loads(entry) for name, entry in example.entries.items()}
    *_, (last, _) = verdict(text, entries).values()
    return last


@each_row("name", EXAMPLES)
def test_an_example_is_accepted_holds(name: str) -> None:
    expected = next(iter(json.loads(EXAMPLES[name].entries[name])))
    assert outcome(EXAMPLES[name]) == expected


@each_row(("name", "old", "new"), [row[:3] for row in CHANGES])
def test_rejects_a_changed_example(name: str, old: str, new: str) -> None:
    statements, entries = EXAMPLES[name]
    statement, entry = statements[name] + "\n", entries[name]
    assert (statement + entry).count(old) == 1, "the change is of one place"
    changed = Example(
        {**statements, name: statement.replace(old, new).rstrip("\n")},
        {**entries, name: entry.replace(old, new)},
    )
    assert outcome(changed) == "rejected"


def test_every_rule_has_an_example_and_a_change_holds() -> None:
    page = PAGE.read_text(encoding="utf-8")
    headings = re.findall(r"^### (.+)$", page, re.M)
    assert len(headings) == len(set(headings)) > 15
    for heading in headings:
        text = page.split(f"\n### {heading}\n")[1].split("\n##")[0]
        assert "```statements\n" in text and "```certificate\n" in text, heading
    assert {name for name, *_ in CHANGES} >= set(EXAMPLES) - {"example/product"}

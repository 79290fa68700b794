"""The checker: rebuilds every statement from its text and takes a certificate as a hint.

This folder is all that must be believed.  It uses the standard library only, exact integers only,
and runs alone:

    python -I -S certificates/checker [DIR]

DIR holds `statements.txt`, which an auditor reads, and `certificates.jsonl`, a line for each
statement: ["ID/part", {"certified": ..}], sorted by name.  Exit 0: every statement is certified or
refuted; 1: one is unknown, or a certificate rejected or missing; 2: unusable input.  The files, in
reading order, each resting on those before it:

    algebra.py   polynomials, formulas over them, Bernstein coefficients; knows of no proof
    text.py      terms and formulas as syntax trees; definitions, written out where they are used
    language.py  what a file of statements means: values, statements, unfolding
    rules.py     states, the rules that close them, proofs, witnesses and counterexamples
    maps.py      a map, with what is said of it, as premises about its orbits are written
    orbits.py    the rules for orbits of maps, each with the premises that it rests on
    settling.py  what settles one statement, and a folder of them

The folder runs under two names, `checker` alone and a longer one where it is imported: so it
imports its own files relatively, and only these.  `__all__` is all that others may rest on.
"""

# tables of names, by group and not one a line
# fmt: off
# isort: off
from .algebra import (
    BITS, MAX_VARIABLES, MAX_WORK, Atom, Formula, Join, Kind, Poly, Rejected, Work, bernstein,
    conjuncts, fold, join, negate, number, variable,
)
from .text import Definitions, names_in, parse, put, rational, rows
from .language import (
    NAMED, Context, Statement, Unfolding, read_statements, univariate, variables_of,
)
from .rules import State, close, find, prove
from .orbits import closed_circle, orbit_rules, premises_of, require_no_other, ways_on
from .settling import (
    CERTIFICATES, MAX_FOLDER_WORK, MAX_STATEMENTS, STATEMENTS, check_folder, check_one, load, main,
    read_certificates, report, verdict,
)

__all__ = [
    # the check: a folder, one statement, a part of a certificate; and why something is rejected
    "CERTIFICATES", "Kind", "MAX_FOLDER_WORK", "MAX_STATEMENTS", "Rejected", "STATEMENTS",
    "State", "check_folder", "check_one", "close", "find", "load", "main", "orbit_rules",
    "premises_of", "prove", "read_certificates", "report", "verdict",
    # words of pieces, for who looks for those of a rule on several attractors, or shows them in Coq
    "closed_circle", "require_no_other", "ways_on",
    # the language: text, statements and polynomials, for who writes statements or searches
    "Atom", "BITS", "Context", "Definitions", "Formula", "Join", "MAX_VARIABLES", "MAX_WORK",
    "NAMED", "Poly", "Statement", "Unfolding", "Work", "bernstein", "conjuncts", "fold",
    "join", "names_in", "negate", "number", "parse", "put", "rational", "read_statements",
    "rows", "univariate", "variable", "variables_of",
]

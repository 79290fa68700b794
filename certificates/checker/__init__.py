"""The checker: rebuilds every statement from its text and takes a certificate as a hint.

This folder is all that must be believed.  It uses the standard library only, exact integers only,
and runs alone:

    python -I -S certificates/checker [DIR]

DIR holds `statements.txt`, which an auditor reads, and `certificates.jsonl`, a line for each
statement: ["ID/part", {"certified": ..}], sorted by name.  Exit 0: nothing rejected; 1: a
certificate rejected or missing; 2: unusable input.  The files, in reading order, each resting on
those before it:

    algebra.py   polynomials, Sturm's theorem, Bernstein coefficients; knows of no proof
    language.py  what a file of statements means: text, definitions, statements, unfolding
    rules.py     states, the rules that close them, proofs, witnesses and counterexamples
    settling.py  the rules for orbits of maps, one statement, and a folder of them

The folder runs under two names, `checker` alone and a longer one where it is imported: so it
imports its own files relatively, and only these.  `__all__` is what others may rest on; the names
below it are here until the search has its own.
"""

from .algebra import Kind, Rejected, Work
from .language import Definitions, Statement, parse, read_statements
from .settling import (
    CERTIFICATES,
    STATEMENTS,
    check_folder,
    check_one,
    load,
    main,
    premises_of,
    read_certificates,
    report,
)

__all__ = [
    "CERTIFICATES",
    "Definitions",
    "Kind",
    "Rejected",
    "STATEMENTS",
    "Statement",
    "Work",
    "check_folder",
    "check_one",
    "load",
    "main",
    "parse",
    "premises_of",
    "read_certificates",
    "read_statements",
    "report",
]

# ruff: noqa: F401
from .algebra import BITS, MAX_VARIABLES, MAX_WORK, Poly, bernstein, count_roots, number, variable
from .language import (
    ORDERS,
    Context,
    Unfolding,
    conjuncts,
    fold,
    join,
    names_in,
    negate,
    rational,
    univariate,
    variables_of,
)
from .rules import State, adjoin, check_sharp, close, find, prove, state_of
from .settling import ORBIT_RULES, settle, unique

"""Votes: other ways to decide a statement.  None of them is believed; each vote is recorded beside
the certificate, and one that contradicts it stops everything.

In reading order:

- `questions`: a statement as the questions that decide it;
- `smtlib`: the questions as SMT-LIB 2 text, for Z3 and other solvers;
- `z3`: the vote of Z3;
- `spans`: rational intervals whose ends may be infinite, and boxes around the solutions of facts;
- `branches`: the branches of a question, made simple and put into boxes;
- `box_search`: branch and bound in Arb's balls;
- `boxes`: the vote of boxes;
- `casting`: the votes of the routes named.

Statements are unfolded by the checker, scales and eliminations are the search's, and the arithmetic
is that of `algebra`; every decision is a vote's own.
"""

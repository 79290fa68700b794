"""A theorem on the orbits of any map or relation, as one file of Coq; nothing of it is believed.

In reading order, each importing those before it only:

- `terms`: terms and formulas as Coq texts.
- `kinds`, `templates`: the words of a map, and of a relation; the parts of a file without data.
- `readings`: premises of any rule as Coq lemmas in the words of the statements.
- `frame`: the words in which a file speaks of its map or relation.
- `ranks`: ranks and lexicographic ranks.
- `values`: the rules on Lyapunov's and Chetaev's functions.
- `settles`, `returns`: that every orbit tends to one of several points, or comes to that of one.
- `rules`: the whole file.
"""

"""The searches that come first: with little work, and nothing that is dear to load.

The files, each after those that it imports:

- `at_hand`: small values for every variable
- `linear_system`: statements of linear facts and disjunctions, all of them; rules `psatz`, `cases`
- `by_pairs`: products of at most two facts, by an exact linear program; rules `psatz`, `cases`
- `stages`: these, then the whole search, in turn
"""

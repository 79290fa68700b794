"""The searches that come first: with little work, and nothing that is dear to load.

The files, each after those that it imports:

- `simple_counterexamples`: small values for every variable
- `linear_system`: statements of linear facts and disjunctions, all of them; rules `psatz`, `cases`
- `products_of_two`: products of two facts at most, by an exact linear program; rules `psatz` and
  `cases`
- `searches_in_turn`: these, then the whole search, in turn
"""

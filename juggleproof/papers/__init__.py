"""A paper as data: its folder, its hooks, and what every paper has.

- `paper`: the description of a paper, and the paper that commands are about.
- `notation`: names of statements, sentences and prints, with their LaTeX and meanings.
- `derived`: the results of SymPy for the claims, stored as text, so that SymPy is not loaded.
- `derivations`: derived expressions as terms that carry their origin.
- `indexed_claims`, `index`: the claims by id, each loaded on demand; the data that `list` prints.
- `ledger`: the paper item by item, with the claims or the reason that settle each item.
- `places`: the place of a claim, as a reader of the paper finds it.
- `remarks`: the meanings of symbols, and the citations.
"""

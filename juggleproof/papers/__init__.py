"""A paper as data: where its folder is and what hangs in from it, and what every paper has.

- `paper`: a paper described, and the one that commands are about, opened.
- `derived`: what SymPy derives for the claims, as text, so that they are stated without it.
- `derivations`: derived expressions as terms that carry their origin.
- `indexed_claims`, `index`: the claims by id, loaded when they are asked for; what `list` prints.
- `ledger`: what the paper prints, item by item, and the claim or the reason that settles each item.
- `places`: where a claim stands, as a reader of the paper finds it.
- `remarks`: the meanings of symbols, and what is cited.
"""

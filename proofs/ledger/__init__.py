"""The ledger: what the paper prints, item by item, and the claim or the reason that settles each
item.

    ledger          the reasons, the list of items rebuilt from the paper, and the ledger checked
    rows.tsv        the items in order
    index           the claims in order, as `list` prints them, each with its module; index.json
    indexed_claims  the claims by id, loaded when they are asked for
    derived         what SymPy derives for the claims, as text, so that they are stated without it
"""

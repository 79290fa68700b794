"""The ledger: what the paper prints, item by item, and the claim or the reason that settles each
item.

    rows.tsv       the items in order
    index.json     the claims in order, as `list` prints them, each with its module
    derived.json   what SymPy derives for the claims, as text
    names.tsv      the meanings of names, by section
    citations.tsv  what is cited, and the remarks on it
    unprinted      the claims that no item of the paper carries
"""

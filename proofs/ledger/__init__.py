"""The ledger: what the paper prints, item by item, and the claim or the reason that settles each
item.
"""

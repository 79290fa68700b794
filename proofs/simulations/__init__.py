"""What simulations show of the paper's sentences about motion; nothing here is proved.

figures: what is kept in `figures.json`
compute: the same, as the scenes compute it: `python -m juggleproof.proofs.simulations.compute`
"""

"""Reports: the regenerated appendix, the theorem with its proof, errata and figures, from the
claims and the derivations.
"""

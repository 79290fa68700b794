"""Arithmetic that the search and the votes share: polynomials, real algebraic numbers, intervals,
conditions, semidefinite programs.  None of it is believed.
"""

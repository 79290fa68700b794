"""Comparisons of proof engines, and speed against error; may import everything, and nothing imports
it but `juggleproof bench`.
"""

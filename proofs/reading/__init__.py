"""The reader of prints: LaTeX as the paper has it, to tokens, to a tree, to exact terms and
formulas.
"""

"""The reader of prints: LaTeX as the paper has it, to tokens, to a tree, to exact terms and
formulas.

    lexer       tokens, the commands that are known, and the error of a print
    tree        the nodes of a tree
    parser      tokens to a tree, by a Pratt parser
    values      scalars, vectors, matrices, functions and regions
    evaluation  the meanings of names, and the value of a term
    meaning     what a print states, and the print that a claim receives
    edits       single changes of a print
"""

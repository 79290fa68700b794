"""The search for certificates of the table that moves as a sine, and covers by what it finds.

Nothing here is believed: the second checker, `certificates/sine`, reads what is found.

- `cycles`: the strongly connected parts of a graph.
- `search`: finds a certificate for a box of parameters.
- `stored`: the stored statement, and what the second checker says of it.
- `cover`: covers a rectangle by boxes, over any executor.
"""

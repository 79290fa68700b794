"""Drawing: what figures and pictures of scenes share.

- `lines`: arcs of parabolas, as numbers.
- `look`: the look of figures.
- `drawing`: how figures are saved, and a plane to draw on.
"""

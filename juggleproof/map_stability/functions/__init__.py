"""Functions that fall along all orbits of a map, or grow close to a point, as statements with their
constants; found in floats, and believed by nobody.

In reading order, each importing those before it only:

- `templates`: sums of terms, by linear programs on samples.
- `candidates`: a point with a part of the domain, its candidates, and constants that fit samples.
- `norms`: polytope norms that piecewise affine maps contract.
- `saturated`: quadratic forms that fall by c V/(1 + V), as saturated maps ask for.
- `energies`: forms that a piece conserves, over two steps.
- `envelopes`: functions of one variable, by fractional linear involutions.
- `weighted_terms`: the greatest of weighted terms: distances, with the part metric, and sums of
  absolute values.
- `equations`: a point by its equations, and terms in the parameters.
- `ratio_searches`: how the premises of weighted ratios are searched for.
- `ratios`: greatest weighted ratios, with weights that depend on the parameters.
- `two_sided`: functions of one variable, a distance on each side of the point.
- `second_iterate`: the same of decreasing maps, with the next state's distance.
- `contracting_boxes`: boxes that the map takes into smaller ones, and how orbits enter them.
- `chetaev`: functions that grow, quadratic or linear in a cone.
"""

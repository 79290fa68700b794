"""What Z3 and floats suggest; none of it is believed.

The files, each after those that it imports:

- `asking`: Z3's vote on a condition, and its model
- `clauses`: cases of disjunctions, led by conflicts that Z3 finds; rule `cases`
- `few_values`: points where some variables have few values and the others are linear
- `models`: values near which floats or Z3 see a solution
- `isolated`: points that equations alone determine, or where sets touch
"""

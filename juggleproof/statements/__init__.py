"""The language of statements and the store, and what the searches share.

In reading order, each importing those before it only:

- `formulas`: terms and formulas as values, and their text.
- `language`: statements as values, and their text; all names of the language stand here.
- `cases`: lines about maps as a person writes them, brought to those that the checker takes.
- `definitions`: the names by which a file of statements is shorter.
- `nodes`: the shape of certificates.
- `work`: counted work, and statements unfolded once.
- `states`: what a search assumes on one branch, and the branches below it.
- `processes`: the same work on many items, over processes.
- `vote`: what a vote is, and the stop when one contradicts what was checked.
- `store`: statements and certificates as files.
"""

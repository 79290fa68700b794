"""The language of statements, the searches that find certificates, their store, and the checker
that believes none of them.

In reading order:

- `checker`: reads statements and certificates, and says whether these prove those;
- `nodes`: the shape of certificates;
- `formulas`: terms and formulas as values, and their text;
- `language`: statements as values, and their text; all names of the language stand here;
- `cases`: lines about maps as a person writes them, brought to those that the checker takes;
- `definitions`: the names by which a file of statements is shorter;
- `algebra`: arithmetic that the search and the votes share;
- `work`: counted work, and statements unfolded once;
- `processes`: the same work on many items, over processes;
- `states`: what a search assumes on one branch, and the branches below it;
- `search`: finds certificates;
- `vote`, `votes`: other ways to decide a statement, recorded beside the certificate;
- `store`: statements and certificates as files;
- `coq`: the stored statements as Coq lemmas.
"""

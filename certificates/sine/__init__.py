"""The table that moves as a sine: every motion tends to the period-one bounce, over boxes of
parameters.  In reading order:

- `flights`: the enclosure of flights, for a box of parameters;
- `checker`: the theorem, the rules that prove it from flights, statements and certificates.

These two are the second checker, which alone is believed: `python -I -S certificates/sine [DIR]`.

- `search`: finds a certificate for a box;
- `cover`: covers a rectangle by boxes, over any executor;
- `stored`: what the stored certificate says.
"""

"""The table that moves as a sine: every motion tends to the period-one bounce, over boxes of
parameters.  In reading order:

- `flights`: the enclosure of flights, for a box of parameters;
- `cells`: cells of states, their ranks, and the rules that prove the theorem from flights;
- `checker`: the theorem, what refutes it, statements and certificates.

These three are the second checker, which alone is believed: `python -I -S certificates/sine [DIR]`.
"""

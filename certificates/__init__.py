"""What is believed, and what it has accepted.

- `checker`: reads statements and certificates, and says whether these prove those.
- `store`: the statements of the paper's claims, and their certificates.
- `sine`: the second checker, of the table that moves as a sine, with stores of its own.
"""

"""The language of statements, the searches that find certificates, their store, and the checker
that believes none of them.
"""

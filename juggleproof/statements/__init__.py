"""The language of statements, the store, and what searches share of both."""

"""The language of statements, the store of certificates, and the helpers that searches share."""

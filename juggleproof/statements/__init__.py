"""The language of statements, the store of certificates, and the code that searches share."""

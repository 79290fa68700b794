"""A reader of every certificate that was written from the two pages of docs alone."""

"""The search for certificates of the table that moves as a sine, and covers by what it finds."""

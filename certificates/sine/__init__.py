"""The table that moves as a sine."""

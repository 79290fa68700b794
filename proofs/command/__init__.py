"""The command `juggleproof`."""

"""`juggleproof simulate juggler`.  In reading order:

command   the options, and what is done for them
tables    the tables that it prints
pictures  the pictures that it draws
"""

"""`juggleproof simulate juggler`.  In reading order:

command   what is asked for, and done
tables    the tables that it prints
pictures  the pictures that it draws
"""

"""The table that moves as a sine.  In reading order:

curves   where the bounce of one period is born, and where it loses its stability or its monopoly
picture  which boxes of parameters are certified, between these curves
"""

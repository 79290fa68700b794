"""The table that moves as a sine.  In reading order:

curves    where the bounce of one period is born, and where it loses its stability or its monopoly
motion    flights, impacts, rest and launch, simulated
plane     what the pictures have in common
cover     which boxes of parameters are certified, between the curves
pictures  ball and table over time; how long states take to the bounce
"""

"""The symbols of the paper, without assumptions: what a step needs of them is stated where it is
needed.
"""

from __future__ import annotations

from sympy import Symbol

alpha = Symbol("alpha")  # coefficient of restitution
beta = Symbol("beta")  # height of the ball when the table is at its lowest
v = Symbol("v")  # speed of the ball then, upwards
rho = Symbol("rho")  # height of the table
u = Symbol("u")  # speed of the table, upwards
r = Symbol("r")  # launch speed of the table
g = Symbol("g")  # gravity
t = Symbol("t")  # time of flight
tau = Symbol("tau")  # time of collision, counted from the table's launch
K = Symbol("K")  # number of table periods that one flight of the ball lasts
n = Symbol("n")  # number of iterations
x = Symbol("x")  # height in units of r T
w = Symbol("w")  # closing speed in units of r
z1 = Symbol("z1")  # height above that of the fixed point
z2 = Symbol("z2")  # speed less that of the fixed point
E0 = Symbol("E0")  # energy of the state that an orbit starts from

"""The moving system, iterated by the maps that `symbolic` derives.

juggler  orbits of the paper's map in four arithmetics
part     the part on the vibrating table
table    a ball on a table that moves as a sine
errors   SceneError, for what cannot be carried out
"""

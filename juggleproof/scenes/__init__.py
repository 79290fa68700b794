"""The moving system: orbits of the map, and figures of the states, maps and regions, from what
`symbolic` derives.

    juggler  orbits of the paper's map in four arithmetics
    part     the part on the vibrating table
    figures  the figures of the paper
    errors   SceneError, for what cannot be carried out
"""

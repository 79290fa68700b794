"""The moving system: orbits of the map, and figures of the states, maps and regions, from what
`symbolic` derives.
"""

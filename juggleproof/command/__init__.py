"""The command `juggleproof`.  In reading order:

main              what each command takes, and one line for what goes wrong
outputs           files that commands write, and progress
certify           `certify`: claims
problems          `certify`: problems of SMT-LIB
sine              `certify sine`: a rectangle of parameters
check             `check`
show              `list`, `errata` and `export`
explain           `explain ID`
theorem           `explain theorem`: the paper's bounds, and one state with its orbit
bound             `bound` and `bench`
report            `report`
formats           what it writes in each format
simulate_options  what `simulate` takes
simulate          `simulate`: one scene
juggler           `simulate juggler`, a folder
simulate_part     `simulate part`
simulate_table    `simulate table`
"""

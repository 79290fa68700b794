"""The command `juggleproof`.  In reading order:

main              the options of each command, and one line for each error
outputs           files that commands write, and progress
certify           `certify`: claims
problems          `certify`: problems of SMT-LIB
sine              `certify sine`: a rectangle of parameters
check             `check`
listing           `list`
show              `errata` and `export`
explain           `explain ID`
bound             `bound` and `bench`
stability         `stability`
report            `report`
formats           the files of a report in each format
simulate_options  the options of `simulate`
juggler           `simulate juggler`, a folder
simulate_part     `simulate part`
simulate_scene    its scene, by its options
simulate_table    `simulate table`
"""

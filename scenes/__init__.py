"""The moving system: figures of the states, maps and regions that `symbolic` derives."""

"""Cut-away set of one shift rail: shaft, hub, sleeve, rings, gears, rail, fork, finger, housing."""

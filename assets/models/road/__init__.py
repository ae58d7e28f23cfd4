"""The road and its surroundings. Every node's origin is on the ground: z = 0 is the road surface."""

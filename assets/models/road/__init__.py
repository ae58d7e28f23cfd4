"""The road and what passes by. Every node stands on the ground at its origin: z = 0 is the road surface."""

"""Interior of a left-hand-drive compact hatchback."""

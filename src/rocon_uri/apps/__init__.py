"""Apps: what packages export as such, and whether a robot can run them."""

"""What a start would do: which providers start, in which order, and which faults prevent it."""

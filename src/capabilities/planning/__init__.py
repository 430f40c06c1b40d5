"""What a start would do: which providers, in which order, and what stands in the way."""

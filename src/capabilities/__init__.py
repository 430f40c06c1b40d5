"""What robots can do: capability interfaces, their providers, and where packages export them."""

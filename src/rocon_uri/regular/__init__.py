"""Regular languages of names: syntax, automata, and what two of them have in common."""

"""Public outcomes of robots on stairs beside kaidan's answers."""

"""Design: which robot takes the stairs that are to be taken."""

"""Journeys in a browser; a package, for its conftest is not the only one of that name."""

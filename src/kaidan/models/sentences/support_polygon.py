"""What the reader must know of an answer by the support polygon."""

FLIGHT_ALONE = (
    "The support polygon judges the traverse of the regular flight, not entering or landing."
)

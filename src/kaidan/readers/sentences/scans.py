"""What the reader of a scan must know, as sentences."""

FLOOR_SHORT = (
    "Only {seen_mm:.0f} mm of the level before the first riser were seen: it may be a tread and no "
    "floor."
)
UPSIDE_DOWN = (
    "Nothing says from where the cloud was seen, and upside down it would be stairs too: {up} is "
    "taken for up, --up states it."
)
LANDING_UNSEEN = "No landing was seen behind the last nosing: the flight may go on."
REGULAR = (
    "{alone} of {steps} nosings were measured one by one; the others are taken from the regular "
    "flight that fits best."
)

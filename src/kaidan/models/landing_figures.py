"""How a robot turns on landings."""

from typing import ClassVar, Literal

from kaidan.answer import Part

TurnWay = Literal["straight", "spin", "corner", "manoeuvre", "none", "unknown"]


class TurnFigures(Part):
    """How a robot turns on a landing."""

    turn_deg: float | None
    """Angle between both ways, to the left positive [deg]; null: not known."""
    way: TurnWay
    """Straight on, on the spot, round the corner in one go, by a manoeuvre, not at all; unknown:
    its width, or the landing, is."""
    tight: bool
    """Whether it has no room to be 30 mm off."""
    flippers: str
    """Posture in which it turns, as the option is written; if it does not, the one that was tried
    with the smallest circle."""
    changed: bool
    """Whether that is another posture than the one in which it climbs."""
    circle_m: float | None
    """Circle that it sweeps on the spot in that posture [m]; null: of unknown width."""
    room_m: float | None
    """Largest circle inside the landing [m]; null: the landing is not drawn."""
    moves: int
    """Drives straight on or back and turns on the spot from the way by which it arrives to that by
    which it goes on, each until the next begins: of a quarter on the spot 3, drive, turn, drive. 0:
    straight on, round the corner, or none was found."""
    reversals: int
    """Changes between driving forward and back among them."""
    most_moves: int
    """Moves of a manoeuvre up to which it counts, of the robot's sheet."""

    @property
    def long(self) -> bool:
        """Whether it takes a manoeuvre of more moves than count."""
        return self.way == "manoeuvre" and self.moves > self.most_moves

    @property
    def holds(self) -> bool:
        """Whether it turns in the worst case too."""
        return self.way not in ("none", "unknown") and not (self.tight or self.long)


class LandingTurn(TurnFigures):
    """How the robot turns on a landing of hand-entered stairs."""

    landing: str
    """Which landing."""


class LandingTurns(Part):
    """How the robot turns on all landings of hand-entered stairs."""

    shown_as: ClassVar[str] = "turns"

    turns: tuple[LandingTurn, ...]
    """From bottom to top."""

"""What the contact model knows of friction and grousers."""

from typing import ClassVar

from kaidan.answer import Part


class TractionFigures(Part):
    """Friction that the traverse requires, with its grousers and without."""

    shown_as: ClassVar[str] = "traction"

    belt: str
    """smooth, grousers, or not stated (taken as smooth)."""
    required_friction: float | None
    """Static friction below which the robot slips for good somewhere, in the worst case [1]; null:
    no friction is enough."""
    smooth_required_friction: float | None
    """The same of smooth belts [1]."""
    usual_required_friction: float | None
    """The same with grousers of 10 mm, 40 mm apart [1]; null where friction is stated or the belts
    have grousers, and where no friction is enough with them."""
    phase: str | None
    """Part of the traverse where the first is required."""
    step: int | None
    """Nosing at which, counted from the bottom."""
    slip_mm: float | None
    """How far the robot may slip before grousers hold it, in the worst case [mm]; null: it
    does not rely on them."""
    slip_heights_mm: dict[str, float]
    """Kinetic-energy height of that slip in each phase with one, which adds to the energy threshold
    there [mm]."""
    standing_phases: tuple[float, float] | None
    """Share of the belt's phases in which a grouser stands at a nosing of the flight, in the worst
    and in the best case [1]; null without grousers."""
    strength_margin_N: float | None
    """Strength of a grouser less half of the tractive force [N]; null: not stated."""

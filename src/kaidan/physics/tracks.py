"""Models of the track of a trial: smooth and yielding belt, sprung noses, grousers, chain."""

from typing import Annotated, ClassVar, Literal

from pydantic import Field

from kaidan.sheet import Sheet, quantity


class SmoothBelt(Sheet):
    """Rigid track with a smooth surface that runs round it."""

    label: ClassVar[str] = "track model: smooth belt"
    kind: Literal["smooth-belt"] = "smooth-belt"


class SprungNoses(Sheet):
    """Smooth belt on stairs that yield: each step rests on two springs, level and upright.

    The loaded step travels downhill with the robot, so this is no model of a track that yields.
    """

    label: ClassVar[str] = "track model: sprung noses"
    kind: Literal["sprung-noses"] = "sprung-noses"
    stiffness: float | None = quantity(
        "N/m",
        1e2,
        1e8,
        "force per length by which a nosing presses into both tracks; the robot sheet's without",
        default=None,
    )
    nose_mass: float = quantity("kg", 0.05, 100.0, "mass of a step on its springs", default=1.0)
    damping_ratio: float = quantity("1", 0.0, 5.0, "of a step on its springs", default=0.5)


class YieldingBelt(Sheet):
    """Belt whose rubber presses in and shears at each contact: compliance in the robot.

    Smooth without a height; else with half-round grousers of the same rubber on both belts.
    """

    label: ClassVar[str] = "track model: yielding belt"
    kind: Literal["yielding-belt"] = "yielding-belt"
    stiffness: float | None = quantity(
        "N/m",
        1e2,
        1e8,
        "force per length by which a nosing presses into both tracks; the robot sheet's without",
        default=None,
    )
    shear_ratio: float | None = quantity(
        "1",
        0.01,
        100.0,
        "stiffness along the track to that across it; the robot sheet's, else 1",
        default=None,
    )
    damping_ratio: float = quantity(
        "1", 0.0, 5.0, "of the robot's mass on the rubber at one nosing", default=0.08
    )
    height: float | None = quantity(
        "m", 0.0, 0.1, "of half-round grousers above the belt; none without", default=None
    )
    spacing: float = quantity("m", 0.01, 0.5, "of the grousers along the belt", default=0.033)


class DrivenGrousers(Sheet):
    """Smooth belt with grousers that run round it, driven, each on a radial spring."""

    label: ClassVar[str] = "track model: driven grousers"
    kind: Literal["driven-grousers"] = "driven-grousers"
    height: float | None = quantity(
        "m", 0.002, 0.1, "above the belt; the robot sheet's, else 10 mm", default=None
    )
    spacing: float | None = quantity(
        "m",
        0.01,
        0.5,
        "along the belt, rounded to fit; the robot sheet's, else a 40th of the belt",
        default=None,
    )
    stiffness: float = quantity(
        "N/m", 1e3, 1e8, "of a grouser, radially, both belts together", default=2e5
    )


class ShoeChain(Sheet):
    """Chain of hinged rigid shoes round the track, tensioned, pulled by a sprocket: a check."""

    label: ClassVar[str] = "track model: shoe chain"
    kind: Literal["shoe-chain"] = "shoe-chain"
    shoes: int = Field(
        default=40,
        ge=12,
        le=120,
        description="number of shoes",
        json_schema_extra={"unit": "shoes"},
    )
    thickness: float = quantity("m", 0.002, 0.05, "of a shoe", default=0.008)
    tension: float = quantity(
        "N",
        1.0,
        1e5,
        "of both runs together; less than thrice the traction of a 20 kg robot lets shoes jam",
        default=600.0,
    )


TrackModel = Annotated[
    SmoothBelt | YieldingBelt | SprungNoses | DrivenGrousers | ShoeChain,
    Field(discriminator="kind"),
]
KINDS: dict[str, type[SmoothBelt | YieldingBelt | SprungNoses | DrivenGrousers | ShoeChain]] = {
    "smooth-belt": SmoothBelt,
    "yielding-belt": YieldingBelt,
    "sprung-noses": SprungNoses,
    "driven-grousers": DrivenGrousers,
    "shoe-chain": ShoeChain,
}

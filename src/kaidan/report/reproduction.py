"""The paper again: what its text prints, what the formulas give, and the difference.

Only numbers that stand in the text of the article are in here. The points of its Figs. 13, 16, 19
and 21 other than these are in the pictures alone; they are missing, not guessed.
"""

import math
from typing import Any, NamedTuple

import numpy as np

from kaidan.assessment import case_of
from kaidan.assessment.case import Case
from kaidan.mechanics.margin import theta_s_sup, theta_s_sup_arccos, theta_s_sup_corrected
from kaidan.mechanics.measures import energy_margin_backward, kinetic_energy_height
from kaidan.mechanics.plane import contact_count
from kaidan.mechanics.triangle import alpha, beta, d_C, theta_alpha
from kaidan.report.d_a_plane import Plane, d_a_plane
from kaidan.report.margin_curve import Array, MarginCurve, margin_curve
from kaidan.robot import Robot
from kaidan.stairs import Stairs

PAPER = "Endo & Nagatani 2016, ROBOMECH Journal 3:20, doi:10.1186/s40648-016-0058-y"

TESTED = (0.150, 0.180, 0.200, 0.220)
"""Nosing spacings of the paper's tests [m]."""

FRICTION_SHOWN = 2.0
"""Static friction with which Fig. 7 is drawn: ours, the paper prints none [1]."""

NOT_PRINTED = (
    "The other points of the paper's Figs. 13, 16, 19 and 21 stand in its pictures only and are "
    "not shown."
)


FIG_7_NOTE = (
    f"After Fig. 7, a schematic without numbers. $\\mu_s$ = {FRICTION_SHOWN:g} and the area of "
    "downhill slip are ours, not the paper's."
)
FIG_11_NOTE = "After Fig. 11. The lower limit and the end of the model are ours."


class Row(NamedTuple):
    """One number of the text beside ours."""

    quantity: str
    place: str
    """Where in the paper."""
    unit: str
    printed: str
    """As the text prints it; empty where it prints nothing."""
    computed: float
    """NaN where it was measured and cannot be computed."""
    role: str
    """"input", "prediction", "measurement" or "not printed"."""
    note: str

    @property
    def difference(self) -> float:
        """Computed minus printed; NaN where either is missing."""
        return self.computed - float(self.printed) if self.printed else math.nan


class Measured(NamedTuple):
    """What the text prints of the experiments; angles in degrees, lengths in millimetres."""

    fell_p: float = 150.0
    fell_low: float = 55.0
    fell_high: float = 57.0
    """It fell between these slopes (5 trials each)."""
    theta_d: float = 2.6
    theta_d_at: tuple[float, float] = (150.0, 56.8)
    theta_M_low: float = 1.2
    theta_M_high: float = 2.6
    theta_M_p: float = 150.0
    swung_at: tuple[float, float] = (200.0, 44.0)
    """No fall, but the body swings."""
    speed: float = 100.0
    """Of all tests [mm/s]."""


MEASURED = Measured()


class StateC(NamedTuple):
    """The triangle of Fig. 10 at the steepest slope: lengths in m, angles in rad."""

    L: float
    C_L: float
    C_N: float
    p: float
    n: int
    d_C: float
    alpha_C: float
    beta_C: float
    theta_alpha_C: float
    theta_s: float
    """theta_s_sup, where the centroid is plumb above the lowest contact."""
    outline: float
    """End radius of the outline drawn [m]; not of the paper."""


def kenaf() -> Robot:
    """The robot of Table 1."""
    return Robot.named("kenaf")


def _table_1() -> dict[str, float]:
    robot = kenaf()
    return {"L": robot.track.flat_length, "C_L": robot.com_from_front, "C_N": robot.com_height}


def corrected(p: float = 0.150) -> tuple[float, float]:
    """Corrected margin of Eq. (24) from the printed theta_d and theta_M, low and high [deg]."""
    sup = math.degrees(theta_s_sup(p=p, **_table_1()))
    low, high = (
        theta_s_sup_corrected(theta_s_sup=sup, theta_d=MEASURED.theta_d, theta_M=theta_M)
        for theta_M in (MEASURED.theta_M_high, MEASURED.theta_M_low)
    )
    return float(low), float(high)


def table_1() -> tuple[Row, ...]:
    """Table 1 of the paper beside the catalogue's sheet."""
    names = (
        ("centroid from the front, C_L", "C_L", "196"),
        ("centroid height, C_N", "C_N", "71"),
        ("length of the flat area, L", "L", "470"),
    )
    held = _table_1()
    return tuple(
        Row(text, "Table 1", "mm", printed, 1e3 * held[key], "input", "as the catalogue holds it")
        for text, key, printed in names
    )


def comparison() -> tuple[Row, ...]:
    """Every result that the text prints as a number, beside ours."""
    at = _table_1()
    sup = {p: math.degrees(theta_s_sup(p=p, **at)) for p in TESTED}
    low, high = corrected()
    swing_p, swing_theta = MEASURED.swung_at[0] / 1e3, math.radians(MEASURED.swung_at[1])
    energy = _energy_margin_mm(swing_p, swing_theta)
    kinetic = 1e3 * float(kinetic_energy_height(v=MEASURED.speed / 1e3))
    return (
        *table_1(),
        Row(
            "predicted margin theta_s_sup at 150 mm",
            "Discussion; Eqs. (19)-(23)",
            "deg",
            "60.2",
            sup[0.150],
            "prediction",
            "",
        ),
        *(
            Row(
                f"predicted margin theta_s_sup at {1e3 * p:.0f} mm",
                "Fig. 11, a picture",
                "deg",
                "",
                sup[p],
                "not printed",
                "the text prints no number",
            )
            for p in TESTED[1:]
        ),
        Row(
            "slopes at which it fell at 150 mm, lowest",
            "Discussion, Fig. 13",
            "deg",
            "55.0",
            low,
            "measurement",
            "computed: Eq. (24) with theta_d 2.6 and theta_M 2.6 deg",
        ),
        Row(
            "slopes at which it fell at 150 mm, highest",
            "Discussion, Fig. 13",
            "deg",
            "57.0",
            high,
            "measurement",
            "computed: Eq. (24) with theta_d 2.6 and theta_M 1.2 deg",
        ),
        Row(
            "slope at 200 mm without a fall, but swinging",
            "Discussion, Fig. 14",
            "deg",
            "44.0",
            sup[0.200],
            "measurement",
            f"computed: theta_s_sup, above it as Eq. (7) demands; energy margin {energy:.2f} mm, "
            f"v^2/2g {kinetic:.2f} mm: it may well swing",
        ),
        Row(
            "theta_d at 150 mm and 56.8 deg",
            "Fig. 15",
            "deg",
            "2.6",
            math.nan,
            "measurement",
            "measured; goes into Eq. (24)",
        ),
        Row(
            "theta_M at 150 mm, smallest",
            "text to Fig. 19",
            "deg",
            "1.2",
            math.nan,
            "measurement",
            "measured; goes into Eq. (24)",
        ),
        Row(
            "theta_M at 150 mm, largest",
            "text to Fig. 19",
            "deg",
            "2.6",
            math.nan,
            "measurement",
            "measured; goes into Eq. (24)",
        ),
    )


def statements() -> tuple[str, ...]:
    """Statements of the text that a number of ours confirms or contradicts."""
    at = _table_1()
    counts = ", ".join(f"{int(contact_count(L=at['L'], p=p))}" for p in TESTED)
    spacings = ", ".join(f"{1e3 * p:.0f}" for p in TESTED)
    literal = [
        theta_s_sup_arccos(n=contact_count(L=at["L"], p=p), p=p, **at) - theta_s_sup(p=p, **at)
        for p in TESTED
    ]
    worst = float(np.abs(np.degrees(literal)).max())
    return (
        f'"n is an integer greater than 2" cannot be meant: n = {counts} at {spacings} mm.',
        "Eqs. (19)-(23) as printed (arccos) and in closed form differ by "
        f"{worst:.0e} deg at most at these spacings.",
    )


def _energy_margin_mm(p: float, theta_s: float) -> float:
    at = _table_1()
    n = int(contact_count(L=at["L"], p=p))
    place = {"d": d_C(L=at["L"], n=n, p=p), "k": n - 1, "p": p, "C_L": at["C_L"], "C_N": at["C_N"]}
    margin = energy_margin_backward(
        alpha=alpha(**place), theta_alpha=theta_alpha(**place), theta_s=theta_s
    )
    return 1e3 * float(margin)


def columns(rows: tuple[Row, ...]) -> dict[str, list[Any]]:
    """Columns of a table of rows."""
    names = (*Row._fields[:5], "difference", *Row._fields[5:])
    return {name: [getattr(row, name) for row in rows] for name in names}


def as_dict() -> dict[str, Any]:
    """Table, statements and captions, for JSON."""
    return {
        "paper": PAPER,
        "table": [
            {**row._asdict(), "printed": row.printed or None, "difference": row.difference}
            for row in comparison()
        ],
        "statements": statements(),
        "missing": NOT_PRINTED,
        "captions": captions(),
    }


def _case(p: float, theta_s: float, **options: Any) -> Case:
    stairs = Stairs.inclined(angle=theta_s, nosing_spacing=p)
    return case_of(kenaf(), stairs, theta_d=0.0, theta_M=0.0, **options)


def fig_7() -> Plane:
    """Plane of Fig. 7 for Kenaf at the printed condition (200 mm, 44.0 deg)."""
    p, theta_s = MEASURED.swung_at
    return d_a_plane(_case(p / 1e3, math.radians(theta_s), friction=FRICTION_SHOWN))


def fig_10(p: float = 0.150) -> StateC:
    """Triangle of Fig. 10 for Kenaf."""
    at = _table_1()
    n = int(contact_count(L=at["L"], p=p))
    d = float(d_C(L=at["L"], n=n, p=p))
    com = {"C_L": at["C_L"], "C_N": at["C_N"]}
    return StateC(
        L=at["L"],
        **com,
        p=p,
        n=n,
        d_C=d,
        alpha_C=float(alpha(d=d, k=n - 1, p=p, **com)),
        beta_C=float(beta(d=d, **com)),
        theta_alpha_C=float(theta_alpha(d=d, k=n - 1, p=p, **com)),
        theta_s=float(theta_s_sup(p=p, **at)),
        outline=kenaf().track.rear_radius,
    )


def fig_11(points: int = 400) -> MarginCurve:
    """Curve of Figs. 11, 13 and 21."""
    half = _table_1()["L"] / 2
    p: Array = np.union1d(np.linspace(0.10, 0.25, points), [half])
    return margin_curve(_case(0.150, math.radians(50.0)), p)


def captions() -> dict[str, str]:
    """What each figure shows, and what it does not."""
    low, high = corrected()
    return {
        "fig07": (
            "After Fig. 7: the d-a plane with its five areas and the limits of Eqs. (14)-(18). The "
            "paper's figure is a schematic diagram without numbers; this one is computed for Kenaf "
            f"(Table 1) at p = 200 mm and 44.0 deg, with a static friction of {FRICTION_SHOWN:g} "
            "chosen by us, because the paper prints none. The area of downhill slip is ours. Area "
            "names are the paper's."
        ),
        "fig10": (
            "After Fig. 10: the symbols of Eqs. (19)-(23) in state C, drawn to scale for Kenaf "
            "(Table 1) at p = 150 mm on the steepest slope that holds it, where its centroid is "
            "plumb above the lowest contact left. The steps and the robot's outline are not of the "
            "paper."
        ),
        "fig11": (
            "After Fig. 11: the predicted margin theta_s_sup over the nosing spacing for Kenaf "
            "(Table 1), Eqs. (19)-(23), a = 0. Of this line the text prints one number, 60.2 deg "
            "at 150 mm. The lower limit theta_s_inf and the end of the model at p = L/2 are ours."
        ),
        "fig13_21": (
            "After Figs. 13 and 21: the predicted margin of Fig. 11 with every experimental number "
            "that the text prints and no other: at 150 mm Kenaf fell at 55.0-57.0 deg; at 200 mm "
            "and 44.0 deg it did not fall, but swung; theta_d = 2.6 deg, measured at 150 mm and "
            "56.8 deg; theta_M = 1.2-2.6 deg at 150 mm. Eq. (24) with these gives "
            f"{low:.1f}-{high:.1f} deg at 150 mm (computed). {NOT_PRINTED}"
        ),
    }

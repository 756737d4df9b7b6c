"""The paper again: what its text prints, what the formulas give, and the difference.

Only numbers that stand in the text of the article are in here. The points of its Figs. 13, 16, 19
and 21 other than these are in the pictures alone; they are missing, not guessed.
"""

import math
from collections.abc import Iterator, Sequence
from typing import Any, Literal

import numpy as np

from kaidan.answer import Answer, Part
from kaidan.arguments import known_arguments
from kaidan.lab.reproduction import sentences as said
from kaidan.lab.reproduction.phase import GrouserPhase, grouser_phase
from kaidan.lab.reproduction.printed import MEASURED, Measured
from kaidan.mechanics.margin import theta_s_sup, theta_s_sup_arccos, theta_s_sup_corrected
from kaidan.mechanics.measures import energy_margin_backward, kinetic_energy_height
from kaidan.mechanics.plane import contact_count
from kaidan.mechanics.triangle import alpha, beta, d_C, theta_alpha
from kaidan.question import Question
from kaidan.robot import Robot
from kaidan.terrain.stairs import Stairs
from kaidan.verbs.d_a_plane import Plane, d_a_plane
from kaidan.verbs.margin_curve import Array, MarginCurve, margin_curve

TESTED = (0.150, 0.180, 0.200, 0.220)
"""Nosing spacings of the paper's tests [m]."""

FRICTION_SHOWN = 2.0
"""Static friction with which Fig. 7 is drawn: ours, the paper prints none [1]."""


class Row(Part):
    """One number of the text beside ours."""

    quantity: str
    """What it is."""
    place: str
    """Where in the paper."""
    unit: Literal["mm", "deg"]
    printed: str | None
    """As the text prints it; null where it prints nothing."""
    computed: float | None
    """Null where it was measured and cannot be computed."""
    difference: float | None
    """Computed minus printed; null where either is missing."""
    role: Literal["input", "prediction", "measurement", "not printed"]
    """What it is in the paper."""
    note: str


class StateC(Part):
    """The triangle of Fig. 10 at the steepest slope: lengths in m, angles in rad."""

    L: float
    """Length of the flat [m]."""
    C_L: float
    """Centroid behind the front tip [m]."""
    C_N: float
    """Centroid above the underside [m]."""
    p: float
    """Nosing spacing [m]."""
    n: int
    """n = floor(L / p)."""
    d_C: float
    """Progress of state C, Eq. (23) [m]."""
    alpha_C: float
    """From the lowest contact to the centroid, Eq. (21) [m]."""
    beta_C: float
    """From the highest contact to the centroid, Eq. (22) [m]."""
    theta_alpha_C: float
    """Eq. (20) [rad]."""
    theta_s: float
    """theta_s_sup, where the centroid is plumb above the lowest contact, Eq. (19) [rad]."""
    outline: float
    """End radius of the outline drawn [m]; not of the paper."""


class Equation24(Part):
    """Corrected margin at the spacing where Kenaf fell, step by step [deg]."""

    p_mm: float
    """Nosing spacing [mm]."""
    sup_deg: float
    """theta_s_sup [deg]."""
    less_theta_d_deg: float
    """theta_s_sup less theta_d [deg]."""
    corrected_deg: tuple[float, float]
    """The same less theta_M, its largest and its smallest value [deg]."""


class Reproduction(Answer):
    """The paper's numbers beside ours."""

    text_module = "kaidan.lab.reproduction.text"

    paper: str
    """The paper, as it is cited."""
    table: tuple[Row, ...]
    """Every result that the text prints as a number, beside ours."""
    statements: tuple[str, ...]
    """Statements of the text that a number of ours confirms or contradicts."""
    missing: str
    """What the text does not print."""
    captions: dict[str, str]
    """What each figure shows, and what it does not."""
    measured: Measured
    """Results of the experiments that the text prints."""
    equation_24: Equation24
    """The corrected margin."""
    state_c: StateC
    """The triangle of Fig. 10."""
    phase: GrouserPhase
    """What the phase of grousers says of the falls, of theta_d and of theta_M."""


@known_arguments
def reproduce() -> Reproduction:
    """Reproduce the paper: what its text prints, what kaidan computes, and the difference.

    Examples
    --------
    >>> row = reproduce().table[3]
    >>> row.quantity, row.printed, round(row.computed, 3)
    ('predicted margin theta_s_sup at 150 mm', '60.2', 60.205)

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """
    corrected = equation_24()
    return Reproduction(
        paper=said.PAPER,
        table=(*table_1(), *_predictions(), *_measurements(corrected)),
        statements=_statements(),
        missing=said.NOT_PRINTED,
        captions=said.captions(FRICTION_SHOWN, corrected.corrected_deg),
        measured=MEASURED,
        equation_24=corrected,
        state_c=state_c(),
        phase=grouser_phase(**_table_1()),
    )


def kenaf() -> Robot:
    """The robot of Table 1."""
    return Robot.named("kenaf")


def _table_1() -> dict[str, float]:
    robot = kenaf()
    return {"L": robot.track.flat_length, "C_L": robot.com_from_front, "C_N": robot.com_height}


def equation_24() -> Equation24:
    """Corrected margin of Eq. (24) from the printed theta_d and theta_M."""
    p = MEASURED.fell_p_mm
    sup = math.degrees(theta_s_sup(p=p / 1e3, **_table_1()))
    least, most = MEASURED.theta_M_deg
    low, high = (
        float(theta_s_sup_corrected(theta_s_sup=sup, theta_d=MEASURED.theta_d_deg, theta_M=theta_M))
        for theta_M in (most, least)
    )
    return Equation24(
        p_mm=p,
        sup_deg=sup,
        less_theta_d_deg=sup - MEASURED.theta_d_deg,
        corrected_deg=(low, high),
    )


def _row(
    quantity: str, place: str, unit: Literal["mm", "deg"], printed: str | None,
    computed: float | None, role: Any, note: str = "",
) -> Row:  # fmt: skip
    both = printed is not None and computed is not None
    return Row(
        quantity=quantity,
        place=place,
        unit=unit,
        printed=printed,
        computed=computed,
        difference=computed - float(printed) if both else None,  # type: ignore[operator,arg-type]
        role=role,
        note=note,
    )


def table_1() -> tuple[Row, ...]:
    """Table 1 of the paper beside the catalogue's sheet."""
    names = (
        ("centroid from the front, C_L", "C_L", "196"),
        ("centroid height, C_N", "C_N", "71"),
        ("length of the flat area, L", "L", "470"),
    )
    held = _table_1()
    return tuple(
        _row(text, "Table 1", "mm", printed, 1e3 * held[key], "input", "as the catalogue holds it")
        for text, key, printed in names
    )


def _predictions() -> Iterator[Row]:
    """The predicted margin at every spacing of the tests; the text prints one."""
    for p in TESTED:
        name = f"predicted margin theta_s_sup at {1e3 * p:.0f} mm"
        sup = math.degrees(theta_s_sup(p=p, **_table_1()))
        if p == MEASURED.fell_p_mm / 1e3:
            yield _row(name, "Discussion; Eqs. (19)-(23)", "deg", "60.2", sup, "prediction")
        else:
            note = "the text prints no number"
            yield _row(name, "Fig. 11, a picture", "deg", None, sup, "not printed", note)


def _measurements(equation: Equation24) -> Iterator[Row]:
    """What was measured, beside the formula where there is one."""
    low, high = equation.corrected_deg
    for text, printed, computed, theta_M in (
        ("lowest", "55.0", low, MEASURED.theta_M_deg[1]),
        ("highest", "57.0", high, MEASURED.theta_M_deg[0]),
    ):
        note = f"computed: Eq. (24) with theta_d {MEASURED.theta_d_deg} and theta_M {theta_M} deg"
        name = f"slopes at which it fell at 150 mm, {text}"
        yield _row(name, "Discussion, Fig. 13", "deg", printed, computed, "measurement", note)
    p, theta_s = MEASURED.rotated_at[0] / 1e3, math.radians(MEASURED.rotated_at[1])
    energy = _energy_margin_mm(p, theta_s)
    kinetic = 1e3 * float(kinetic_energy_height(v=MEASURED.speed_mm_s / 1e3))
    yield _row(
        "slope at 200 mm: no fall, but the body rotates",
        "Discussion, Fig. 14",
        "deg",
        "44.0",
        math.degrees(theta_s_sup(p=p, **_table_1())),
        "measurement",
        f"computed: theta_s_sup, above it as Eq. (7) demands; energy margin {energy:.2f} mm, "
        f"kinetic-energy height v^2/2g {kinetic:.2f} mm: the robot may rock",
    )
    for name, place, printed in (
        ("theta_d at 150 mm and 56.8 deg", "Fig. 15", "2.6"),
        ("theta_M at 150 mm, smallest", "text to Fig. 19", "1.2"),
        ("theta_M at 150 mm, largest", "text to Fig. 19", "2.6"),
    ):
        note = "measured; goes into Eq. (24)"
        yield _row(name, place, "deg", printed, None, "measurement", note)


def _statements() -> tuple[str, ...]:
    at = _table_1()
    literal = [
        theta_s_sup_arccos(n=contact_count(L=at["L"], p=p), p=p, **at) - theta_s_sup(p=p, **at)
        for p in TESTED
    ]
    return said.statements(
        ", ".join(f"{int(contact_count(L=at['L'], p=p))}" for p in TESTED),
        ", ".join(f"{1e3 * p:.0f}" for p in TESTED),
        float(np.abs(np.degrees(literal)).max()),
    )


def _energy_margin_mm(p: float, theta_s: float) -> float:
    at = _table_1()
    n = int(contact_count(L=at["L"], p=p))
    place = {"d": d_C(L=at["L"], n=n, p=p), "k": n - 1, "p": p, "C_L": at["C_L"], "C_N": at["C_N"]}
    margin = energy_margin_backward(
        alpha=alpha(**place), theta_alpha=theta_alpha(**place), theta_s=theta_s
    )
    return 1e3 * float(margin)


def columns(rows: Sequence[Row]) -> dict[str, list[Any]]:
    """Columns of a table of rows."""
    return {name: [getattr(row, name) for row in rows] for name in Row.model_fields}


def _case(p: float, theta_s: float, **options: Any) -> Question:
    stairs = Stairs.inclined(angle=theta_s, nosing_spacing=p)
    return Question.in_one_posture(kenaf(), stairs, theta_d=0.0, theta_M=0.0, **options)


def fig_7() -> Plane:
    """Plane of Fig. 7 for Kenaf at the printed condition (200 mm, 44.0 deg)."""
    p, theta_s = MEASURED.rotated_at
    return d_a_plane(_case(p / 1e3, math.radians(theta_s), friction=FRICTION_SHOWN))


def state_c(p: float = 0.150) -> StateC:
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

"""What the paper states in words, and the captions of its figures."""

PAPER = "Endo & Nagatani 2016, ROBOMECH Journal 3:20, doi:10.1186/s40648-016-0058-y"


NOT_PRINTED = (
    "The other points of the paper's Figs. 13, 16, 19 and 21 stand in its pictures only and are "
    "not shown."
)


def statements(n: str, spacings: str, worst_deg: float) -> tuple[str, ...]:
    """Statements of the text that a number of ours confirms or contradicts.

    n, spacings: numbers of contacts at the nosing spacings [mm].
    worst_deg: largest difference of Eqs. (19)-(23) as printed and in closed form [deg].
    """
    return (
        f'"n is an integer greater than 2" cannot be meant: n = {n} at {spacings} mm.',
        "Eqs. (19)-(23) as printed (arccos) and in closed form differ by "
        f"{worst_deg:.0e} deg at most at these spacings.",
    )


def captions(friction: float, corrected: tuple[float, float]) -> dict[str, str]:
    """What each figure shows, and what it does not.

    friction: static friction with which Fig. 7 is drawn [1].
    corrected: corrected margin of Eq. (24) [deg].
    """
    low, high = corrected
    return {
        "fig07": (
            "After Fig. 7: the d-a plane with its five areas and the limits of Eqs. (14)-(18). The "
            "paper's figure is a schematic diagram without numbers; this one is computed for Kenaf "
            f"(Table 1) at p = 200 mm and 44.0 deg, with a static friction of {friction:g} "
            "chosen by us, because the paper prints none. The area of sliding uphill is ours. Area "
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
            "and 44.0 deg it did not fall, but the body rotated; theta_d = 2.6 deg, measured at "
            "150 mm and 56.8 deg; theta_M = 1.2-2.6 deg at 150 mm. Eq. (24) with these gives "
            f"{low:.1f}-{high:.1f} deg at 150 mm (computed). {NOT_PRINTED}"
        ),
    }


RIGID = "rigid smooth belt, sharp ends: Eqs. (19)-(23)"
PRESSED_IN = "smooth belt that is pressed in and gives theta_d"
ROUND_END = "smooth belt, round ends of 65 mm"
GROUSERS = "grousers that give theta_d, sharp ends, at rest"
GROUSERS_DRIVEN = "the same at 100 mm/s"
WOUND = "the same, ends of 65 mm wound over bars, at the best spacing of grousers"


def grousers_and_round_end(radius_mm: float) -> str:
    """Name of an explanation."""
    return f"the same at rest, ends of {radius_mm:.0f} mm"


def phase_notes(
    h: float, beyond: tuple[float, float], driven: tuple[float, float]
) -> tuple[str, ...]:
    """What the table of grouser phase takes, and where the lowest nosing is lost [mm]."""
    return (
        f"Grouser phase: theta_d = 2.6 deg at 150 mm is a height of {h:.1f} mm. "
        "Nothing else is taken.",
        "Up and down: the worst phase at rest. Driven: up at 100 mm/s, for a radius of gyration "
        "of 100 to 180 mm.",
        f"Whatever the track is, it loses the lowest nosing {_span(beyond)} mm beyond the end of "
        f"its flat at rest, or {_span(driven)} mm at 100 mm/s.",
    )


def _span(ends: tuple[float, float]) -> str:
    return f"{ends[0]:.1f} to {ends[1]:.1f}"

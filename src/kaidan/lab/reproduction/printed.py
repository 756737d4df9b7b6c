"""What the paper's text prints of Kenaf's experiments; nothing is taken from its pictures."""

from kaidan.answer import Part


class Measured(Part):
    """Numbers of the text.

    References
    ----------
    Endo & Nagatani 2016, doi:10.1186/s40648-016-0058-y.
    """

    fell_p_mm: float
    """Nosing spacing at which it fell [mm]."""
    fell_deg: tuple[float, float]
    """It fell between these slopes, five trials each (Discussion, Fig. 13) [deg]."""
    theta_d_deg: float
    """Extra inclination from the deformed track (Fig. 15) [deg]."""
    theta_d_at: tuple[float, float]
    """Nosing spacing and slope at which [mm, deg]."""
    theta_M_deg: tuple[float, float]
    """Descending less ascending margin (text to Fig. 19) [deg]."""
    theta_M_p_mm: float
    """Nosing spacing at which [mm]."""
    rotated_at: tuple[float, float]
    """Nosing spacing and slope of a rotation without a fall (Fig. 14) [mm, deg]."""
    speed_mm_s: float
    """Of all tests [mm/s]."""


MEASURED = Measured(
    fell_p_mm=150.0,
    fell_deg=(55.0, 57.0),
    theta_d_deg=2.6,
    theta_d_at=(150.0, 56.8),
    theta_M_deg=(1.2, 2.6),
    theta_M_p_mm=150.0,
    rotated_at=(200.0, 44.0),
    speed_mm_s=100.0,
)

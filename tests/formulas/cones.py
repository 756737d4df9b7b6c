r"""Two contacts with a friction cone each: how much narrower the cones may be.

::

        \  |  /          cone: forces within phi of the normal, which is tilted by alpha
         \ | / phi       from the vertical; a riser's face, a tread and a nosing have
          \|/            normals, and may have frictions, of their own
    ------- o -------
"""

import numpy as np

from kaidan.mechanics import Number


def cone_margin(
    *,
    x_1: Number, z_1: Number, alpha_1: Number, phi_1: Number,
    x_2: Number, z_2: Number, alpha_2: Number, phi_2: Number,
    W_x: Number, W_z: Number,
) -> Number:  # fmt: skip
    """Angle by which the friction cones of two contacts may shrink while they hold the robot.

    ``max e: F_1 + F_2 = W, x_1 x F_1 + x_2 x F_2 = 0, F_i in cone(alpha_i, phi_i - e)``

    Two forces leave one number free, the inner force along the line of the contacts. In it each
    edge of a cone is a linear bound, so that whether an angle e holds is a matter of an interval;
    e itself is halved down to 1e-5 rad. With equal cones phi the least friction of the contacts is
    tan(phi - e), and on one plane e = phi - theta.

    Assumptions: Coulomb friction; cones narrower than pi/2 to either side, by 1e-3 rad.

    Parameters
    ----------
    x_1, z_1, x_2, z_2 : float or array
        Contacts from the centroid [m], x uphill, z up.
    alpha_1, alpha_2 : float or array
        Tilt of the normals (sin(alpha), cos(alpha)) from the vertical, towards x [rad].
    phi_1, phi_2 : float or array
        Angles of friction [rad].
    W_x, W_z : float or array
        Sum of the contact forces, that is minus effective gravity [N/kg].

    Returns
    -------
    float or array
        e [rad], negative where friction is missing; at most the smaller of the two angles. Minus
        infinity where no friction is enough.

    Examples
    --------
    Two contacts on a slope of 30 degrees, friction 1:

    >>> c, s = np.cos(np.pi / 6), np.sin(np.pi / 6)
    >>> found = cone_margin(
    ...     x_1=-c - 0.1 * s, z_1=-s - 0.1 * c, alpha_1=-np.pi / 6, phi_1=np.pi / 4,
    ...     x_2=c - 0.1 * s, z_2=s - 0.1 * c, alpha_2=-np.pi / 6, phi_2=np.pi / 4,
    ...     W_x=0.0, W_z=9.8)
    >>> print(round(float(np.degrees(found)), 2))
    15.0

    References
    ----------
    Derived from rigid-body statics: docs/theory/grousers.md.
    """
    d_x, d_z = x_2 - x_1, z_2 - z_1
    d = np.hypot(d_x, d_z)
    d = np.where(d > 0.0, d, np.nan)
    e_x, e_z = d_x / d, d_z / d
    # moments about the one contact give the other's force across the line between them
    across_2 = -(x_1 * W_z - z_1 * W_x) / d
    across_1 = -W_x * e_z + W_z * e_x - across_2
    along = W_x * e_x + W_z * e_z
    # F_1 = across_1 n + l e, F_2 = across_2 n + (along - l) e, with n = (-e_z, e_x)
    first = (-across_1 * e_z, across_1 * e_x, e_x, e_z)
    second = (along * e_x - across_2 * e_z, along * e_z + across_2 * e_x, -e_x, -e_z)
    edges = [
        _edge(forces, alpha, phi, side, 1e-7 * np.hypot(W_x, W_z))
        for forces, alpha, phi in ((first, alpha_1, phi_1), (second, alpha_2, phi_2))
        for side in (1.0, -1.0)
    ]
    # a row an edge
    bounds = [np.stack(np.broadcast_arrays(*each, d)[:4]) for each in zip(*edges, strict=True)]
    high = np.minimum(phi_1, phi_2) + 0.0 * d
    low = np.maximum(phi_1, phi_2) - 0.5 * np.pi + 1e-3 + 0.0 * d
    never = ~_holds(bounds, np.tan(low))
    for _ in range(18):
        middle = 0.5 * (low + high)
        holds = _holds(bounds, np.tan(middle))
        low, high = np.where(holds, middle, low), np.where(holds, high, middle)
    return np.where(never, -np.inf, low)


def _edge(
    forces: tuple[Number, ...], alpha: Number, phi: Number, side: float, size: Number
) -> tuple[Number, ...]:
    """Edge of a cone as a bound on the inner force: a - b tan(e) + (c - d tan(e)) l >= 0.

    The cross product of the edge's direction and the force, over cos(e); forces below `size` are
    none.
    """
    f_x, f_z, g_x, g_z = forces
    u_x, u_z = np.sin(alpha + side * phi), np.cos(alpha + side * phi)
    return (
        side * (u_x * f_z - u_z * f_x) + size,
        u_z * f_z + u_x * f_x,
        side * (u_x * g_z - u_z * g_x),
        u_z * g_z + u_x * g_x,
    )


def _holds(bounds: list[Number], t: Number) -> Number:
    """Whether some inner force keeps both forces within cones narrower by arctan(t)."""
    a, b, c, d = bounds
    constant, slope = a - b * t, c - d * t
    flat = np.abs(slope) < 1e-12
    bound = -constant / np.where(flat, 1.0, slope)
    least = np.where(~flat & (slope > 0.0), bound, -np.inf).max(axis=0)
    most = np.where(~flat & (slope < 0.0), bound, np.inf).min(axis=0)
    return (~flat | (constant >= 0.0)).all(axis=0) & (least <= most)

"""The kernel against brute force: small drives, small turns, no events, no Newton.

One step of it: push the robot a millimetre along its own inclination, let it down until it touches,
turn it by a few hundredths of a degree about whatever touches, nose up if that lies ahead of the
centroid and down if behind, until that changes. No face is higher than an end's radius here, since
letting down from above jumps over walls.
"""

import numba
import numpy as np
import pytest

from amounts import fast_and_slow
from contact_cases import stadium, steps
from kaidan.contact import Status, traverse

DRIVE = 1e-3  # m
TURN = np.radians(0.03)
#: Within this distance of a contact [m] the steps shrink in proportion, at most so many times.
NEAR = 0.02
FINEST = 16
#: Refinements tried, one after the other, until two agree within half the tolerance of 0.1 deg.
LEVELS = (1, 4, 16, 64)


@numba.njit(cache=True, error_model="numpy")
def touch(t, u, length, parts, x, phi):
    """Height of the centroid when let down at (x, phi), and the point that touches."""
    c, s = np.cos(phi), np.sin(phi)
    best, at_x, at_z = -1e9, 0.0, 0.0
    first = max(np.searchsorted(t[:, 0], x - 1.8) - 1, 0)
    last = min(np.searchsorted(t[:, 0], x + 1.8, side="right") + 1, len(t) - 1)
    for row in range(len(parts)):
        x1, z1, r1, x2, z2, r2 = parts[row]
        c1_x, c1_z = c * x1 - s * z1, s * x1 + c * z1
        c2_x, c2_z = c * x2 - s * z2, s * x2 + c * z2
        span = np.hypot(c2_x - c1_x, c2_z - c1_z)
        e_x, e_z = (c2_x - c1_x) / span, (c2_z - c1_z) / span
        sine = (r1 - r2) / span
        cosine = np.sqrt(1 - sine**2) * np.sign(e_x)
        n_x, n_z = sine * e_x + cosine * e_z, sine * e_z - cosine * e_x
        a_x, a_z = c1_x + r1 * n_x, c1_z + r1 * n_z
        b_x, b_z = c2_x + r2 * n_x, c2_z + r2 * n_z
        for k in range(first, last + 1):
            d = t[k, 0] - x
            if min(a_x, b_x) <= d <= max(a_x, b_x):
                z = t[k, 1] - (a_z + (b_z - a_z) * (d - a_x) / (b_x - a_x))
                if z > best:
                    best, at_x, at_z = z, t[k, 0], t[k, 1]
            for disc in range(2):
                o_x, o_z, r = (c1_x, c1_z, r1) if disc == 0 else (c2_x, c2_z, r2)
                if abs(d - o_x) <= r:
                    z = t[k, 1] - o_z + np.sqrt(r**2 - (d - o_x) ** 2)
                    if z > best:
                        best, at_x, at_z = z, t[k, 0], t[k, 1]
                if k < len(u) and u[k, 0] > 1e-9:
                    foot = (o_x + r * u[k, 1] - d) / u[k, 0]
                    if 0 <= foot <= length[k]:
                        p_x, p_z = t[k, 0] + foot * u[k, 0], t[k, 1] + foot * u[k, 1]
                        z = p_z + r * u[k, 0] - o_z
                        if z > best:
                            best, at_x, at_z = z, p_x, p_z
    return best, at_x, at_z


@numba.njit(cache=True, error_model="numpy")
def brute(t, u, length, parts, x, x_end, finer):
    """Verdict (0 arrived, 1 back, -1 front, 9 stuck) and the largest inclination [rad]."""
    phi, most, factor = 0.0, -9.0, finer
    for _ in range(40_000_000):
        turn = TURN / factor
        x += DRIVE / factor * np.cos(phi)
        z, p_x, p_z = touch(t, u, length, parts, x, phi)
        sense = np.sign(p_x - x)
        other = p_x - x
        for _ in range(40_000_000):
            new_phi = phi + sense * turn
            new_x = x - (z - p_z) * sense * turn
            new_z, q_x, q_z = touch(t, u, length, parts, new_x, new_phi)
            other = q_x - new_x
            if np.sign(other) != sense:
                break
            x, z, phi, p_x, p_z = new_x, new_z, new_phi, q_x, q_z
            most = max(most, phi)
            if abs(phi) > np.pi / 2:
                return np.sign(phi), most
        most = max(most, phi)
        if abs(phi) > np.pi / 2 - 2 * turn:
            return np.sign(phi), most
        if x >= x_end:
            return 0.0, most
        # smaller steps where the centroid is nearly over a contact: there it may be let go
        near = min(abs(p_x - x), abs(other))
        factor = finer * min(max(NEAR / max(near, 1e-9), 1.0), FINEST)
    return 9.0, most


class Brute:
    def __init__(self, terrain, parts, finer=1):
        self.finer = float(finer)
        self.t = np.vstack([terrain[0] - [20.0, 0.0], terrain, terrain[-1] + [20.0, 0.0]])
        d = np.diff(self.t, axis=0)
        self.length = np.hypot(d[:, 0], d[:, 1])
        self.u = d / self.length[:, None]
        self.parts = parts

    def run(self, x, x_end):
        code, most = brute(self.t, self.u, self.length, self.parts, x, x_end, self.finer)
        return {0.0: "ok", 1.0: "back", -1.0: "front", 9.0: "stuck"}[code], most


VERDICT = {
    Status.OK: "ok",
    Status.FELL_BACKWARD: "back",
    Status.FELL_FORWARD: "front",
    Status.STUCK: "stuck",
}


def compare(terrain, parts, x_start, x_end):
    """Both answers, and how often brute force had to be refined.

    Near a graze brute force lags: a step e too early on a flat maximum costs an angle between
    order e and order sqrt(e). It is refined until two levels agree within 0.05 deg; if three fall
    in a steady ratio, the limit of that series is taken. Anything else is no confirmation (NaN).
    """
    run = traverse(terrain, parts, x_start, x_end, with_margins=False)
    mine, top = VERDICT.get(run.status, run.status.name), np.degrees(run.largest_inclination())
    seen = []
    for level in LEVELS:
        verdict, most = Brute(terrain, parts, level).run(x_start, x_end)
        if verdict != mine or verdict != "ok":
            if verdict == mine:
                return mine, top, verdict, top, level
            seen = []
            continue
        seen.append(np.degrees(most))
        if len(seen) >= 2 and abs(seen[-1] - seen[-2]) < 0.05:
            return mine, top, verdict, seen[-1], level
        if len(seen) >= 3:
            ratio = (seen[-2] - seen[-3]) / (seen[-1] - seen[-2])
            if 1.5 < ratio < 8:  # between sqrt(4) and 4, with room
                limit = seen[-1] + (seen[-1] - seen[-2]) / (ratio - 1)
                if abs(limit - seen[-1]) < 0.1:
                    return mine, top, verdict, limit, level
    return mine, top, verdict, np.nan, LEVELS[-1]


@pytest.mark.parametrize("count", fast_and_slow(30, 200))
def test_random_robots_and_flights(count):
    rng = np.random.default_rng(21)
    verdicts = {"ok": 0, "back": 0, "front": 0}
    for case in range(count):
        L = rng.uniform(0.35, 0.9)
        C_L = L * rng.uniform(0.3, 0.7)
        C_N = L * rng.uniform(0.1, 0.45)
        R = rng.uniform(0.08, 0.2)
        rise = R * rng.uniform(0.4, 0.95)
        going = rng.uniform(0.6, 1.6) * rise + 0.02
        terrain = steps(rise, going, 5, 2.5, 2.5)
        mine, top, brute, limit, _ = compare(
            terrain, stadium(L, C_L, C_N, R), -1.4, 4 * going + 1.0
        )
        assert mine == brute, (case, L, C_L, C_N, R, rise, going)
        verdicts[mine] += 1
        if mine == "ok":
            assert abs(top - limit) < 0.1, (case, top, limit)  # deg, the brief's
    assert min(verdicts["ok"], verdicts["back"]) > 0.075 * count


@pytest.mark.parametrize("count", fast_and_slow(15, 50))
def test_rough_profiles(count):
    rng = np.random.default_rng(22)
    for case in range(count):
        L = rng.uniform(0.35, 0.9)
        parts = stadium(
            L, L * rng.uniform(0.3, 0.7), L * rng.uniform(0.1, 0.4), *rng.uniform(0.06, 0.15, 2)
        )
        x = np.cumsum(rng.uniform(0.02, 0.15, 30))
        slope = np.clip(rng.normal(0.15, 0.4, 29), -0.8, 0.9)
        z = np.concatenate([[0], np.cumsum(slope * np.diff(x))])
        terrain = np.vstack([[x[0] - 2.5, 0], np.stack([x, z], 1), [x[-1] + 2.5, z[-1]]])
        mine, top, brute, limit, _ = compare(terrain, parts, x[0] - 1.4, x[-1] + 1.2)
        assert mine == brute, case
        if mine == "ok":
            assert abs(top - limit) < 0.1, (case, top, limit)

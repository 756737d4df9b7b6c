"""The kernel against brute force: small drives, small turns, plain numpy, no events, no Newton.

One step of it: push the robot a millimetre along its own inclination, let it down until it touches,
turn it by a few hundredths of a degree about whatever touches, nose up if that lies ahead of the
centroid and down if behind, until that changes. No face is higher than an end's radius here, since
letting down from above jumps over walls.
"""

import numpy as np
import pytest

from contact_cases import stadium, steps
from kaidan.contact import Status, traverse

DRIVE = 1e-3  # m
TURN = np.radians(0.03)


class Brute:
    def __init__(self, terrain, parts, finer=1):
        self.drive, self.turn = DRIVE / finer, TURN / finer
        first = terrain[0] - [20.0, 0.0]
        last = terrain[-1] + [20.0, 0.0]
        self.t = np.vstack([first, terrain, last])
        d = np.diff(self.t, axis=0)
        self.length = np.hypot(d[:, 0], d[:, 1])
        self.u = d / self.length[:, None]
        self.parts = parts

    def touch(self, x, phi):
        """Height of the centroid when let down at (x, phi), and the point that touches."""
        c, s = np.cos(phi), np.sin(phi)
        best, where = -np.inf, None
        near = slice(
            max(np.searchsorted(self.t[:, 0], x - 1.8) - 1, 0),
            np.searchsorted(self.t[:, 0], x + 1.8, side="right") + 1,
        )
        t = self.t[near]
        u, length = self.u[near], self.length[near]
        for x1, z1, r1, x2, z2, r2 in self.parts:
            centres = np.array(
                [[c * x1 - s * z1, s * x1 + c * z1], [c * x2 - s * z2, s * x2 + c * z2]]
            )
            axis = centres[1] - centres[0]
            D = np.hypot(*axis)
            e = axis / D
            sine = (r1 - r2) / D
            down = np.array([e[1], -e[0]]) * np.sign(e[0])
            n = sine * e + np.sqrt(1 - sine**2) * down
            a, b = centres[0] + r1 * n, centres[1] + r2 * n
            dx = t[:, 0] - x
            lo, hi = min(a[0], b[0]), max(a[0], b[0])
            on = (dx >= lo) & (dx <= hi)
            if on.any():
                z = t[on, 1] - (a[1] + (b[1] - a[1]) * (dx[on] - a[0]) / (b[0] - a[0]))
                k = z.argmax()
                if z[k] > best:
                    best, where = z[k], t[on][k]
            for centre, r in ((centres[0], r1), (centres[1], r2)):
                on = np.abs(dx - centre[0]) <= r
                if on.any():
                    z = t[on, 1] - centre[1] + np.sqrt(r**2 - (dx[on] - centre[0]) ** 2)
                    k = z.argmax()
                    if z[k] > best:
                        best, where = z[k], t[on][k]
                m = min(len(u), len(t) - 1)
                uu, start = u[:m], t[:m]
                flat = uu[:, 0] > 1e-9
                uu, start, ll = uu[flat], start[flat], length[:m][flat]
                foot = (x + centre[0] + r * uu[:, 1] - start[:, 0]) / uu[:, 0]
                on = (foot >= 0) & (foot <= ll)
                if on.any():
                    p = start[on] + foot[on, None] * uu[on]
                    z = p[:, 1] + r * uu[on, 0] - centre[1]
                    k = z.argmax()
                    if z[k] > best:
                        best, where = z[k], p[k]
        return best, where

    def run(self, x, x_end):
        phi, most = 0.0, -9.0
        for _ in range(400_000):
            x += self.drive * np.cos(phi)
            z, p = self.touch(x, phi)
            sense = np.sign(p[0] - x)
            for _ in range(40_000):
                new_phi = phi + sense * self.turn
                new_x = x - (z - p[1]) * sense * self.turn
                new_z, new_p = self.touch(new_x, new_phi)
                if np.sign(new_p[0] - new_x) != sense:
                    break
                x, z, phi, p = new_x, new_z, new_phi, new_p
                most = max(most, phi)
                if abs(phi) > np.pi / 2:
                    return ("back" if phi > 0 else "front"), most
            most = max(most, phi)
            if abs(phi) > np.pi / 2 - 2 * self.turn:
                return ("back" if phi > 0 else "front"), most
            if x >= x_end:
                return "ok", most
        return "stuck", most


VERDICT = {
    Status.OK: "ok",
    Status.FELL_BACKWARD: "back",
    Status.FELL_FORWARD: "front",
    Status.STUCK: "stuck",
}


def compare(terrain, parts, x_start, x_end):
    """Both answers; brute force as the range (deg) in which its converged answer must lie.

    Near a graze brute force lags: a step e too early on a flat maximum costs an angle between
    order e and order sqrt(e). Where it is 0.1 deg off it runs eight times finer; if it still moves
    by more than that, the range spans the extrapolations of both orders, and the case confirms the
    kernel only to within that range.
    """
    run = traverse(terrain, parts, x_start, x_end, with_margins=False, compile_kernel=True)
    mine, top = VERDICT.get(run.status, run.status.name), np.degrees(run.largest_inclination())
    verdict, most = Brute(terrain, parts).run(x_start, x_end)
    low = high = np.degrees(most)
    if mine != verdict or (mine == "ok" and abs(top - low) >= 0.1):
        coarse = low
        verdict, most = Brute(terrain, parts, 8).run(x_start, x_end)
        low = high = np.degrees(most)
        if abs(low - coarse) > 0.1:
            ends = [low + (low - coarse) / 7, low + (low - coarse) / (np.sqrt(8) - 1)]
            low, high = min(ends), max(ends)
    return mine, top, verdict, low, high


@pytest.mark.slow
def test_random_robots_and_flights():
    rng = np.random.default_rng(21)
    verdicts = {"ok": 0, "back": 0, "front": 0}
    for case in range(200):
        L = rng.uniform(0.35, 0.9)
        C_L = L * rng.uniform(0.3, 0.7)
        C_N = L * rng.uniform(0.1, 0.45)
        R = rng.uniform(0.08, 0.2)
        rise = R * rng.uniform(0.4, 0.95)
        going = rng.uniform(0.6, 1.6) * rise + 0.02
        terrain = steps(rise, going, 5, 2.5, 2.5)
        mine, top, brute, low, high = compare(
            terrain, stadium(L, C_L, C_N, R), -1.4, 4 * going + 1.0
        )
        assert mine == brute, (case, L, C_L, C_N, R, rise, going)
        verdicts[mine] += 1
        if mine == "ok":
            # 0.1 deg: the brief's; brute force overshoots by up to one turn and lags by one drive
            assert low - 0.1 < top < high + 0.1, (case, top, low, high)
    assert min(verdicts["ok"], verdicts["back"]) > 15


@pytest.mark.slow
def test_rough_profiles():
    rng = np.random.default_rng(22)
    for case in range(50):
        L = rng.uniform(0.35, 0.9)
        parts = stadium(
            L, L * rng.uniform(0.3, 0.7), L * rng.uniform(0.1, 0.4), *rng.uniform(0.06, 0.15, 2)
        )
        x = np.cumsum(rng.uniform(0.02, 0.15, 30))
        slope = np.clip(rng.normal(0.15, 0.4, 29), -0.8, 0.9)
        z = np.concatenate([[0], np.cumsum(slope * np.diff(x))])
        terrain = np.vstack([[x[0] - 2.5, 0], np.stack([x, z], 1), [x[-1] + 2.5, z[-1]]])
        mine, top, brute, low, high = compare(terrain, parts, x[0] - 1.4, x[-1] + 1.2)
        assert mine == brute, case
        if mine == "ok":
            assert low - 0.1 < top < high + 0.1, (case, top, low, high)

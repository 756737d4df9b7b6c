"""The verdict of `kaidan.mechanics` in compiled loops over arrays of pairs."""

from collections.abc import Callable
from functools import cache
from typing import Any

from numpy.typing import NDArray

from kaidan.mechanics.verdict import judged
from kaidan.sweeps import compiled

Array = NDArray[Any]

_BLOCK = 1 << 10
"""Pairs that the compiled loops take at once, so that what both read stays in the cache."""


@cache
def kernel() -> Callable[[list[Array], list[Array]], None]:
    """Two loops, because one that writes all twelve outputs is too much for the vectoriser."""
    njit = compiled.numba().njit(error_model="numpy", nogil=True)
    formula = compiled.compiled(judged)
    return _in_blocks(njit, _angles(njit, formula), _others(njit, formula))


def _angles(njit: Any, formula: Any) -> Any:
    @njit
    def angles(  # type: ignore[no-untyped-def]
        L, C_L, C_N, theta_s, p, mu_s, a, theta_d, theta_M, spare_d, spare_M,
        verdict, governs, margin, theta_s_sup, tip_downhill, tip_uphill, slides_down, slides_up,
    ):  # fmt: skip
        for i in range(L.size):
            answer = formula(
                L[i], C_L[i], C_N[i], theta_s[i], p[i], mu_s[i], a[i], theta_d[i], theta_M[i],
                spare_d[i], spare_M[i],
            )  # fmt: skip
            verdict[i] = answer.verdict
            governs[i] = answer.governs
            margin[i] = answer.margin
            theta_s_sup[i] = answer.theta_s_sup
            tip_downhill[i] = answer.tip_downhill
            tip_uphill[i] = answer.tip_uphill
            slides_down[i] = answer.slides_down
            slides_up[i] = answer.slides_up

    return angles


def _others(njit: Any, formula: Any) -> Any:
    @njit
    def others(  # type: ignore[no-untyped-def]
        L, C_L, C_N, theta_s, p, mu_s, a, theta_d, theta_M, spare_d, spare_M,
        a_max, a_min, centroid, required_friction,
    ):  # fmt: skip
        for i in range(L.size):
            answer = formula(
                L[i], C_L[i], C_N[i], theta_s[i], p[i], mu_s[i], a[i], theta_d[i], theta_M[i],
                spare_d[i], spare_M[i],
            )  # fmt: skip
            a_max[i] = answer.a_max
            a_min[i] = answer.a_min
            centroid[i] = answer.centroid
            required_friction[i] = answer.required_friction

    return others


def _in_blocks(njit: Any, angles: Any, others: Any) -> Callable[[list[Array], list[Array]], None]:
    @njit
    def blocks(inputs, outputs):  # type: ignore[no-untyped-def]
        (L, C_L, C_N, theta_s, p, mu_s, a, theta_d, theta_M, spare_d, spare_M) = inputs
        (
            verdict, governs, margin, theta_s_sup, tip_downhill, tip_uphill, slides_down, slides_up,
            a_max, a_min, centroid, required_friction,
        ) = outputs  # fmt: skip
        for i in range(0, L.size, _BLOCK):
            j = min(i + _BLOCK, L.size)
            angles(
                L[i:j], C_L[i:j], C_N[i:j], theta_s[i:j], p[i:j], mu_s[i:j], a[i:j],
                theta_d[i:j], theta_M[i:j], spare_d[i:j], spare_M[i:j],
                verdict[i:j], governs[i:j], margin[i:j], theta_s_sup[i:j], tip_downhill[i:j],
                tip_uphill[i:j], slides_down[i:j], slides_up[i:j],
            )  # fmt: skip
            others(
                L[i:j], C_L[i:j], C_N[i:j], theta_s[i:j], p[i:j], mu_s[i:j], a[i:j],
                theta_d[i:j], theta_M[i:j], spare_d[i:j], spare_M[i:j],
                a_max[i:j], a_min[i:j], centroid[i:j], required_friction[i:j],
            )  # fmt: skip

    def kernel(inputs: list[Array], outputs: list[Array]) -> None:
        blocks(tuple(inputs), tuple(outputs))

    return kernel

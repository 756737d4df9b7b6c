"""Verdicts with every margin for arrays of robots and stairs, pair by pair, as fast as memory."""

import os
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import NDArray

from kaidan.arguments import flag, known_arguments
from kaidan.errors import InputError, listed, shown
from kaidan.mechanics.verdict import Judged, judged
from kaidan.spelling import word_of
from kaidan.sweeps import compiled, compiled_pairs

Engine = Literal["auto", "numpy", "compiled"]
Array = NDArray[Any]

INPUTS = {
    "flat_length": "L",
    "com_from_uphill": "C_L",
    "com_height": "C_N",
    "angle": "theta_s",
    "nosing_spacing": "p",
    "friction": "mu_s",
    "acceleration": "a",
    "theta_d": "theta_d",
    "theta_M": "theta_M",
    "theta_d_spare": "spare_d",
    "theta_M_spare": "spare_M",
}
"""Inputs by their English names, and the symbols of the formulas."""

CODES = ("verdict", "governs")
"""Outputs that are codes (int8); all others are float64."""

_DEFAULTS = {"friction": np.nan} | dict.fromkeys(
    ("acceleration", "theta_d", "theta_M", "theta_d_spare", "theta_M_spare"), 0.0
)
_CHUNK = {"numpy": 3 << 13, "compiled": 1 << 16}
_HINT = 1 << 24
"""Size of a block that is mapped and freed to make the allocator keep what it gets back [bytes]."""
_WORTH_COMPILING = 1 << 22
"""Pairs from which on compiled loops win back the seconds in which numba compiles them."""

_RANGES = {
    "flat_length": (0.05, 5.0, "m"),
    "com_from_uphill": (-0.6, 5.6, "m"),  # the largest end radius beyond either end of the flat
    "com_height": (0.005, 3.0, "m"),
    "angle": (0.0, 1.5533, "rad"),
    "nosing_spacing": (0.02, 2.5, "m"),
    "friction": (0.0, 5.0, "1"),
    "acceleration": (-9.8, 9.8, "m/s^2"),
    "theta_d": (0.0, 0.6, "rad"),
    "theta_M": (0.0, 0.6, "rad"),
    "theta_d_spare": (0.0, 0.6, "rad"),
    "theta_M_spare": (0.0, 0.6, "rad"),
}


@known_arguments
def verdicts(
    inputs: Mapping[str, Any],
    *,
    out: Judged | None = None,
    engine: Engine = "auto",
    checked: bool = True,
) -> Judged:
    """Verdict and every margin of many pairs of robot and stairs.

    Parameters
    ----------
    inputs : mapping of str to float or array
        `flat_length`, `com_from_uphill` (centroid behind the end that points up the stairs),
        `com_height`, `nosing_spacing` [m], `angle` [rad]; optional `friction` [1] (left out:
        unknown), `acceleration` [m/s^2], `theta_d`, `theta_M`, `theta_d_spare`, `theta_M_spare`
        [rad], see `kaidan.mechanics.verdict.judged`. Arrays broadcast against each other.
    out : Judged, optional
        Arrays of an earlier answer of the same shape to write into, C-contiguous and apart from
        the inputs.
    engine : {"auto", "numpy", "compiled"}
        "compiled" needs ``kaidan[fast]`` and seconds once a process to be made; "auto" takes it
        for four million pairs and more, if it is there.
    checked : bool
        Whether to refuse inputs without physical meaning (one more pass over them).

    Returns
    -------
    Judged
        Arrays of the broadcast shape: codes int8, margins float64 (rad, m, m/s^2).

    Raises
    ------
    InputError
        Missing, unknown or unphysical inputs, shapes that do not broadcast, or an `out` that
        does not fit.
    MissingExtraError
        engine = "compiled" without numba.

    Examples
    --------
    >>> kenaf = dict(flat_length=0.470, com_from_uphill=0.196, com_height=0.071)
    >>> slopes = np.radians([50.0, 59.0, 62.0])
    >>> verdicts({**kenaf, "angle": slopes, "nosing_spacing": 0.15, "friction": 2.0}).verdict
    array([0, 0, 3], dtype=int8)
    """
    arrays, shape = _broadcast(inputs)
    word_of("engine", engine, get_args(Engine))
    if flag("checked", checked):
        _check(arrays)
    if out is None:
        out = Judged(*(np.empty(shape, _type_of(name)) for name in Judged._fields))
    else:
        _fits(out, shape, arrays)
    flat_out = [array.reshape(-1) for array in out]
    size = int(np.prod(shape))
    if engine == "auto":
        engine = "compiled" if size >= _WORTH_COMPILING and compiled.available() else "numpy"
    kernel = compiled_pairs.kernel() if engine == "compiled" else _numpy_kernel
    step = _CHUNK[engine]
    flat_in = [_chunks(array, shape, step) for array in arrays.values()]

    def work(start: int) -> None:
        stop = min(start + step, size)
        kernel([take(start, stop) for take in flat_in], [o[start:stop] for o in flat_out])

    # glibc keeps freed memory up to twice the largest block it has mapped and freed: without this
    # hint it would hand the formulas' intermediate arrays back to the system after every operation
    np.empty(_HINT, np.uint8)
    starts = range(0, size, step)
    if len(starts) <= 2:
        for start in starts:
            work(start)
    else:
        with ThreadPoolExecutor(os.cpu_count()) as pool:
            for _ in pool.map(work, starts, chunksize=1):
                pass
    return out


@known_arguments
def stream(
    chunks: Iterable[Mapping[str, Any]], *, engine: Engine = "auto", checked: bool = True
) -> Iterator[Judged]:
    """Verdicts of chunks of pairs as they come, in memory for one chunk.

    The arrays of an answer are written anew for the next chunk of the same shape: take out what
    is to be kept before asking for the next.

    Parameters
    ----------
    chunks : iterable of mappings
        Inputs of `verdicts`, a chunk at a time.
    engine : {"auto", "numpy", "compiled"}
        See `verdicts`; "auto" takes "compiled" if it is there, for a stream is long.
    checked : bool
        See `verdicts`.

    Yields
    ------
    Judged
        Answer of each chunk.
    """
    word_of("engine", engine, get_args(Engine))
    try:
        chunks = iter(chunks)
    except TypeError:
        raise InputError(f"chunks = {shown(chunks)} is no source of tables") from None
    if engine == "auto" and compiled.available():
        engine = "compiled"
    out: Judged | None = None
    for inputs in chunks:
        _, shape = _broadcast(inputs)
        if out is not None and np.shape(out.verdict) != shape:
            out = None
        out = verdicts(inputs, out=out, engine=engine, checked=checked)
        yield out


def _broadcast(inputs: Mapping[str, Any]) -> tuple[dict[str, Array], tuple[int, ...]]:
    if not isinstance(inputs, Mapping):
        raise InputError(f"inputs = {shown(inputs)} is not a mapping of names to numbers")
    unknown = inputs.keys() - INPUTS.keys()
    if unknown:
        raise InputError(f"unknown input {min(map(shown, unknown))}; known: {listed(INPUTS)}")
    missing = [name for name in INPUTS if name not in inputs and name not in _DEFAULTS]
    if missing:
        raise InputError(f"missing input: {listed(missing)}")
    arrays = {
        name: numbers_of(name, inputs[name] if name in inputs else _DEFAULTS[name])
        for name in INPUTS
    }
    try:
        shape = np.broadcast_shapes(*(array.shape for array in arrays.values()))
    except ValueError:
        shapes = ", ".join(f"{name} {array.shape}" for name, array in arrays.items() if array.ndim)
        raise InputError(f"shapes do not broadcast: {shapes}") from None
    return arrays, shape


def numbers_of(name: str, value: Any) -> Array:
    """Array of float64; refuses what numpy would kindly turn into one: masks, texts, truth."""
    if np.ma.is_masked(value):
        raise InputError(f"{name} holds masked values")
    try:
        array = np.asarray(value)
    except ValueError as error:
        raise InputError(f"{name} is not a number or an array of numbers: {error}") from None
    if array.dtype.kind not in "iuf":
        raise InputError(f"{name} is not a number or an array of numbers, but of {array.dtype}")
    with np.errstate(over="ignore"):
        return array.astype(np.float64, copy=False)


def _check(arrays: Mapping[str, Array]) -> None:
    for name, array in arrays.items():
        low, high, unit = _RANGES[name]
        if array.size == 0:
            continue
        least, most = np.fmin.reduce(array, axis=None), np.fmax.reduce(array, axis=None)
        with np.errstate(invalid="ignore", over="ignore"):
            doubtful = name != "friction" and np.isnan(array.sum())
        if doubtful and np.isnan(array).any():
            raise InputError(f"{name} holds NaN")
        if least < low or most > high:
            bad = least if least < low else most
            raise InputError(f"{name} = {bad:g} {unit} is not within {low:g} to {high:g} {unit}")


def _type_of(name: str) -> type[np.int8] | type[np.float64]:
    return np.int8 if name in CODES else np.float64


def _fits(out: Judged, shape: tuple[int, ...], inputs: Mapping[str, Array]) -> None:
    """Refuse arrays that an answer cannot be written into, or that are still to be read."""
    if not isinstance(out, Judged) or not all(isinstance(array, np.ndarray) for array in out):
        raise InputError("out is not an earlier answer of verdicts")
    for name, array in zip(Judged._fields, out, strict=True):
        if array.shape != shape or not array.flags.c_contiguous or not array.flags.writeable:
            raise InputError(
                f"out.{name} has shape {array.shape}, not {shape}, or is not contiguous or is "
                "read-only"
            )
        if array.dtype != _type_of(name):
            raise InputError(f"out.{name} is of {array.dtype}, not {np.dtype(_type_of(name))}")
        for other, given in inputs.items():
            if np.may_share_memory(array, given):
                raise InputError(f"out.{name} shares its memory with the input {other}")


def _chunks(array: Array, shape: tuple[int, ...], step: int) -> Any:
    """Give contiguous pieces of an input as if it were broadcast and flat."""
    if array.size == 1:
        constant = np.full(step, array.reshape(-1)[0])
        return lambda start, stop: constant[: stop - start]
    if array.shape != shape:
        array = np.ascontiguousarray(np.broadcast_to(array, shape))
    flat = np.ascontiguousarray(array).reshape(-1)
    return lambda start, stop: flat[start:stop]


def _numpy_kernel(inputs: list[Array], outputs: list[Array]) -> None:
    with np.errstate(invalid="ignore"):
        answer = judged(**dict(zip(INPUTS.values(), inputs, strict=True)))
    for target, value in zip(outputs, answer, strict=True):
        target[...] = value

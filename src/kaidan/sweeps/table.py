"""Labelled sweeps: arrays of any parameter in, an xarray Dataset with units out."""

import math
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from kaidan.assessment import case_of
from kaidan.errors import InputError
from kaidan.mechanics.margins import Mode
from kaidan.mechanics.verdict import Judged, Verdict
from kaidan.robot import Payload, Posture, Robot
from kaidan.stairs import Stairs
from kaidan.surface import Surface
from kaidan.sweeps.pairs import Engine, verdicts

if TYPE_CHECKING:
    import xarray

PARAMETERS = {
    "flat_length": "m",
    "com_from_front": "m",
    "com_height": "m",
    "rise": "m",
    "going": "m",
    "angle": "rad",
    "nosing_spacing": "m",
    "friction": "1",
    "acceleration": "m/s^2",
    "theta_d": "rad",
    "theta_M": "rad",
}
"""What can be swept, and its unit."""

_ANGLES = {
    "margin": ("margin_deg", "smallest margin of all failure modes, allowances off"),
    "theta_s_sup": ("margin_angle_deg", "steepest slope for this acceleration, without allowances"),
    "tip_downhill": ("tip_downhill_deg", "margin against tipping over the downhill end"),
    "tip_uphill": ("tip_uphill_deg", "margin against tipping over the uphill end"),
    "slip_up": ("slip_up_deg", "margin against sliding down for lack of friction"),
    "slip_down": ("slip_down_deg", "margin against sliding up when braking"),
}
_OTHERS = {
    "a_max": ("a_max", "m/s^2", 1.0, "upper end of the band of acceleration, without allowances"),
    "a_min": ("a_min", "m/s^2", 1.0, "lower end of the band of acceleration"),
    "centroid": ("margin_centroid_mm", "mm", 1e3, "how far the centroid may move, allowances off"),
    "required_friction": ("required_friction", "1", 1.0, "friction below which it slips"),
}


def sweep(
    robot: Robot | str,
    stairs: Stairs | str | None = None,
    *,
    surface: Surface | str | None = None,
    flippers: Posture | Literal["flat", "stowed"] = "stowed",
    payload: Payload | tuple[Payload, ...] = (),
    direction: Literal["up", "down"] | None = None,
    facing: Literal["nose-first", "tail-first"] = "nose-first",
    engine: Engine = "auto",
    **parameters: Any,
) -> "xarray.Dataset":
    """Verdict and every margin of a robot on stairs over arrays of any parameters.

    Parameters
    ----------
    robot : Robot or str
        Robot whose figures hold where no parameter replaces them.
    stairs : Stairs or str, optional
        Uniform stairs, likewise; needed unless the parameters give their whole shape.
    surface : Surface or str, optional
        Its smallest friction counts; without it and without `friction` there is no GO.
    flippers, payload, direction, facing
        As in `kaidan.assess`.
    engine : {"auto", "numpy", "compiled"}
        See `kaidan.sweeps.verdicts`.
    **parameters : float, sequence or xarray.DataArray
        Any of flat_length, com_from_front, com_height, rise, going, nosing_spacing [m], angle
        [rad], friction [1], acceleration [m/s^2], theta_d, theta_M [rad]. A sequence becomes a
        dimension of its own, named after the parameter; DataArrays keep theirs, so that those
        that share a dimension vary together.

    Returns
    -------
    xarray.Dataset
        ``verdict`` and ``governs`` as codes (their meanings in the attributes), margins in
        degrees, bounds in m/s^2, each with its unit. Area E counts as NO-GO, since it needs a
        controlled acceleration; friction known as a range counts with its smallest value.

    Raises
    ------
    InputError
        An unknown, missing, contradictory or unphysical parameter.

    Examples
    --------
    >>> from math import radians
    >>> spacings = [0.150, 0.180, 0.200, 0.220]
    >>> table = sweep("kenaf", angle=radians(40), nosing_spacing=spacings, friction=2.0)
    >>> print(table.margin_angle_deg.round(3).values)
    [60.205 52.936 46.185 37.255]
    """
    import xarray

    unknown = set(parameters) - set(PARAMETERS)
    if unknown:
        raise InputError(
            f"unknown parameter {sorted(unknown)[0]!r}; known: {', '.join(PARAMETERS)}"
        )
    given = {name: _labelled(name, value) for name, value in parameters.items()}
    if surface is not None and "friction" in given:
        raise InputError("give either a surface or a friction, not both")
    angle, nosing_spacing = _shape(given, stairs)
    base = case_of(
        robot,
        _placeholder(stairs),
        surface=surface,
        flippers=flippers,
        payload=payload,
        direction=direction,
        facing=facing,
    )
    stance = base.stance
    length = given.get("flat_length", stance.flat_length)
    com = given.get("com_from_front", stance.com_from_front)
    known = base.surface.friction_low if base.surface else math.nan
    inputs = {
        "flat_length": length,
        "com_from_uphill": com if base.nose_up else length - com,
        "com_height": given.get("com_height", stance.com_height),
        "angle": angle,
        "nosing_spacing": nosing_spacing,
        "friction": given.get("friction", known),
        "acceleration": given.get("acceleration", 0.0),
    }
    for name in ("theta_d", "theta_M"):
        allowance = getattr(base, name)
        measured = given.get(name)
        inputs[name] = allowance.high if measured is None else measured
        inputs[f"{name}_spare"] = (allowance.high - allowance.low) if measured is None else 0.0
    arrays = xarray.broadcast(*(xarray.DataArray(value) for value in inputs.values()))
    plain = {name: array.values for name, array in zip(inputs, arrays, strict=True)}
    answer = verdicts(plain, engine=engine)
    table = _dataset(answer, arrays[0].dims)
    coordinates = {name: value for name, value in given.items() if value.dims == (name,)}
    table = table.assign_coords(coordinates)
    table.attrs |= {
        "robot": base.robot.name,
        "direction": base.direction,
        "facing": base.facing,
        "model": "closed-form",
    }
    return table


def _labelled(name: str, value: Any) -> "xarray.DataArray":
    import xarray

    if isinstance(value, xarray.DataArray):
        array = value
    else:
        try:
            numbers = np.asarray(value, dtype=np.float64)
        except (TypeError, ValueError):
            raise InputError(
                f"{name} = {value!r} is not a number or a sequence of numbers"
            ) from None
        if numbers.ndim > 1:
            raise InputError(f"{name} has {numbers.ndim} dimensions; name them in a DataArray")
        dims = (name,) if numbers.ndim else ()
        array = xarray.DataArray(numbers, dims=dims, coords={name: numbers} if dims else {})
    return array.assign_attrs(units=PARAMETERS[name])


def _shape(given: dict[str, Any], stairs: Stairs | str | None) -> tuple[Any, Any]:
    """Angle and nosing spacing from the swept parameters and the sheet."""
    sides, slope = {"rise", "going"} & set(given), {"angle", "nosing_spacing"} & set(given)
    if sides and slope:
        raise InputError("sweep either rise and going or angle and nosing_spacing, not both")
    sheet = Stairs.named(stairs) if isinstance(stairs, str) else stairs
    if sheet is not None and len(set(sheet.regular_steps)) > 1:
        raise InputError(f"stairs {sheet.name!r} are not uniform; sweep them step by step")
    if sheet is None and len(sides) != 2 and len(slope) != 2:
        raise InputError("no stairs: give them, or rise and going, or angle and nosing_spacing")
    shape: dict[str, Any] = {}
    if sheet is not None:
        rise, going = sheet.regular_steps[0]
        spacing = sheet.nosing_spacing
        shape = {"rise": rise, "going": going, "angle": sheet.angle, "nosing_spacing": spacing}
    shape |= given
    if sides:
        return np.arctan2(shape["rise"], shape["going"]), np.hypot(shape["rise"], shape["going"])
    return shape["angle"], shape["nosing_spacing"]


def _placeholder(stairs: Stairs | str | None) -> Stairs | str:
    """Stairs for the parts of a case that no sweep replaces: direction and checks."""
    return Stairs(rise=0.18, going=0.28) if stairs is None else stairs


def _dataset(answer: Judged, dims: Any) -> "xarray.Dataset":
    import xarray

    variables: dict[str, Any] = {
        "verdict": (dims, answer.verdict, _codes(Verdict)),
        "governs": (dims, answer.governs, _codes(Mode)),
    }
    for field, (name, meaning) in _ANGLES.items():
        values = np.degrees(getattr(answer, field))
        variables[name] = (dims, values, {"units": "deg", "long_name": meaning})
    for field, (name, unit, factor, meaning) in _OTHERS.items():
        values = getattr(answer, field) * factor
        variables[name] = (dims, values, {"units": unit, "long_name": meaning})
    return xarray.Dataset(variables)


def _codes(kind: Any) -> dict[str, Any]:
    words = (member.name.lower().replace("_", "-") for member in kind)
    return {"flag_values": [int(member) for member in kind], "flag_meanings": " ".join(words)}

"""The paper's formulas over labelled arrays: a Dataset of xarray with units."""

import math
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from kaidan.errors import InputError, listed, needed, shown
from kaidan.mechanics.plane import contact_count
from kaidan.mechanics.verdict import Judged
from kaidan.models.closed_form import MODES
from kaidan.models.drive_limits import steepest_for_drive
from kaidan.models.regular_flight import gap_below
from kaidan.modes import DRIVE, FORMULAS, TIP_DOWNHILL, TIP_UPHILL, Verdict
from kaidan.question import Question
from kaidan.robot import Payload, Posture, Robot
from kaidan.spelling import sheet_of
from kaidan.surface import Surface
from kaidan.sweeps.pairs import CODES, Engine, numbers_of, verdicts
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs

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
    "slides_down": ("slides_down_deg", "margin against sliding down for lack of friction"),
    "slides_up": ("slides_up_deg", "margin against sliding up when braking"),
    "drive": ("drive_deg", "margin of the drive's traction"),
}
DRIVE_CODE = MODES.index(DRIVE)
SWEPT = Profile.of_points([(0.0, 0.0), (1.0, 0.0)], name="swept flights")
"""Terrain of the question where no stairs are given: level, because none of its steps may count;
the flights are the parameters'."""
_OTHERS = {
    "a_max": ("a_max", "m/s^2", 1.0, "upper end of the band of acceleration, without allowances"),
    "a_min": ("a_min", "m/s^2", 1.0, "lower end of the band of acceleration"),
    "centroid": ("margin_centroid_mm", "mm", 1e3, "how far the centroid may move, allowances off"),
    "required_friction": ("required_friction", "1", 1.0, "friction below which it slips"),
}


def formula_table(
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
    """Verdict and every margin of a robot on stairs by the paper's formulas, over arrays.

    What `kaidan.sweep` does without a model.

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
        degrees, bounds in m/s^2, each with its unit; NaN outside the model. The sheets' figures
        count, without their uncertainty. Area E counts as NO-GO, since it needs a controlled
        acceleration; friction known as a range counts with its smallest value; of the drive its
        largest traction is judged, not its power, which takes a speed.

    Raises
    ------
    InputError
        An unknown, missing, contradictory or unphysical parameter.

    Examples
    --------
    >>> from math import radians
    >>> spacings = [0.150, 0.180, 0.200, 0.220]
    >>> table = formula_table("kenaf", angle=radians(40), nosing_spacing=spacings, friction=2.0)
    >>> print(table.margin_angle_deg.round(3).values)
    [60.205 52.936 46.185 37.255]
    """
    needed("xarray", "a labelled table", "sweeps")
    import xarray

    unknown = set(parameters) - set(PARAMETERS)
    if unknown:
        raise InputError(
            f"unknown parameter {shown(sorted(unknown)[0])}; known: {listed(PARAMETERS)}"
        )
    given = {name: _labelled(name, value) for name, value in parameters.items()}
    if surface is not None and "friction" in given:
        raise InputError("give either a surface or a friction, not both")
    try:
        xarray.align(*given.values(), join="exact")
    except ValueError as error:
        raise InputError(f"parameters share a dimension but not its labels: {error}") from None
    flight = None if stairs is None else sheet_of(stairs, Stairs)
    base = Question.of(
        robot,
        SWEPT if flight is None else flight,
        surface=surface,
        flippers=flippers,
        payload=payload,
        direction=direction,
        facing=facing,
    )
    angle, nosing_spacing = _shape(given, flight)
    stance = base.stance
    length = given.get("flat_length", stance.flat_length)
    com = given.get("com_from_front", stance.com_from_front)
    if not {"com_from_front", "com_height"} <= given.keys():
        _ = base.robot.weighed
    _centroid_inside(base.robot, com, length)
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
        allowance = getattr(base, {"theta_d": "allowance_d", "theta_M": "allowance_M"}[name])
        measured = given.get(name)
        inputs[name] = allowance.high if measured is None else measured
        inputs[f"{name}_spare"] = (allowance.high - allowance.low) if measured is None else 0.0
    import xarray

    arrays = xarray.broadcast(*(xarray.DataArray(value) for value in inputs.values()))
    plain = {name: array.values for name, array in zip(inputs, arrays, strict=True)}
    if given.get("theta_d") is None:
        with np.errstate(all="ignore"):  # what cannot be judged is refused below
            high = base.theta_d_at(
                L=plain["flat_length"],
                p=plain["nosing_spacing"],
                C_L=plain["com_from_uphill"],
                C_N=plain["com_height"],
            )
        plain["theta_d_spare"] = plain["theta_d_spare"] + high - plain["theta_d"]
        plain["theta_d"] = np.broadcast_to(high, plain["angle"].shape)
    answer = verdicts(plain, engine=engine)
    drive = steepest_for_drive(base, plain["acceleration"]) - plain["angle"]
    answer, drive = _beyond_the_formulas(base, flight, plain, answer, drive)
    table = _dataset(answer, drive, arrays[0].dims)
    labels = {k: v for value in given.values() for k, v in value.coords.items() if v.dims}
    swept = {name: value for name, value in given.items() if value.dims == (name,)}
    table = table.assign_coords(labels | swept)
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
        array = value.copy(data=numbers_of(name, value.values))
    else:
        numbers = numbers_of(name, value)
        if numbers.ndim > 1:
            raise InputError(f"{name} has {numbers.ndim} dimensions; name them in a DataArray")
        dims = (name,) if numbers.ndim else ()
        array = xarray.DataArray(numbers, dims=dims, coords={name: numbers} if dims else {})
    return array.assign_attrs(units=PARAMETERS[name])


def _shape(given: dict[str, Any], sheet: Stairs | None) -> tuple[Any, Any]:
    """Angle and nosing spacing from the swept parameters and the sheet."""
    sides, slope = {"rise", "going"} & set(given), {"angle", "nosing_spacing"} & set(given)
    if sides and slope:
        raise InputError("sweep either rise and going or angle and nosing_spacing, not both")
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


def _centroid_inside(robot: Robot, com: Any, length: Any) -> None:
    """Refuse a centroid outside the robot, as the robot's sheet does."""
    track = robot.track
    wrong = (com < -track.front_radius) | (com > length + track.rear_radius)
    if np.any(wrong):
        raise InputError(
            f"com_from_front = {float(np.max(np.where(wrong, com, -np.inf))):g} m puts the "
            f"centroid outside the robot: allowed {0.0 - track.front_radius:g} m to flat_length "
            f"{track.rear_radius:+g} m"
        )


def _beyond_the_formulas(
    question: Question, flight: Stairs | None, inputs: dict[str, Any], answer: Judged, drive: Any
) -> tuple[Judged, Any]:
    """Put into an answer what `kaidan.assess` judges beside the margins of the formulas.

    The drive's traction; and outside the model are nosings that nothing carries, and flights
    with fewer nosings than the track holds at once.
    """
    outside = np.full(np.shape(answer.margin), bool(gap_below(question)))
    if flight is not None:
        held = contact_count(L=inputs["flat_length"], p=inputs["nosing_spacing"]) + 1
        outside |= len(flight.step_rises) < held
    numbers = answer._asdict()
    for name in set(numbers) - set(CODES):
        numbers[name] = np.where(outside, np.nan, numbers[name])
    beyond = outside | (answer.verdict == Verdict.OUTSIDE_MODEL.rank)
    drive = np.where(beyond, np.nan, drive)
    stalls, failed = drive <= 0, answer.verdict == Verdict.NO_GO.rank
    codes = np.where(stalls, Verdict.NO_GO.rank, answer.verdict)
    theta_d, theta_M = inputs["theta_d_spare"], inputs["theta_M_spare"]
    spare = {TIP_DOWNHILL: theta_d + theta_M, TIP_UPHILL: theta_d}
    at_best = [numbers[mode.key] + failed * spare.get(mode, 0.0) for mode in FORMULAS]
    by_drive = (drive < np.choose(answer.governs, at_best)) | (stalls & ~failed)
    return answer._replace(
        **numbers
        | {
            "verdict": np.where(beyond, Verdict.OUTSIDE_MODEL.rank, codes).astype(np.int8),
            "governs": np.where(by_drive, DRIVE_CODE, answer.governs).astype(np.int8),
            "margin": np.fmin(numbers["margin"], drive),
            "centroid": np.where(_past_vertical(inputs), np.nan, numbers["centroid"]),
        }
    ), drive


def _past_vertical(inputs: dict[str, Any]) -> Any:
    """Where no place of the centroid holds, because the allowances lean it past the vertical."""
    return inputs["angle"] + inputs["theta_d"] + inputs["theta_M"] >= np.pi / 2


def _dataset(answer: Judged, drive: Any, dims: Any) -> "xarray.Dataset":
    import xarray

    variables: dict[str, Any] = {
        "verdict": (dims, answer.verdict, _codes(word.value for word in Verdict)),
        "governs": (dims, answer.governs, _codes(mode.key for mode in MODES)),
    }
    for field, (name, meaning) in _ANGLES.items():
        values = np.degrees(drive if field == "drive" else getattr(answer, field))
        variables[name] = (dims, values, {"units": "deg", "long_name": meaning})
    for field, (name, unit, factor, meaning) in _OTHERS.items():
        values = getattr(answer, field) * factor
        variables[name] = (dims, values, {"units": unit, "long_name": meaning})
    return xarray.Dataset(variables)


def _codes(names: Iterable[str]) -> dict[str, Any]:
    words = [name.lower().replace("_", "-") for name in names]
    return {"flag_values": list(range(len(words))), "flag_meanings": " ".join(words)}

"""``kaidan robots|stairs|surfaces``: the catalogues, and one sheet of them whole."""

import math
from collections.abc import Iterable
from collections.abc import Set as AbstractSet
from typing import TYPE_CHECKING, Annotated, Any

import typer

from kaidan.cli import output
from kaidan.cli.options import AsJson
from kaidan.cli.tables import echo, echo_json, echo_table
from kaidan.tables import human, unit_of

if TYPE_CHECKING:
    from kaidan.robot import Robot
    from kaidan.sheet import Sheet
    from kaidan.surface import Surface
    from kaidan.terrain.stairs import Stairs

Name = Annotated[str | None, typer.Argument(help="Catalogue name or TOML file to show whole.")]


def register(app: typer.Typer) -> None:
    """Add the commands of this module to the command line."""
    app.command("robots")(robots)
    app.command("stairs")(stairs)
    app.command("surfaces")(surfaces)


def robots(name: Name = None, figure: output.FigureFiles = None, as_json: AsJson = False) -> None:
    """List the robots, or show one.

    One is shown whole: figures, units, symbols, sources and what follows from them; --figure draws
    it from the side with L, C_L, C_N and R.
    """
    from kaidan import catalog
    from kaidan.errors import InputError
    from kaidan.robot import Robot

    pictures = output.checked(figure)
    if pictures and name is None:
        raise InputError("--figure needs the NAME of a robot")

    gross = catalog.gross_robots()
    if name is not None and name.strip().lower() in gross:
        stem = name.strip().lower()
        _show_gross(stem, gross[stem], as_json)
    elif name is not None:
        robot = Robot.named(name)
        _show(robot, _of_robot(robot), as_json)
        output.write(output.drawn(pictures, lambda: _drawing(robot)), aside=as_json)
    else:
        rows = [_robot_row(Robot.named(each)) for each in catalog.names("robots")]
        unweighed = [_unweighed_row(Robot.named(each)) for each in catalog.names("unweighed")]
        apart = [{"name": each, **entry} for each, entry in gross.items()]
        if as_json:
            echo_json({"robots": rows, "unweighed": unweighed, "no_centroid_published": apart})
            return
        echo_table(
            rows,
            {
                "name": "name",
                "title": "title",
                "flat_length_m": "L [mm]",
                "com_from_front_m": "C_L [mm]",
                "com_height_m": "C_N [mm]",
                "radius_m": "R [mm]",
                "mass_kg": "mass [kg]",
                "flippers": "flippers",
                "centroid_status": "centroid",
            },
            below="title",
        )
        echo("\nNobody measured the centroid, a range is stated: UNSURE until weighed:")
        echo_table(
            unweighed,
            {
                "name": "name",
                "title": "title",
                "flat_length_m": "L [mm]",
                "from_front": "C_L [mm]",
                "height": "C_N [mm]",
                "radius_m": "R [mm]",
                "mass_kg": "mass [kg]",
                "flippers": "flippers",
            },
            below="title",
        )
        echo("\nNo length published either, so nothing can be computed:")
        echo_table(apart, {"name": "name", "title": "title", "figures": "figures"})
        echo(f"\n{_STATUS}\nR: front/rear end radius. One whole: kaidan robots NAME")


def stairs(name: Name = None, as_json: AsJson = False) -> None:
    """List the stairs, or show one flight.

    One is shown whole: figures, units, sources and what follows from them.
    """
    from kaidan import catalog
    from kaidan.terrain.stairs import Stairs

    if name is not None:
        flight = Stairs.named(name)
        # a measured flight has as many risers as its list, whatever the default of steps
        _show(flight, _of_stairs(flight), as_json, hidden={"steps"} if flight.rises else set())
        return
    rows = [_stairs_row(Stairs.named(each)) for each in catalog.names("stairs")]
    if as_json:
        echo_json({"stairs": rows})
        return
    echo_table(
        rows,
        {
            "name": "name",
            "title": "title",
            "rise_m": "rise [mm]",
            "going_m": "going [mm]",
            "angle_deg": "angle [deg]",
            "nosing_spacing_m": "spacing [mm]",
            "risers": "risers",
            "open_risers": "open",
        },
        below="title",
    )
    echo("\nspacing: from nosing to nosing along the slope. One whole: kaidan stairs NAME")


def surfaces(name: Name = None, as_json: AsJson = False) -> None:
    """List the surfaces, or show one.

    One is shown whole: friction, sources and the slope on which it still holds.
    """
    from kaidan import catalog
    from kaidan.surface import Surface

    if name is not None:
        surface = Surface.named(name)
        _show(surface, _of_surface(surface), as_json)
        return
    rows = [_surface_row(Surface.named(each)) for each in catalog.names("surfaces")]
    if as_json:
        echo_json({"surfaces": rows})
        return
    echo_table(
        rows,
        {
            "name": "name",
            "title": "title",
            "friction_low": "mu_s from",
            "friction_high": "to",
            "slope_low_deg": "holds to [deg]",
            "slope_high_deg": "at best [deg]",
            "status": "status",
        },
        below="title",
    )
    echo(f"\n{_STATUS}\nOne whole: kaidan surfaces NAME")


_STATUS = "V: read in a named source, C: computed from a model, D: derived, U: unconfirmed."


def _robot_row(robot: "Robot") -> dict[str, Any]:
    return {
        "name": robot.name,
        "title": robot.title,
        "flat_length_m": robot.track.flat_length,
        "com_from_front_m": robot.com_from_front,
        "com_height_m": robot.com_height,
        "radius_m": [robot.track.front_radius, robot.track.rear_radius],
        "mass_kg": robot.mass,
        "flippers": robot.front_flippers is not None or robot.rear_flippers is not None,
        "centroid_status": _status(robot.sources, ("com_from_front", "com_height")),
    }


def _drawing(robot: "Robot") -> "output.Figure":
    from kaidan.figures.dimensions_figure import dimensions_figure
    from kaidan.figures.robot_sketch import Sketch

    track = robot.track
    lengths = Sketch(
        track.flat_length, robot.com_from_front, robot.com_height, track.front_radius,
        track.rear_radius,
    )  # fmt: skip
    return dimensions_figure(robot.title or robot.name, lengths)


def _unweighed_row(robot: "Robot") -> dict[str, Any]:
    span = robot.com_range
    assert span is not None
    row = _robot_row(robot)
    for name, (low, high) in (("from_front", span.from_front), ("height", span.height)):
        row[name] = f"{1e3 * low:.0f} to {1e3 * high:.0f}"
    return {key: value for key, value in row.items() if not key.startswith("com_")}


def _of_robot(robot: "Robot") -> dict[str, Any]:
    """What follows from a robot's figures."""
    derived: dict[str, Any] = {"longest_nosing_spacing_m": robot.track.flat_length / 2}
    ends = {"front": robot.front_flippers, "rear": robot.rear_flippers}
    flat = {end: "flat" for end, pair in ends.items() if pair is not None}
    if flat:
        from kaidan.robot import Posture

        stance = robot.stance(Posture.model_validate(flat))
        derived |= {
            "flippers_flat_flat_length_m": stance.flat_length,
            "flippers_flat_com_from_front_m": stance.com_from_front,
            "flippers_flat_com_height_m": stance.com_height,
            "flippers_flat_longest_nosing_spacing_m": stance.flat_length / 2,
        }
    return derived


def _stairs_row(flight: "Stairs") -> dict[str, Any]:
    rises, goings = zip(*flight.regular_steps, strict=True)
    return {
        "name": flight.name,
        "title": flight.title,
        "rise_m": math.fsum(rises) / len(rises),
        "going_m": math.fsum(goings) / len(goings),
        "angle_deg": math.degrees(flight.angle),
        "nosing_spacing_m": flight.nosing_spacing,
        "risers": len(flight.step_rises),
        "open_risers": flight.open_risers,
    }


def _of_stairs(flight: "Stairs") -> dict[str, Any]:
    """What follows from the figures of a flight."""
    return {
        "angle_deg": math.degrees(flight.angle),
        "nosing_spacing_m": flight.nosing_spacing,
        "risers": len(flight.step_rises),
        "total_rise_m": math.fsum(flight.step_rises),
        "total_going_m": math.fsum(flight.step_goings),
        "irregularity_m": flight.irregularity,
        "required_friction": math.tan(flight.angle),
    }


def _surface_row(surface: "Surface") -> dict[str, Any]:
    return {
        "name": surface.name,
        "title": surface.title,
        "friction_low": surface.friction_low,
        "friction_high": surface.friction_high,
        **_of_surface(surface),
        "status": _status(surface.sources, ("friction_low", "friction_high")),
    }


def _of_surface(surface: "Surface") -> dict[str, Any]:
    """What follows from a surface's figures: the slopes on which a robot just holds."""
    return {
        "slope_low_deg": math.degrees(math.atan(surface.friction_low)),
        "slope_high_deg": math.degrees(math.atan(surface.friction_high)),
    }


def _status(sources: dict[str, str], fields: Iterable[str]) -> str:
    """Status letters of some fields, worst last, "-" where a source is missing."""
    found = {sources.get(field, "-").strip()[:1].upper() or "-" for field in fields}
    return "/".join(sorted(found, key="VCDU-".find))


def _show(
    sheet: "Sheet", derived: dict[str, Any], as_json: bool, hidden: AbstractSet[str] = frozenset()
) -> None:
    """Print one sheet whole."""
    from kaidan.verbs.sheet_rows import field_rows

    content = sheet.model_dump(mode="json", exclude=set(hidden))
    if as_json:
        echo_json({"kind": sheet.label, "sheet": content, "derived": derived})
        return
    echo(f"{content['name']}: {content['title']}" if content["title"] else content["name"])
    echo_table(
        [row._asdict() for row in field_rows(sheet) if row.field not in hidden],
        {"field": "field", "symbol": "symbol", "value": "value", "source": "source"},
    )
    rows = [_derived_row(key, value) for key, value in derived.items()]
    echo("\nWhat follows:")
    echo_table(rows, {"derived": "derived", "symbol": "symbol", "value": "value"})
    if content["notes"]:
        echo(f"\n{content['notes'].strip()}")


_SYMBOLS = {
    "angle": "theta_s",
    "nosing spacing": "p",
    "flat length, flippers flat": "L",
    "com from front, flippers flat": "C_L",
    "com height, flippers flat": "C_N",
    "longest nosing spacing": "L/2",
    "longest nosing spacing, flippers flat": "L/2",
    "slope low": "atan mu_s",
    "slope high": "atan mu_s",
    "required friction": "tan theta_s",
}


def _derived_row(key: str, value: Any) -> dict[str, str]:
    words = (key.rpartition("_")[0] if unit_of(key) else key).replace("_", " ")
    if words.startswith("flippers flat "):
        words = words.removeprefix("flippers flat ") + ", flippers flat"
    return {"derived": words, "symbol": _SYMBOLS.get(words, ""), "value": human(value, key)}


def _show_gross(name: str, entry: dict[str, str], as_json: bool) -> None:
    if as_json:
        echo_json({"kind": "gross", "sheet": {"name": name, **entry}, "derived": {}})
        return
    echo(f"{name}: {entry['title']}\n{entry['figures']}\n{entry['source']}")
    echo(
        "No length is published, so nothing can be computed: measure the robot (kaidan measure "
        "robot --help)"
    )

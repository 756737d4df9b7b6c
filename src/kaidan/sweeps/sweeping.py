"""`kaidan.sweep`: the formulas over arrays, or any model cell by cell."""

from pathlib import Path
from typing import TYPE_CHECKING, Any

from kaidan.arguments import known_arguments
from kaidan.sweeps.pairs import Engine

if TYPE_CHECKING:
    import xarray


@known_arguments
def sweep(
    robot: Any,
    stairs: Any = None,
    *,
    model: str | None = None,
    engine: Engine = "auto",
    screen: bool = False,
    scheduler: str = "threads",
    workers: int | None = None,
    store: str | Path | None = None,
    progress: bool = False,
    **parameters: Any,
) -> "xarray.Dataset":
    """Verdict and margins over arrays of anything in a question.

    Parameters
    ----------
    robot : Robot, str, path or a list of them
        Robots.
    stairs : Stairs, Profile, str, path, a tuple of flights or a list of these, optional
        Terrains; needed unless the parameters give the whole shape of uniform stairs.
    model : {"contact", "closed-form", "support-polygon", "physics"}, optional
        Model that judges each cell, as `kaidan.assess` does: same findings, same verdict. Without
        one the paper's formulas are evaluated over whole arrays, see ``kaidan.sweeps.table``: some
        million times faster, and of the regular flight alone, so that GO may stand where `assess`
        has none.
    engine : {"auto", "numpy", "compiled"}
        Of the formulas, see `kaidan.verdicts`; a model has its own.
    screen : bool
        Whether the contact model is spared cells of which the closed form alone says that they are
        no GO. They get the verdict "not-go" and no margin; every GO is the contact model's.
    scheduler : str
        Where cells are judged: "threads" of this process, "processes" of this machine (a script
        then needs ``if __name__ == "__main__":``), or the address of a running Dask scheduler.
    workers : int, optional
        Threads or processes; without one each processor gets one.
    store : str or Path, optional
        Folder in which what is done is kept: the same call goes on where it was broken off, by
        ``kill -9`` too.
    progress : bool
        Whether to show how it goes, if standard error is a terminal.
    **parameters
        Arguments of `kaidan.Question.of`, figures of the robot (com_height, track.front_radius),
        of its one payload (payload.height), and the shape of uniform stairs (rise, going, angle,
        nosing_spacing, steps, landings). A list or an array varies, a labelled array of xarray
        keeps its dimensions, a tuple is one value: ``friction=[0.6, (0.6, 1.0)]`` has two cells.

    Returns
    -------
    xarray.Dataset
        ``verdict`` and ``governs`` as codes (their meanings in the attributes), margins in
        degrees, mm or m/s by failure mode, posture and facing, each with its unit. NaN: not known;
        infinite: it only holds (+) or does not (-). A cell without physical meaning, such as a
        centroid outside the robot, is outside the model, its `refusal` says why.

    Raises
    ------
    InputError
        An unknown, missing or contradictory parameter, or no cell with a physical meaning.

    Examples
    --------
    >>> table = sweep("absolem", ["ibc", "ada"], model="contact", friction=[0.8, 1.0],
    ...               flippers="flat")
    >>> print(table.margin_deg.round(1).values)
    [[-3.5  2.8]
     [-3.5  2.8]]
    """
    if model is None:
        from kaidan.sweeps.table import formula_table

        return formula_table(robot, stairs, engine=engine, **parameters)
    from kaidan.sweeps.plan import Plan
    from kaidan.sweeps.running import carried_out

    values = {"robot": robot, "stairs": stairs, "model": model, **parameters}
    if stairs is None:
        del values["stairs"]
    return carried_out(
        Plan.of(values, screen=screen),
        scheduler=scheduler,
        workers=workers,
        store=store,
        progress=progress,
    ).dataset()

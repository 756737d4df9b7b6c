"""Real geometry in: what a file holds, as stairs or a robot with their doubt, or as a refusal.

The content of a file says what it is (`recognition`); its reader in `formats` yields exactly one
of the kinds in `kinds`; the interpreter of that kind in `interpreters` yields what was found
(`estimate`). What cannot be read raises `InputError`; what can be read and holds no stairs is a
`Refusal`, which is a result.
"""

from importlib import import_module
from pathlib import Path
from typing import Any

from kaidan.errors import MissingExtraError
from kaidan.readers.estimate import Found, Refusal
from kaidan.readers.hints import Hints
from kaidan.readers.kinds import Heights, Mesh, Points, Provenance
from kaidan.readers.opening import Source
from kaidan.readers.recognition import INTERPRETERS, Format, recognised

NO_HINTS = Hints()
"""Nothing was stated."""
_KINDS = {Points: "points", Mesh: "mesh", Heights: "heights"}


def found_in(path: str | Path, hints: Hints = NO_HINTS) -> Found:
    """Stairs, robot or refusals that a file holds.

    Parameters
    ----------
    path : str or Path
        Of any known format; its content decides which, not its suffix.
    hints : Hints
        What the person knows of it.

    Raises
    ------
    InputError
        A file that cannot be read, contradicts itself, or is of no known format.
    MissingExtraError
        Its reader needs an optional package.
    """
    source = Source.of(path)
    form = recognised(source)
    if form.refusal:
        provenance = Provenance(path=str(path), digest=source.digest, form=form.name)
        return Found(provenance, refusals=(Refusal(form.refusal, {}, provenance),))
    contents = contents_of(source, form, hints)
    kind = _KINDS.get(type(contents), form.kind)
    found: Found = import_module(INTERPRETERS[kind]).found(contents, hints)
    return found


def contents_of(source: Source, form: Format, hints: Hints = NO_HINTS) -> Any:
    """What a file of a known format holds, not interpreted yet: one of `kinds`."""
    module, _, function = form.reader.partition(":")
    reader = import_module(f"kaidan.readers.formats.{module}")
    try:
        return getattr(reader, function or "read")(source, hints)
    except ModuleNotFoundError as error:
        if not form.extra:
            raise
        raise MissingExtraError(f"{form.title} as input", form.extra) from error

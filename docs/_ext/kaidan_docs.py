"""Tables of the site that are written from the code and the catalogues when it is built."""

import inspect
import re
import tomllib
from collections.abc import Iterator
from importlib import import_module
from pathlib import Path
from typing import Any

from docutils import nodes
from models import models
from sphinx.application import Sphinx
from sphinx.util.docutils import SphinxDirective

from kaidan import catalog
from kaidan.robot import Robot
from kaidan.sheet import Sheet, bounds
from kaidan.surface import Surface
from kaidan.terrain.stairs import Stairs

CATALOG = Path(catalog.__file__).parent
SHEETS: dict[str, type[Sheet]] = {
    "robots": Robot,
    "unweighed": Robot,
    "stairs": Stairs,
    "surfaces": Surface,
}


class Written(SphinxDirective):
    """A directive whose content is Markdown written by `lines`."""

    optional_arguments = 1

    def run(self) -> list[nodes.Node]:
        """Parse what `lines` writes."""
        for module in self.watched():
            self.env.note_dependency(str(module))
        text = "\n".join(self.lines())
        return self.parse_text_to_nodes(text, allow_section_headings=True)

    def watched(self) -> Iterator[Path]:
        """Files that the content depends on."""
        yield Path(__file__)

    def lines(self) -> Iterator[str]:
        """Lines of Markdown."""
        raise NotImplementedError


def table(heads: list[str], rows: list[list[str]]) -> Iterator[str]:
    """Markdown table."""
    yield ""
    yield "| " + " | ".join(heads) + " |"
    yield "|" + "---|" * len(heads)
    for row in rows:
        yield "| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in row) + " |"
    yield ""


def code(text: Any) -> str:
    """Text as code; nothing for nothing."""
    return f"`{text}`" if str(text) else ""


def number(value: float) -> str:
    """Number without trailing noise."""
    return f"{value:.5g}"


class Catalogue(Written):
    """``{catalogue} robots``: every sheet of a catalogue with the source of each figure."""

    required_arguments = 1
    optional_arguments = 0

    def watched(self) -> Iterator[Path]:
        """Sheets of the catalogue."""
        yield from super().watched()
        yield from (CATALOG / self.arguments[0]).glob("*.toml")

    def lines(self) -> Iterator[str]:
        """One section a sheet."""
        kind = self.arguments[0]
        for name in catalog.names(kind):  # type: ignore[arg-type]
            yield from _sheet(kind, name)


class Overview(Catalogue):
    """``{overview} robots``: one row a sheet. Apart, because MyST puts sections before tables."""

    def lines(self) -> Iterator[str]:
        """Table of the kind asked for."""
        tables = {
            "robots": _robots,
            "unweighed": _unweighed,
            "stairs": _stairs,
            "surfaces": _surfaces,
        }
        yield from tables[self.arguments[0]]()


def _robots() -> Iterator[str]:
    rows = []
    for name in catalog.names("robots"):
        robot = Robot.named(name)
        radii = {robot.track.front_radius, robot.track.rear_radius}
        rows.append(
            [
                f"[{name}](#robots-{name})",
                "not published" if robot.mass is None else number(robot.mass),
                number(1e3 * robot.track.flat_length),
                number(1e3 * robot.com_from_front),
                number(1e3 * robot.com_height),
                " / ".join(number(1e3 * radius) for radius in sorted(radii)),
                "yes" if robot.front_flippers or robot.rear_flippers else "no",
                number(1e3 * robot.track.flat_length / 2),
            ]
        )
    heads = ["name", "mass [kg]", "L [mm]", "C_L [mm]", "C_N [mm]", "R [mm]", "flippers"]
    yield from table([*heads, "largest p [mm]"], rows)


def _unweighed() -> Iterator[str]:
    rows = []
    for name in catalog.names("unweighed"):
        robot = Robot.named(name)
        assert robot.com_range is not None
        spans = (robot.com_range.from_front, robot.com_range.height)
        rows.append(
            [
                f"[{name}](#unweighed-{name})",
                "not published" if robot.mass is None else number(robot.mass),
                number(1e3 * robot.track.flat_length),
                *(f"{number(1e3 * low)} to {number(1e3 * high)}" for low, high in spans),
                number(1e3 * robot.track.front_radius),
            ]
        )
    yield from table(["name", "mass [kg]", "L [mm]", "C_L [mm]", "C_N [mm]", "R [mm]"], rows)


def _stairs() -> Iterator[str]:
    rows = []
    for name in catalog.names("stairs"):
        flight = Stairs.named(name)
        rise, going = flight.regular_steps[0]
        cells = (1e3 * rise, 1e3 * going, flight.angle * 57.29577951308232)
        rows.append(
            [
                f"[{name}](#stairs-{name})",
                *(f"{cell:.1f}" for cell in cells),
                f"{1e3 * flight.nosing_spacing:.1f}",
                str(len(flight.step_rises)),
                flight.title,
            ]
        )
    heads = ["name", "rise [mm]", "going [mm]", "angle [°]", "p [mm]", "risers", "what it is"]
    yield from table(heads, rows)


def _surfaces() -> Iterator[str]:
    rows = []
    for name in catalog.names("surfaces"):
        surface = Surface.named(name)
        span = f"{surface.friction_low:g} to {surface.friction_high:g}"
        rows.append([f"[{name}](#surfaces-{name})", span, surface.title])
    yield from table(["name", "static friction", "what it is"], rows)


def _sheet(kind: str, name: str) -> Iterator[str]:
    """Section of one sheet: notes, figures, sources."""
    text = (CATALOG / kind / f"{name}.toml").read_text(encoding="utf-8")
    content = tomllib.loads(text)
    yield f"(#{kind}-{name})=".replace("(#", "(")
    yield f"### {name}"
    yield ""
    yield f"{content['title']}."
    yield ""
    yield " ".join(content.get("notes", "").split())
    sources = content["sources"]
    rows = [
        [code(path), symbol, shown, sources.get(path, "")]
        for path, symbol, shown in _figures(SHEETS[kind], content)
    ]
    yield from table(["field", "symbol", "value", "source"], rows)


def _figures(
    sheet: type[Sheet], content: dict[str, Any], path: str = ""
) -> Iterator[tuple[str, str, str]]:
    for key, value in content.items():
        if key in ("name", "title", "notes", "sources"):
            continue
        field = sheet.model_fields[key]
        tables = [value] if isinstance(value, dict) else value
        if isinstance(tables, list) and isinstance(tables[0], dict):
            inner = next(
                part
                for part in (field.annotation, *getattr(field.annotation, "__args__", ()))
                if inspect.isclass(part) and issubclass(part, Sheet)
            )
            for number, table in enumerate(tables, 1):
                place = f"{path}{key}" if tables[0] is value else f"{path}{key}[{number}]"
                yield from _figures(inner, table, f"{place}.")
            continue
        unit, _, _ = bounds(field)
        extra = field.json_schema_extra
        symbol = str(extra.get("symbol", "")) if isinstance(extra, dict) else ""
        if isinstance(value, bool):
            shown = "yes" if value else "no"
        elif isinstance(value, str):
            shown = value
        elif isinstance(value, list):
            shown = " to ".join(f"{each:g}" for each in value) + f"\N{NO-BREAK SPACE}{unit}"
        else:
            shown = f"{value:g}" + (f"\N{NO-BREAK SPACE}{unit}" if unit and unit != "1" else "")
        yield path + key, code(symbol), shown


class Gross(Written):
    """``{gross-robots}``: robots of which no centroid is published."""

    def watched(self) -> Iterator[Path]:
        """The file they stand in."""
        yield from super().watched()
        yield CATALOG / "gross.toml"

    def lines(self) -> Iterator[str]:
        """One row a robot."""
        rows = [
            [code(name), entry["title"], entry["figures"], entry["source"]]
            for name, entry in catalog.gross_robots().items()
        ]
        yield from table(["name", "robot", "figures", "source"], rows)


class PublicOutcomes(Written):
    """``{public-outcomes} pair``: what is public of robots on stairs; ``sources``, ``reported``."""

    required_arguments = 1
    optional_arguments = 0

    def watched(self) -> Iterator[Path]:
        """The file they stand in."""
        yield from super().watched()
        yield CATALOG / "outcomes.toml"

    def lines(self) -> Iterator[str]:
        """Table of the part that is named."""
        part = catalog.outcomes()[self.arguments[0]]
        if self.arguments[0] == "sources":
            keys = ("citation", "link", "assumed")
            rows = [[code(key), *(entry[name] for name in keys)] for key, entry in part.items()]
            yield from table(["source", "document", "link", "what it leaves open"], rows)
        elif self.arguments[0] == "reported":
            keys = ("robot", "stairs", "outcome", "status", "missing", "source")
            rows = [[entry[key] for key in keys] for entry in part]
            yield from table(["robot", "stairs", "outcome", "status", "missing", "source"], rows)
        else:
            rows = [
                [
                    entry["robot"],
                    entry.get("name")
                    or ", ".join([*entry.get("angles", []), *map(str, entry["stairs"].values())]),
                    ", ".join(f"{key} {value}" for key, value in entry["manner"].items()),
                    *(entry[key] for key in ("outcome", "evidence", "status", "note")),
                    code(entry["source"]),
                ]
                for entry in part
            ]
            heads = ["robot", "stairs", "manner", "outcome", "evidence", "status", "how", "source"]
            yield from table(heads, rows)


class SheetFields(Written):
    """``{sheet} kaidan.robot.Track``: fields of a sheet with unit, range, default, meaning."""

    required_arguments = 1
    optional_arguments = 0

    def watched(self) -> Iterator[Path]:
        """Module of the sheet."""
        yield from super().watched()
        yield Path(inspect.getfile(self._sheet()))

    def _sheet(self) -> type[Sheet]:
        module, _, name = self.arguments[0].rpartition(".")
        sheet: type[Sheet] = getattr(import_module(module), name)
        return sheet

    def lines(self) -> Iterator[str]:
        """One row a field."""
        rows = []
        for name, field in self._sheet().model_fields.items():
            unit, low, high = bounds(field)
            extra = field.json_schema_extra if isinstance(field.json_schema_extra, dict) else {}
            inner = [
                part.__name__
                for part in (field.annotation, *getattr(field.annotation, "__args__", ()))
                if inspect.isclass(part) and issubclass(part, Sheet)
            ]
            if field.is_required():
                default = "required"
            elif field.default is None:
                default = "not stated"
            elif isinstance(field.default, Sheet):
                default = "all defaults"
            elif field.default == ():
                default = "none"
            else:
                default = code(f"{field.default:.5g}" if unit else field.default or '""')
            rows.append(
                [
                    code(name),
                    code(extra.get("symbol", "")),
                    inner[0] if inner else (unit or "") if unit != "1" else "–",
                    f"{low:g} to {high:g}" if unit else "",
                    default,
                    field.description or "",
                ]
            )
        yield from table(["field", "symbol", "unit or sheet", "range", "default", "meaning"], rows)


class Commands(Written):
    """``{commands}``: every command of the command line with its options."""

    def lines(self) -> Iterator[str]:
        """One section a command."""
        from typer.main import get_command

        from kaidan.cli import app

        for name, command in _flat(get_command(app)):
            yield f"(command-{name.replace(' ', '-')})="
            yield f"## kaidan {name}"
            yield ""
            yield from _described(command.help or "")
            yield from _options(name, command)


def _flat(group: Any, before: str = "") -> Iterator[tuple[str, Any]]:
    """Commands with those of their groups, by their whole name."""
    for name, command in group.commands.items():
        if hasattr(command, "commands"):
            yield from _flat(command, f"{before}{name} ")
        else:
            yield before + name, command


def _described(text: str) -> Iterator[str]:
    """Paragraphs of a docstring; what looks like TOML or an option stays as it is."""
    for paragraph in inspect.cleandoc(text).split("\n\n"):
        if paragraph.startswith("\b"):  # a drawing
            yield from ("```text", paragraph.lstrip("\b\n"), "```", "")
            continue
        text = " ".join(paragraph.split()).replace("*", "\\*")
        yield re.sub(r"(--[\w-]+)", r"`\1`", text)
        yield ""


def _options(name: str, command: Any) -> Iterator[str]:
    """Usage and a table of what the help of a command says, parameter by parameter."""
    context = command.make_context(f"kaidan {name}", [], resilient_parsing=True)
    yield "```text"
    yield " ".join(command.get_usage(context).removeprefix("Usage: ").split())
    yield "```"
    records = [parameter.get_help_record(context) for parameter in command.get_params(context)]
    rows = [
        [code(names), told.replace("<", "\\<").replace("*", "\\*")]
        for names, told in filter(None, records)
        if "--help" not in names
    ]
    yield from table(["argument or option", "meaning"], rows)


class Answer(Written):
    """``{answer} kaidan.assessment.answer.Assessment``: fields of an answer, from its schema."""

    required_arguments = 1
    optional_arguments = 0

    def watched(self) -> Iterator[Path]:
        """Module of the answer."""
        yield from super().watched()
        yield Path(inspect.getfile(self._answer()))

    def _answer(self) -> Any:
        module, _, name = self.arguments[0].rpartition(".")
        return getattr(import_module(module), name)

    def lines(self) -> Iterator[str]:
        """The object, then the objects within it."""
        yield from _object(self._answer())


class Answers(Written):
    """``{answers}``: every answer of a verb, one section each."""

    def watched(self) -> Iterator[Path]:
        """Modules of the answers."""
        yield from super().watched()
        for answer in models("Answer"):
            yield Path(inspect.getfile(answer))

    def lines(self) -> Iterator[str]:
        """Its first line and its fields."""
        for answer in models("Answer"):
            if answer.__name__ != "Assessment":  # has a page of its own
                yield f"## {answer.__name__}"
                yield ""
                yield _prose(inspect.getdoc(answer) or "")
                yield from _object(answer)


def _object(answer: Any) -> Iterator[str]:
    """Fields of an object, and of the objects within it."""
    schema = answer.json_schema()
    parts = schema.get("$defs", {})
    whole = answer.__name__.lower()
    yield from _properties(schema, parts, whole)
    for name, part in parts.items():
        if "properties" in part:
            yield f"({_anchor(whole, name)})="
            yield f"### {name}"
            yield ""
            yield _prose(part.get("description", ""))
            yield from _properties(part, parts, whole)


def _anchor(whole: str, name: str) -> str:
    return f"answer-{whole}-{name.lower()}"


def _properties(schema: dict[str, Any], parts: dict[str, Any], whole: str) -> Iterator[str]:
    rows = [
        [code(name), _kind(part, parts, whole), _prose(part.get("description", ""))]
        for name, part in schema["properties"].items()
    ]
    yield from table(["field", "type", "meaning"], rows)


def _prose(text: str) -> str:
    return " ".join(text.split()).replace("<", "\\<").replace("*", "\\*")


def _kind(part: dict[str, Any], parts: dict[str, Any], whole: str) -> str:
    """Type of a JSON value in words."""

    def kind(inner: dict[str, Any]) -> str:
        return _kind(inner, parts, whole)

    if "$ref" in part:
        name = part["$ref"].rpartition("/")[2]
        known = parts[name]
        return f"[{name}](#{_anchor(whole, name)})" if "properties" in known else kind(known)
    for several in ("anyOf", "oneOf"):
        if several in part:
            return " or ".join(map(kind, part[several]))
    if "const" in part:
        return code(f'"{part["const"]}"')
    if "enum" in part:
        return " or ".join(code(f'"{word}"') for word in part["enum"])
    if part["type"] == "array" and "prefixItems" in part:
        return "[" + ", ".join(map(kind, part["prefixItems"])) + "]"
    if part["type"] == "array":
        return f"list of {kind(part['items'])}"
    if part["type"] == "object" and isinstance(part.get("additionalProperties"), dict):
        return f"object of {kind(part['additionalProperties'])}"
    return str(part["type"])


class Symbols(Written):
    """``{formulas} kaidan.mechanics.slipping``: functions of a module and what they state."""

    required_arguments = 1
    optional_arguments = 0

    def watched(self) -> Iterator[Path]:
        """The module."""
        yield from super().watched()
        yield Path(inspect.getfile(import_module(self.arguments[0])))

    def lines(self) -> Iterator[str]:
        """One row a function: name, equation, reference."""
        module = import_module(self.arguments[0])
        rows = []
        for name, formula in vars(module).items():
            if (
                name.startswith("_")
                or not inspect.isfunction(formula)
                or formula.__module__ != module.__name__
            ):
                continue
            text = inspect.getdoc(formula) or ""
            reference = re.search(r"References\n-+\n(.*)", text, re.DOTALL)
            told = " ".join((reference.group(1) if reference else "").split())
            rows.append(
                [
                    f"{{py:func}}`~{module.__name__}.{name}`",
                    text.split("\n\n")[0].replace("\n", " "),
                    _origin(told),
                ]
            )
        yield from table(["function", "what it is", "where from"], rows)


def _origin(reference: str) -> str:
    """Equation numbers of a reference, or that it is derived."""
    derived = re.match(r"Derived|Hand|IEEE", reference)
    found = re.search(r"Eqs?\. (\([^.;:]*\))", reference)
    if derived:
        return "D"
    if found:
        rest = " + D" if "erived" in reference else ""
        return f"Eq. {found.group(1)}" + rest
    return reference.split(",")[0]


class LatestFigures:
    """Scraper for sphinx-gallery: figures of `kaidan.figures`, which are not made by pyplot.

    Those of pyplot are left to its own scraper, which must come after this one.
    """

    def __repr__(self) -> str:
        return "LatestFigures"

    def __call__(self, block: Any, block_vars: dict[str, Any], gallery_conf: Any) -> str:
        """Save the figures that a block has bound to names, each once."""
        from matplotlib import pyplot
        from matplotlib.figure import Figure
        from sphinx_gallery.scrapers import figure_rst

        known = block_vars["example_globals"].setdefault("__shown__", set())
        known |= {id(pyplot.figure(number)) for number in pyplot.get_fignums()}
        written = []
        for value in list(block_vars["example_globals"].values()):
            if isinstance(value, Figure) and id(value) not in known:
                known.add(id(value))
                path = next(block_vars["image_path_iterator"])
                value.savefig(path, dpi=130)
                written.append(path)
        return figure_rst(written, gallery_conf["src_dir"])


_BARS = re.compile(r"(``[^`]*``)|\|(\w+)\|")


def escape_bars(
    app: Sphinx, what: str, name: str, obj: Any, options: Any, lines: list[str]
) -> None:
    """Keep ``|a|`` of a docstring a modulus: reStructuredText takes it for a substitution."""
    lines[:] = [
        _BARS.sub(lambda found: found.group(1) or f"\\|{found.group(2)}\\|", line) for line in lines
    ]


def public_name(app: Sphinx, env: Any, node: Any, contnode: Any) -> Any:
    """Reference to the public name of something that a docstring names by its module."""
    import kaidan

    name = node.get("reftarget", "").rpartition(".")[2]
    if node.get("refdomain") != "py" or name not in kaidan.__all__:
        return None
    python = env.get_domain("py")
    at = node.get("refdoc", "")
    return python.resolve_xref(env, at, app.builder, "obj", f"kaidan.{name}", node, contnode)


def setup(app: Sphinx) -> dict[str, Any]:
    """Register the directives."""
    app.add_directive("catalogue", Catalogue)
    app.add_directive("overview", Overview)
    app.add_directive("gross-robots", Gross)
    app.add_directive("public-outcomes", PublicOutcomes)
    app.add_directive("sheet", SheetFields)
    app.add_directive("commands", Commands)
    app.add_directive("answer", Answer)
    app.add_directive("answers", Answers)
    app.add_directive("formulas", Symbols)
    app.connect("autodoc-process-docstring", escape_bars)
    app.connect("missing-reference", public_name)
    return {"parallel_read_safe": True, "parallel_write_safe": True}

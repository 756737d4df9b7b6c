"""A building model read in a process of its own: run as a script, never imported by kaidan.

The parser is native code, and a malformed model can crash it or make it endless. So it runs apart,
within bounds of time and memory, and says what it found on its output: one line of JSON, then the
arrays. It imports nothing of kaidan, so that it starts quickly.
"""

import gc
import json
import os
import re
import sys
from collections.abc import Iterator
from typing import Any

MEMORY = "KAIDAN_IFC_MEMORY"
"""Variable with the bytes of memory that it may take."""
MANY = 1000
"""Elements from which several threads save more than they cost."""
STAIRS = ("IfcStair", "IfcStairFlight", "IfcRamp", "IfcRampFlight")
TRANSPORT = "IfcTransportElement"
LEVELS = ("IfcSlab",)
ROUND = ("IfcWall", "IfcColumn", "IfcBeam", "IfcRoof", "IfcCovering", "IfcDoor", "IfcCurtainWall")
"""What limits width, headroom and landings."""
UNNAMED = ("IfcBuildingElementProxy", "IfcBuiltElement", "IfcMember", "IfcPlate", "IfcFooting")
"""What stairs are drawn as where the program knows none."""
LIKE_STAIRS = re.compile(
    r"stair|step|trap|trepp|stiege|escal|scal[ae]|trap+e|schod|lestn|лестн|ступен|階段|楼梯|계단|merdiven"
    r"|porras|trappa",
    re.IGNORECASE,
)
"""Names of stairs in the languages of most models."""
_ALONE = r"(?<![^\W_])(?:{})(?![^\W_])"
CALLED = {
    kind: re.compile(f"{parts}|{_ALONE.format(words)}", re.IGNORECASE)
    for kind, parts, words in (
        (
            "escalator",
            r"escalator|rolltreppe|fahrtreppe|roltrap|rulltrapp|эскалатор|エスカレータ|扶梯|에스컬레이터",
            r"escalera\W+mec.*|scala\W+mobile|escalier\W+(?:m[eé]canique|roulant)",
        ),
        (
            "moving walk",
            r"travelator|moving\W*walk|fahrsteig|rollsteig|動く歩道|自动人行道",
            r"trottoir\W+roulant",
        ),
        (
            "lift",
            r"elevator|aufzug|fahrstuhl|ascen[sc]|výtah|лифт|エレベータ|昇降機|电梯|電梯|엘리베이터",
            r"lifts?|hissi?",
        ),
        (
            "ramp",
            r"hellingbaan|pochyln|пандус|スロープ|斜路|坡道|경사로",
            r"ramp(?!art)\w*|rampa|rampe",
        ),
        (
            "stair",
            r"stair|trepp|stiege|escalier|escal(?:er|ad)|schod|lestn|лестн|階段|楼梯|계단|merdiven",
            r"scal[ae]|trap(?:pen?|pa)?|escada|porras\w*",
        ),
    )
}
"""What the name of an element makes of it, the first that fits: an escalator is called stairs too.
Short words must stand alone, as in "Lift 1" and no "uplift"."""
BY_NAME = {
    "IfcBuildingElementProxy": tuple(CALLED),
    "IfcBuiltElement": tuple(CALLED),
    "IfcElementAssembly": tuple(CALLED),
    "IfcSlab": ("ramp",),
    "IfcStair": ("escalator", "moving walk"),
    "IfcStairFlight": ("escalator", "moving walk"),
    TRANSPORT: ("escalator", "moving walk", "lift"),
}
"""Which names count for which elements."""
BY_CATEGORY = {
    "IfcStair": "stair",
    "IfcStairFlight": "flight",
    "IfcRamp": "ramp",
    "IfcRampFlight": "ramp flight",
    TRANSPORT: "transport element",
}
BY_TYPE = {"ELEVATOR": "lift", "ESCALATOR": "escalator", "MOVINGWALKWAY": "moving walk"}
MOVING = {"transport element", *BY_TYPE.values()}
"""Kinds of what nobody drives on, which is named and not tessellated."""


def main(path: str) -> None:
    """Read a model and write what was found."""
    _bound_memory()
    import ifcopenshell
    import ifcopenshell.util.element
    import ifcopenshell.util.unit

    model: Any = ifcopenshell.open(path, format=".ifc")
    wanted = {each.id(): each for each in _wanted(model)}
    if not wanted:
        _write({"schema": model.schema, "storeys": _storeys(model), "bodies": []}, [])
        return
    kinds = {key: _kind(each) for key, each in wanted.items()}
    shapes = _shapes(model, [each for key, each in wanted.items() if kinds[key] not in MOVING])
    bodies = [_body(each, kinds[key], key in shapes) for key, each in wanted.items()]
    found = {
        "schema": model.schema,
        "unit": ifcopenshell.util.unit.calculate_unit_scale(model),
        "storeys": _storeys(model),
        "bodies": bodies,
    }
    _write(found, [array for key in wanted if key in shapes for array in shapes[key]])


def _bound_memory() -> None:
    if MEMORY in os.environ:
        try:
            import resource
        except ImportError:  # Windows
            return
        bytes_ = int(os.environ[MEMORY])
        outer = resource.getrlimit(resource.RLIMIT_AS)[1]
        if outer != resource.RLIM_INFINITY:  # of a process that is bound already
            bytes_ = min(bytes_, outer)
        resource.setrlimit(resource.RLIMIT_AS, (bytes_, bytes_))


def _wanted(model: Any) -> Iterator[Any]:
    """Elements that are stairs or ramps or are called so, that carry them or limit them."""

    def of(*kinds: str) -> Iterator[Any]:
        for kind in kinds:
            try:
                yield from model.by_type(kind)
            except RuntimeError:  # not in this schema
                continue

    assemblies = [each for each in of("IfcElementAssembly") if _kind(each)]
    wholes = [*of(*STAIRS), *assemblies]
    for each in wholes:
        yield each
        yield from _parts(each)
    drawn_as_others = not any(_kind(each) in ("stair", "flight") for each in wholes)
    yield from of(*LEVELS, "IfcRailing", TRANSPORT)
    for each in of(*UNNAMED):
        if drawn_as_others or _kind(each) or LIKE_STAIRS.search(_called(each)):
            yield each
    yield from of(*ROUND)


def _called(element: Any) -> str:
    """Its name, and what its author calls its type."""
    import ifcopenshell.util.element as elements

    kind = elements.get_type(element)
    of_type = "" if kind is None else _text(kind.Name)
    return f"{_text(element.Name)} {_text(element.ObjectType)} {of_type}"


def _category(element: Any) -> str:
    """What the schema calls an element, however its parts are put together."""
    name: str = element.is_a()
    return name.removesuffix("StandardCase").removesuffix("ElementedCase")


def _kind(element: Any) -> str:
    """What an element is for going up: stair, flight, ramp, lift and so on; empty: none of them."""
    import ifcopenshell.util.element as elements

    category = _category(element)
    if category == TRANSPORT:
        stated = elements.get_predefined_type(element) or ""
        word = BY_TYPE.get(stated) or BY_TYPE.get(getattr(element, "OperationType", None) or "")
        if word:
            return word
    if category in BY_NAME:
        name = _called(element)
        for kind in BY_NAME[category]:
            if CALLED[kind].search(name):
                return kind
    return BY_CATEGORY.get(category, "")


def _parts(element: Any) -> list[Any]:
    """What an element is made of, and what that is made of, each once."""
    found: dict[int, Any] = {}
    left = [element]
    while left:
        for link in left.pop().IsDecomposedBy:
            for each in link.RelatedObjects:
                if each.id() not in found and each.is_a("IfcElement"):
                    found[each.id()] = each
                    left.append(each)
    return list(found.values())


def _shapes(model: Any, wanted: list[Any]) -> dict[int, tuple[Any, Any]]:
    """Vertices and triangles of each element, in metres in the world's frame."""
    import ifcopenshell.geom
    import numpy as np

    settings = ifcopenshell.geom.settings()
    settings.set("use-world-coords", True)
    settings.set("no-normals", True)
    settings.set("apply-default-materials", False)
    drawn = [each for each in wanted if getattr(each, "Representation", None)]
    found: dict[int, tuple[Any, Any]] = {}
    if not drawn:
        return found
    threads = min(os.cpu_count() or 1, 4) if len(drawn) > MANY else 1
    iterator = ifcopenshell.geom.iterator(settings, model, threads, include=drawn)
    if not iterator.initialize():
        return found
    while True:
        shape = iterator.get()
        vertices = np.frombuffer(shape.geometry.verts_buffer, dtype=np.float64)
        faces = np.frombuffer(shape.geometry.faces_buffer, dtype=np.int32)
        if len(faces):
            found[shape.id] = (vertices.copy(), faces.astype(np.int32))
        if not iterator.next():
            return found


def _body(element: Any, kind: str, has_shape: bool) -> dict[str, Any]:
    import ifcopenshell.util.element as elements

    parent = elements.get_aggregate(element)
    storey = elements.get_container(element, ifc_class="IfcBuildingStorey")
    represented = getattr(element, "Representation", None) is not None
    facts: dict[str, Any] = {"step": element.id(), "kind": kind, "represented": represented}
    if kind or _category(element) in ("IfcBuildingElementProxy", "IfcSlab"):
        facts["stated"] = _stated(element)
    if element.is_a("IfcDoor"):
        facts["door"] = [element.OverallWidth, element.OverallHeight]
        facts["operation"] = _operation(element)
        facts["opens"] = _opens(element)
    return {
        "id": _identity(element),
        "name": _text(element.Name),
        "category": _category(element),
        "type": _text(elements.get_predefined_type(element)),
        "parent": _identity(parent) if parent is not None and parent.is_a("IfcElement") else "",
        "storey": _identity(storey) if storey is not None else "",
        "shape": has_shape,
        "facts": facts,
    }


def _identity(element: Any) -> str:
    """GlobalId, which a damaged model may give as a number or a list."""
    if not isinstance(element.GlobalId, str):
        raise TypeError(f"the GlobalId of #{element.id()} is no text")
    return element.GlobalId


def _text(value: Any) -> str:
    return value if isinstance(value, str) else ""


def _operation(door: Any) -> str:
    """How a door opens: its own word, else that of its type or style; empty: not stated."""
    import ifcopenshell.util.element as elements

    for each in (door, elements.get_type(door)):
        word = getattr(each, "OperationType", None)
        if word and word not in ("NOTDEFINED", "USERDEFINED"):
            return str(word)
    return ""


def _opens(door: Any) -> list[float]:
    """Direction in the plan in which its leaf opens: y of its placement, as the schema has it."""
    import ifcopenshell.util.placement as placement

    if door.ObjectPlacement is None:
        return [0.0, 1.0]
    return [float(each) for each in placement.get_local_placement(door.ObjectPlacement)[:2, 1]]


def _stated(element: Any) -> dict[str, Any]:
    """Numbers of attributes and property sets, by their place."""
    import ifcopenshell.util.element as elements

    found: dict[str, Any] = {}
    for name, value in element.get_info(recursive=False).items():
        if isinstance(value, int | float) and not isinstance(value, bool) and name != "id":
            found[name] = value
    for group, values in elements.get_psets(element).items():
        for name, value in values.items():
            if isinstance(value, int | float) and not isinstance(value, bool) and name != "id":
                found[f"{group}.{name}"] = value
    return found


def _storeys(model: Any) -> list[dict[str, Any]]:
    import ifcopenshell.util.placement
    import ifcopenshell.util.unit

    scale = ifcopenshell.util.unit.calculate_unit_scale(model)
    found = []
    for each in model.by_type("IfcBuildingStorey"):
        level = ifcopenshell.util.placement.get_local_placement(each.ObjectPlacement)[2, 3]
        row = {"id": _identity(each), "name": _text(each.Name), "level": float(level) * scale}
        found.append(row)
    return found


def _said(error: Exception) -> str:
    """What the parser says, with the place from its log where it has one."""
    text = str(error)
    if "check logs" not in text:
        return text
    import ifcopenshell

    lines = [each for each in ifcopenshell.get_log().splitlines() if "[error]" in each]
    return lines[0].rpartition("] ")[2] if lines else text


def _write(found: dict[str, Any], arrays: list[Any]) -> None:
    """One line of JSON, then the arrays one after another; their lengths stand in the line."""
    found["lengths"] = [len(each) for each in arrays]
    out = sys.stdout.buffer
    out.write(json.dumps(found, allow_nan=True).encode() + b"\n")
    for each in arrays:
        out.write(each.tobytes())
    out.flush()


if __name__ == "__main__":
    gc.disable()  # it ends soon, and what it makes holds on to itself nowhere
    try:
        main(sys.argv[1])
    except ImportError:
        sys.exit(4)
    except (MemoryError, RecursionError) as error:
        sys.stderr.write(f"KAIDAN {type(error).__name__}\n")
        sys.exit(3)
    except (AttributeError, TypeError, ValueError, KeyError) as error:
        said = " ".join(str(error).split())[:200]
        sys.stderr.write(f"KAIDAN an element is not as the schema has it ({said})\n")
        sys.exit(3)
    except Exception as error:
        sys.stderr.write("KAIDAN " + " ".join(_said(error).split())[:300] + "\n")
        sys.exit(3)

"""Names of the source that no command, verb or page reaches: ``python tests/rules/unreached.py``.

What runs when somebody asks is followed from the entry points, definition by definition: a name in
a body leads to what it stands for, through imports and re-exports; an attribute of what is no
module leads to every method and field of that name. What is loaded by the name of its module
(commands, models, formats, texts) is an entry point too. Nothing here is run or imported.
"""

import ast
import re
from collections import defaultdict
from functools import cache
from pathlib import Path

ROOT = Path(__file__).parents[2]
SOURCE = ROOT / "src"
BY_MODULE = ("register", "judge", "text", "read", "main", "run", "found")
"""Functions that are called in a module whose name is computed."""
KERNEL = "kaidan.contact.kernel"
"""Package whose entries are called by their names alone, whichever kernel is in use."""
GUIDES = ("README.md", "docs/*.md", "docs/lab/*.md", "docs/examples/*.py", "ros/**/*.py")
"""What people read who use kaidan from Python: derivations and lists of functions are none."""
LISTED = ("docs/api/*.md", "docs/lab/api/*.md")
"""Lists of the API, of which members of public classes count that are named there."""
PURE = {"cache", "cached_property", "property", "classmethod", "staticmethod", "lru_cache",
        "contextmanager", "abstractmethod", "overload", "dataclass", "override",
        "total_ordering", "entry", "frozen"}  # fmt: skip
"""Decorators that do not hand a function to anybody."""
FILLED = {"Part", "Answer", "Sheet", "BaseModel", "Exception", "StrEnum", "IntEnum", "Enum",
          "Protocol", "TypedDict", "Event"}  # fmt: skip
"""Classes whose fields are read as JSON, as members, or by others."""
UNSEEN = ("_HOME", "_", "TYPE_CHECKING")
"""Names that mean something to Python or to this reading alone."""


class Module:
    """One file: its definitions, what its names stand for, what runs when it is imported."""

    def __init__(self, name, path):
        self.name, self.tree = name, ast.parse(path.read_text())
        self.defined, self.names, self.body = {}, defaultdict(set), []
        for node in ast.walk(self.tree):
            for named, stands_for in _imported(node):
                self.names[named].add(stands_for)
        for node in self.tree.body:
            self._define(node)

    def _define(self, node):
        if isinstance(node, ast.FunctionDef | ast.ClassDef):
            self.defined[node.name] = node
        elif isinstance(node, ast.Assign | ast.AnnAssign):
            targets = node.targets if isinstance(node, ast.Assign) else [node.target]
            named = [each.id for one in targets for each in ast.walk(one)
                     if isinstance(each, ast.Name)]  # fmt: skip
            self.defined |= dict.fromkeys(named, node)
        elif isinstance(node, ast.If) and "TYPE_CHECKING" in ast.unparse(node.test):
            return
        elif isinstance(node, ast.If | ast.Try | ast.With):
            for each in ast.iter_child_nodes(node):
                self._define(each)
        elif not isinstance(node, ast.Import | ast.ImportFrom):
            self.body.append(node)


class Reach:
    """What is reached: modules, names by module, members by module and class."""

    def __init__(self):
        self.modules, self.names, self.attributes = set(), set(), set()
        self.members, self.waiting, self.entries = set(), defaultdict(list), {}
        self.loaded, self.words, self.todo = set(), set(), []
        """Modules that are imported by their names, and words that may name a function of one."""

    def start(self):
        """Follow everything from the entry points."""
        for text in _texts(GUIDES):
            self.attributes |= set(re.findall(r"\.(\w+)", text))
            for module, names in re.findall(r"from (kaidan[\w.]*) import ([\w, ]+)", text):
                for name in re.findall(r"\w+", names):
                    self.name(module, name)
        for text in _texts(LISTED):
            self.attributes |= set(re.findall(r"auto(?:property|method):: (\w+)", text))
            for members in re.findall(r":members: (.+)", text):
                self.attributes |= set(re.findall(r"\w+", members))
        self.name("kaidan.__main__", "main")
        for name, module in modules().items():
            if name.startswith(KERNEL + "."):
                self.module(name)
                for each, node in module.defined.items():
                    if "entry" in map(ast.unparse, getattr(node, "decorator_list", ())):
                        self.entries[each] = name
        for package in ("kaidan", "kaidan.lab"):
            for name in ast.literal_eval(modules()[package].defined["__all__"].value):
                self.name(package, name)
        while self.todo:
            self.follow(*self.todo.pop())
        return self

    def module(self, name):
        """A module that is imported: what it does then."""
        if name not in modules() or name in self.modules:
            return
        self.modules.add(name)
        self.module(name.rpartition(".")[0])
        module = modules()[name]
        self.todo += [(module, node) for node in module.body]
        for node in module.tree.body:
            for _, (origin, _) in _imported(node):
                self.module(origin)
        for each, node in module.defined.items():
            if each.startswith("__") or (isinstance(node, ast.FunctionDef) and _handed_over(node)):
                self.name(name, each)

    def name(self, module, name):
        """A name of a module, through its imports."""
        if module not in modules() or (module, name) in self.names:
            return
        self.module(module)
        self.module(f"{module}.{name}")
        self.names.add((module, name))
        found = modules()[module]
        if name in found.defined:
            node = found.defined[name]
            if isinstance(node, ast.ClassDef):
                self.of_class(found, node)
            else:
                self.todo.append((found, node))
            return
        self.imported(found, name)
        home = found.defined.get("_HOME")  # public names that are imported when first used
        place = ast.literal_eval(home.value).get(name) if home is not None else None
        if place:
            self.name(f"{module}.{place}", name)

    def imported(self, module, name):
        """What a name stands for that a module imports."""
        for origin, member in module.names.get(name, ()):
            if member is None:
                self.module(origin)
            else:
                self.name(origin, member)

    def of_class(self, module, node):
        """A class: its bases, its fields, and those methods that somebody calls."""
        self.todo += [(module, each) for each in (*node.bases, *node.keywords)]
        self.todo += [(module, each) for each in node.decorator_list]
        called_by_others = _derived_outside(module, node)
        for each in node.body:
            named = _member(each)
            if not isinstance(each, ast.FunctionDef):
                self.todo.append((module, each))
            elif (
                called_by_others
                or named.endswith("_")
                or _handed_over(each)
                or named in self.attributes
            ):
                self.member(module, node, named, each)
            else:
                self.waiting[named].append((module, node, named, each))

    def asked_for(self, name):
        """Whether Python or somebody here asks for an attribute."""
        return name.endswith("_") or name in self.attributes

    def member(self, module, owner, name, node):
        """A method of a class."""
        if (module.name, owner.name, name) not in self.members:
            self.members.add((module.name, owner.name, name))
            self.todo.append((module, node))

    def attribute(self, name):
        """An attribute of an object of some class."""
        self.attributes.add(name)
        for each in self.waiting.pop(name, ()):
            self.member(*each)
        if name in self.entries:
            self.name(self.entries.pop(name), name)

    def follow(self, module, node):
        """What a piece of code leads to."""
        for each in ast.walk(node):
            if isinstance(each, ast.ImportFrom | ast.Import):
                for _, (origin, _) in _imported(each):
                    self.module(origin)
            elif isinstance(each, ast.Name) and isinstance(each.ctx, ast.Load):
                self.used(module, each.id)
            elif isinstance(each, ast.Attribute):
                self.of_module(module, each)
                self.attribute(each.attr)
            elif isinstance(each, ast.keyword) and each.arg:
                self.attribute(each.arg)
            elif isinstance(each, ast.Constant) and isinstance(each.value, str):
                self.said(module, each.value)
            elif isinstance(each, ast.JoinedStr):
                self.computed(each)

    def used(self, module, name):
        """A name in the code of a module."""
        if name in module.defined:
            self.name(module.name, name)
        else:
            self.imported(module, name)

    def of_module(self, module, node):
        """An attribute of an imported module."""
        first, *rest = ast.unparse(node).split(".")
        for origin, member in module.names.get(first, ()):
            place = origin if member is None else f"{origin}.{member}"
            for each in rest[origin.count(".") :] if member is None else rest:
                self.name(place, each)
                place = f"{place}.{each}"

    def said(self, module, text):
        """A text that names a module, a function of one, an attribute, or a type."""
        place, _, name = text.partition(":")
        if place in modules():
            self.by_module(place)
            self.name(place, name)
        elif place.isidentifier() and name.isidentifier():  # of a module whose package is computed
            for each in modules():
                if each.endswith(f".{place}"):
                    self.name(each, name)
        elif text.isidentifier():
            self.attribute(text)
            self.words.add(text)
            self.used(module, text)  # a type, in quotes
            for each in self.loaded:
                if text in modules()[each].defined:
                    self.name(each, text)
            for origin, member in set().union(*module.names.values()):
                if text in getattr(modules().get(f"{origin}.{member}"), "defined", ()):
                    self.name(f"{origin}.{member}", text)
        elif "[" in text and len(text) < 80:  # a type, in quotes
            for each in re.findall(r"\w+", text):
                self.used(module, each)

    def computed(self, node):
        """The name of a module that is put together: any of its package."""
        first = node.values[0]
        if isinstance(first, ast.Constant) and str(first.value).startswith("kaidan."):
            package = str(first.value).rpartition(".")[0]
            for name in modules():
                if name.startswith(package + "."):
                    self.by_module(name)

    def by_module(self, name):
        """A module that is imported by its name."""
        self.module(name)
        self.loaded.add(name)
        for each in modules()[name].defined:
            if each in BY_MODULE or each in self.words:
                self.name(name, each)


@cache
def modules():
    """All files of the source by name."""
    found = {}
    for path in sorted((SOURCE / "kaidan").rglob("*.py")):
        parts = path.relative_to(SOURCE).with_suffix("").parts
        name = ".".join(parts[:-1] if parts[-1] == "__init__" else parts)
        found[name] = Module(name, path)
    return found


def _imported(node):
    """Names that an import makes, each with the module and the name in it, None for itself."""
    if isinstance(node, ast.ImportFrom) and node.module:
        for each in node.names:
            yield each.asname or each.name, (node.module, each.name)
    elif isinstance(node, ast.Import):
        for each in node.names:
            yield each.asname or each.name.partition(".")[0], (each.name, None)


def _texts(patterns):
    return [path.read_text() for pattern in patterns for path in sorted(ROOT.glob(pattern))]


def _derived_outside(module, node):
    """Whether a class is derived from one of others, who call its methods."""
    return any(
        not origin.startswith("kaidan") and base not in FILLED | {"NamedTuple", "ABC"}
        for base in map(ast.unparse, node.bases)
        for origin, _ in module.names.get(base.partition(".")[0], ())
    )


def _member(node):
    if isinstance(node, ast.FunctionDef):
        return node.name
    if isinstance(node, ast.AnnAssign) and isinstance(node.target, ast.Name):
        return node.target.id
    return None


def _handed_over(node):
    """Whether a decorator hands a function to somebody who calls it."""
    for each in node.decorator_list:
        call = each.func if isinstance(each, ast.Call) else each
        name = call.attr if isinstance(call, ast.Attribute) else getattr(call, "id", "")
        if name not in PURE:
            return True
    return False


def unreached():
    """Modules, definitions and members that nothing reaches, as dotted names."""
    reach = Reach().start()
    found = []
    for name, module in modules().items():
        if name not in reach.modules and (module.defined or module.body):
            found.append(name)
            continue
        for each, node in module.defined.items():
            if each.startswith("__") or each in UNSEEN:
                continue
            if (name, each) not in reach.names:
                found.append(f"{name}.{each}")
            elif isinstance(node, ast.ClassDef):
                found += _members(reach, name, node)
    return sorted(set(found))


def _members(reach, module, node):
    """Fields that no attribute names, and methods that nobody calls."""
    filled = {ast.unparse(each).rpartition(".")[2] for each in node.bases} & FILLED
    for each in node.body:
        named = _member(each)
        if isinstance(each, ast.FunctionDef):
            unseen = (module, node.name, named) not in reach.members
        else:
            unseen = named is not None and not filled and named not in reach.attributes
        if unseen and not named.endswith("_"):
            yield f"{module}.{node.name}.{named}"


if __name__ == "__main__":
    print("\n".join(unreached()))

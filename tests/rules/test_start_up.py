"""Short commands import no heavy library: what is not needed is not paid for."""

import json
import subprocess
import sys
from functools import cache

import pytest

HEAVY = ("scipy", "xarray", "matplotlib", "pandas", "numba", "llvmlite", "PIL", "mujoco", "pyarrow")
"""scipy.optimize alone costs four times what `import numpy, pydantic` does."""

RUN = """
import json, sys
from kaidan.cli import run
code = run(sys.argv[1:])
print(json.dumps([code, sorted(sys.modules)]), file=sys.stderr)
"""

ASSESS = ["assess", "absolem", "ibc", "--flippers", "flat", "--surface", "concrete-dry"]


@cache
def imported(code, *words):
    """Exit code and modules of a new process."""
    done = subprocess.run(
        [sys.executable, "-c", code, *words], capture_output=True, text=True, timeout=60, check=True
    )
    return json.loads(done.stderr.splitlines()[-1])


def heavy(modules):
    return sorted({name.partition(".")[0] for name in modules} & set(HEAVY))


SHORT = {
    ("--help",): 0,
    ("--version",): 0,
    ("assess", "--help"): 0,
    (*ASSESS, "--model", "closed-form"): 5,
    (*ASSESS, "--json", "--uncertainty", "com_height=5mm"): 5,
    ("assess", "kenaf", "ibc"): 1,
    ("assess", "kenaf", "ibc", "--model", "closed-form"): 3,
    ("assess", "kenaf", "nowhere"): 2,
    ("schema", "answer"): 0,
}
"""Short commands by their exit codes."""

RUN_EACH = """
import json, sys
from kaidan.cli import run
codes, modules = [], []
for words in json.loads(sys.argv[1]):
    codes.append(run(words))
    modules.append(sorted(sys.modules))
print(json.dumps([codes, modules]), file=sys.stderr)
"""


def test_short_commands_import_nothing_heavy():
    """One after another in one process: what any of them imports is there at the end."""
    codes, modules = imported(RUN_EACH, json.dumps(list(SHORT)))
    found = {
        words: (code, heavy(names))
        for words, code, names in zip(SHORT, codes, modules, strict=True)
    }
    assert found == {words: (code, []) for words, code in SHORT.items()}


def test_help_does_not_even_need_numpy():
    modules = imported(RUN, "--help")[1]
    assert "numpy" not in modules
    assert "pydantic" not in modules


def test_importing_kaidan_imports_no_more_than_its_names():
    code = "import json, sys, kaidan; print(json.dumps([0, sorted(sys.modules)]), file=sys.stderr)"
    modules = imported(code)[1]
    assert [name for name in modules if name.startswith("kaidan")] == ["kaidan", "kaidan.lazy"]
    assert "numpy" not in modules


def test_a_process_of_a_campaign_imports_what_it_does_and_no_more():
    code = (
        "import json, sys, kaidan.work.local\n"
        "print(json.dumps([0, sorted(sys.modules)]), file=sys.stderr)"
    )
    modules = imported(code)[1]
    assert "kaidan.work.job" in modules
    assert {"numpy", "pydantic"}.isdisjoint(modules)


def test_a_question_from_python_imports_nothing_heavy():
    code = (
        "import json, sys, kaidan\n"
        "kaidan.assess('kenaf', 'ibc', friction=1.0)\n"
        "print(json.dumps([0, sorted(sys.modules)]), file=sys.stderr)"
    )
    assert heavy(imported(code)[1]) == []


def test_every_public_name_is_there():
    import kaidan
    from kaidan import work

    for name in kaidan.__all__:
        assert getattr(kaidan, name) is not None
    for name in work.__all__:
        assert getattr(work, name) is not None
    assert dir(kaidan) == sorted(kaidan.__all__)
    for each in (kaidan, work):
        with pytest.raises(
            AttributeError, match=f"module '{each.__name__}' has no attribute 'luck'"
        ):
            _ = each.luck


def test_every_command_is_found_by_its_name():
    """A command line loads the module of its command alone: none may be missing from the map."""
    import typer

    from kaidan import cli

    known = {name for commands in cli._COMMANDS.values() for name in commands}
    assert set(typer.main.get_command(cli.app_for(())).commands) == known
    for name in known:
        assert name in typer.main.get_command(cli.app_for([name])).commands


FIGURES = {
    "closed_form_figures",
    "contact_figures",
    "dynamic_figures",
    "landing_figures",
    "support_polygon",
    "traction_figures",
}
"""Modules of `kaidan.models` with figures of an answer: pydantic makes classes of each."""


def figures(modules):
    found = {name.removeprefix("kaidan.models.") for name in modules}
    return found & FIGURES


def test_a_question_to_the_closed_form_loads_no_contact_model():
    modules = imported(RUN, *ASSESS, "--model", "closed-form")[1]
    assert "kaidan.models.closed_form" in modules
    for name in ("kaidan.contact", "kaidan.traversal", "kaidan.physics", "kaidan.models.spread"):
        assert name not in modules
    assert figures(modules) == {"closed_form_figures"}


def test_a_question_to_the_contact_model_loads_no_figures_of_others():
    modules = imported(RUN, *ASSESS)[1]
    assert figures(modules) == {"contact_figures", "support_polygon", "traction_figures"}


def test_a_command_loads_its_own_module_alone():
    modules = imported(RUN, "robots")[1]
    assert "kaidan.cli.catalogs" in modules
    assert "kaidan.lab.cli.physics" not in modules

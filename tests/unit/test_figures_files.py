"""Files whole or not at all, the same bytes every time."""

import json
import math
import os
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from kaidan import files
from kaidan.errors import InputError
from kaidan.figures import saving
from kaidan.figures import style as look


def small_figure():
    with look.settings():
        figure = look.blank(1.0, 2.0)
        figure.add_axes((0.2, 0.3, 0.7, 0.6)).plot([0, 1], [0, 1])
    return figure


@pytest.mark.parametrize(
    ("name", "form"), [("a.png", "png"), ("a.SVG", "svg"), ("x/b.c.pdf", "pdf")]
)
def test_the_suffix_names_the_format(name, form):
    assert saving.figure_format(Path(name)) == form


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("a.jpg", "figure 'a.jpg': unknown suffix '.jpg'; known: .png, .svg, .pdf"),
        ("a", "figure 'a': no suffix; known: .png, .svg, .pdf"),
    ],
)
def test_other_suffixes_are_refused(name, text):
    with pytest.raises(InputError) as caught:
        saving.figure_format(Path(name))
    assert str(caught.value) == text


@pytest.mark.parametrize(
    ("form", "head"), [("png", b"\x89PNG\r\n\x1a\n"), ("svg", b"<?xml"), ("pdf", b"%PDF-")]
)
def test_figures_are_the_same_bytes_again_and_carry_no_date(form, head):
    one, other = (saving.figure_bytes(small_figure(), form) for _ in range(2))
    assert one == other
    assert one.startswith(head)
    assert b"Date" not in one.replace(b"%%DocumentData", b"")


def test_figures_are_the_same_in_another_process(tmp_path):
    code = (
        "import sys; from kaidan.cli import main;"
        "sys.argv = ['kaidan', 'margin', 'kenaf', '--figure', sys.argv[1]]; main()"
    )
    for name in ("a.svg", "b.svg"):
        environment = os.environ | {"PYTHONHASHSEED": str(ord(name[0]))}
        command = [sys.executable, "-c", code, str(tmp_path / name)]
        subprocess.run(command, check=True, env=environment, capture_output=True)
    assert (tmp_path / "a.svg").read_bytes() == (tmp_path / "b.svg").read_bytes()


def test_figures_do_not_depend_on_the_users_settings_nor_change_them(monkeypatch):
    import matplotlib as mpl

    plain = saving.figure_bytes(small_figure(), "svg")
    monkeypatch.setitem(mpl.rcParams, "axes.grid", True)
    monkeypatch.setitem(mpl.rcParams, "font.size", 20.0)
    assert saving.figure_bytes(small_figure(), "svg") == plain
    assert mpl.rcParams["font.size"] == 20.0


def test_json_has_null_for_what_is_no_number():
    text = files.json_text({"a": np.array([1.0, math.nan]), "b": (math.inf, "é")})
    assert json.loads(text) == {"a": [1.0, None], "b": [None, "é"]}
    assert text.isascii()


def test_csv_has_empty_fields_for_what_is_no_number():
    text = files.csv_text({"a": np.array([1.5, math.nan]), "b": ["x,y", None]})
    assert text == 'a,b\n1.5,"x,y"\n,\n'


@pytest.mark.parametrize("name", ["=cmd|' /C calc'!A0", "+1", "-x", "@SUM(1)", "\t=1", "-2+3"])
def test_a_text_that_a_spreadsheet_takes_for_a_formula_is_quoted(name):
    """What the spreadsheet shows begins with a quote; CSV then quotes commas as ever."""
    cell = files.csv_text({"robot": [name], "margin_deg": [-1.5]}).splitlines()[1]
    quoted = f"'{name}" if name != "+1" else name  # a number is one
    assert cell == f"{quoted},-1.5"


def test_numbers_and_angles_of_flippers_are_not_quoted():
    texts = ["-68deg,-20deg", "-5deg,flat/land:-60deg,-20deg", "-4.5deg+arm-out", "-0.5", "+2e-3"]
    text = files.csv_text({"flippers": texts})
    assert [each.strip('"') for each in text.splitlines()[1:]] == texts


@pytest.mark.skipif(os.name == "nt", reason="no modes there")
@pytest.mark.parametrize("mode", [0o600, 0o640, 0o444, 0o755])
def test_a_replaced_file_keeps_its_mode(tmp_path, mode):
    path = tmp_path / "a.csv"
    path.write_text("old")
    path.chmod(mode)
    files.write_all({path: "new"})
    assert path.read_text() == "new"
    assert path.stat().st_mode & 0o7777 == mode


def test_files_are_written_whole_with_ordinary_rights(tmp_path):
    path = tmp_path / "a.csv"
    path.write_text("old")
    files.write_all({path: "new é\n", tmp_path / "b.bin": b"\x00"})
    assert path.read_bytes() == "new é\n".encode()
    assert sorted(p.name for p in tmp_path.iterdir()) == ["a.csv", "b.bin"]
    plain = tmp_path / "plain"
    plain.write_text("")
    assert (tmp_path / "b.bin").stat().st_mode == plain.stat().st_mode


def test_a_failing_write_leaves_the_old_file_and_nothing_half(tmp_path, monkeypatch):
    path = tmp_path / "a.csv"
    path.write_text("old")

    def fail(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "replace", fail)
    with pytest.raises(InputError, match=r"a\.csv: cannot be written: No space left on device"):
        files.write_all({path: "new"})
    assert path.read_text() == "old"
    assert [p.name for p in tmp_path.iterdir()] == ["a.csv"]


def test_folders_that_are_not_there_or_in_the_way(tmp_path):
    with pytest.raises(InputError, match="cannot be written: No such file or directory"):
        files.write_all({tmp_path / "no" / "a.csv": "x"})
    with pytest.raises(InputError, match="cannot be written: not a file"):
        files.write_all({tmp_path: "x"})
    for odd in ("a\0b", "x" * 300, "\udce9/a"):
        with pytest.raises(InputError, match="cannot be written: "):
            files.write_all({tmp_path / odd: "x"})


def test_a_link_stays_a_link(tmp_path):
    real = tmp_path / "real.csv"
    real.write_text("old")
    link = tmp_path / "link.csv"
    link.symlink_to(real)
    files.write_all({link: "new"})
    assert link.is_symlink()
    assert real.read_text() == "new"


def test_a_name_as_long_as_the_system_allows(tmp_path):
    path = tmp_path / ("é" * 125 + ".csv")
    files.write_all({path: "x"})
    assert path.read_text() == "x"


def test_labels_keep_their_order_and_distance():
    rng = np.random.default_rng(1)
    for _ in range(200):
        wanted = rng.uniform(0, 1, rng.integers(1, 12)).tolist()
        places = look.spread(wanted, 0.07, 0.0, 1.0)
        ordered = [places[i] for i in np.argsort(wanted, kind="stable")]
        assert np.all(np.diff(ordered) >= 0.07 - 1e-12)  # rounding
        assert min(places) >= 0.0
        assert max(places) <= 1.0 + 1e-12
    assert look.spread([0.2, 0.8], 0.07, 0.0, 1.0) == pytest.approx([0.2, 0.8], abs=1e-15)


def test_a_name_stands_where_it_fits_or_not_at_all():
    inside = np.zeros((100, 100), dtype=bool)
    inside[60:90, 10:40] = True
    x, y = look.roomiest(inside, 0.1, 0.1)
    assert (x, y) == pytest.approx((0.25, 0.75), abs=0.02)  # two cells
    assert look.roomiest(inside, 0.31, 0.1) is None


def test_users_names_are_text_and_not_formulas():
    assert look.named("a$x_1$\x07") == "a\\$x_1\\$�"


def test_the_command_line_starts_without_what_only_figures_need():
    code = (
        "import sys, kaidan.cli;"
        "print({'matplotlib', 'xarray', 'numpy', 'scipy', 'pydantic'} & set(sys.modules))"
    )
    done = subprocess.run([sys.executable, "-c", code], check=True, capture_output=True, text=True)
    assert done.stdout == "set()\n"


def test_a_page_and_a_figure_need_no_scipy_nor_pyplot(tmp_path):
    code = (
        "import sys; from typer.testing import CliRunner; from kaidan.cli import app;"
        "done = CliRunner().invoke(app, ['plane', 'kenaf', '--angle', '44deg', "
        "'--nosing-spacing', '200mm', '--figure', sys.argv[1]]);"
        "print(done.exit_code, {'scipy', 'xarray', 'matplotlib.pyplot'} & set(sys.modules))"
    )
    command = [sys.executable, "-c", code, str(tmp_path / "p.svg")]
    done = subprocess.run(command, check=True, capture_output=True, text=True)
    assert done.stdout == "0 set()\n"

"""Picture of a traverse: the side view with chosen poses, and the margins along the path below."""

import textwrap
from typing import TYPE_CHECKING

from matplotlib.figure import Figure

from kaidan.figures import style as look
from kaidan.figures import traverse_side, traverse_strips
from kaidan.modes import Verdict
from kaidan.text import plan
from kaidan.text.words import subject

if TYPE_CHECKING:
    from kaidan.verbs.traverse_report import TraverseReport

_LEFT, _RIGHT, _FOOT = 0.78, 0.12, 0.42
_STRIP, _GAP = 0.92, 0.12


def traverse_figure(found: "TraverseReport", poses: int | None = None) -> Figure:
    """Side view with chosen poses, and inclination, energy margin and friction along the path.

    found: what `kaidan.traverse` answers.
    poses: number of poses to draw; as many as fit without it.
    """
    with look.settings():
        heads = _heads(found)
        top = 0.28 + 0.17 * len(heads)
        width = look.WIDTH - _LEFT - _RIGHT
        view = traverse_side.view_of(found, width)
        tall = width * (view[3] - view[2]) / (view[1] - view[0])
        height = top + tall + 0.1 + 3 * (_STRIP + _GAP) + _FOOT
        figure = look.blank(height)
        axes = figure.add_axes(
            (_LEFT / look.WIDTH, 1 - (top + tall) / height, width / look.WIDTH, tall / height)
        )
        axes.set_xlim(view[0], view[1])
        axes.set_ylim(view[2], view[3])
        traverse_side.draw_side(axes, found, poses)
        for index, draw in enumerate(traverse_strips.STRIPS):
            bottom = _FOOT + (2 - index) * (_STRIP + _GAP)
            strip = figure.add_axes(
                (_LEFT / look.WIDTH, bottom / height, width / look.WIDTH, _STRIP / height)
            )
            strip.set_xlim(view[0], view[1])
            traverse_strips.prepare(strip, found, named=index == 0)
            draw(strip, found)
            strip.yaxis.set_label_coords(-0.38 / width, 0.5)
            if index < 2:
                strip.tick_params(labelbottom=False)
            else:
                strip.set_xlabel("centroid along the path [m]")
        look.title(figure, _LEFT, heads[0])
        for index, line in enumerate(heads[1:]):
            figure.text(_LEFT / look.WIDTH, 1 - (0.37 + 0.15 * index) / height, line)
    return figure


def side_figure(found: "TraverseReport", advice: str = "") -> Figure:
    """Side view alone, with the verdict, the reason and what to do above it.

    found: what `kaidan.traverse` answers.
    advice: what to do, in one line; empty where there is nothing to do.
    """
    with look.settings():
        heads = [*_heads(found), *([advice] if advice else [])]
        top = 0.28 + 0.17 * len(heads)
        width = look.WIDTH - 2 * _RIGHT
        view = traverse_side.view_of(found, width)
        tall = width * (view[3] - view[2]) / (view[1] - view[0])
        height = top + tall + _RIGHT
        figure = look.blank(height)
        axes = figure.add_axes(
            (_RIGHT / look.WIDTH, _RIGHT / height, width / look.WIDTH, tall / height)
        )
        axes.set_xlim(view[0], view[1])
        axes.set_ylim(view[2], view[3])
        traverse_side.draw_side(axes, found, None)
        look.title(figure, _RIGHT, heads[0])
        for index, line in enumerate(heads[1:]):
            last = advice and index == len(heads) - 2
            figure.text(
                _RIGHT / look.WIDTH, 1 - (0.37 + 0.15 * index) / height, line,
                color=look.BLUE if last else look.BLACK,
            )  # fmt: skip
    return figure


def _heads(found: "TraverseReport") -> list[str]:
    answer, a = found.assessment, found.question.acceleration
    speed = f", $a$ = {look.signed(a)} m/s² up the stairs" if a else ""
    first = f"{look.named(subject(found.question), 90)}{speed}: {Verdict(answer.verdict).label}"
    said = [answer.reason]
    if answer.plan is not None and plan.line(answer.plan):
        said.append(f"Posture: {plan.line(answer.plan)}")
    return [first, *(row for each in said for row in textwrap.wrap(look.named(each, 200), 112))]

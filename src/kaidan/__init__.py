"""kaidan: can this tracked robot take these stairs?"""

TYPE_CHECKING = False  # as typing has it, which takes longer to import than all of this
if TYPE_CHECKING:
    from typing import Any

    from kaidan.assessment import Assessment, assess
    from kaidan.errors import InputError, KaidanError
    from kaidan.question import Question
    from kaidan.robot import Payload, Posture, Robot
    from kaidan.studies.cross_check import agree
    from kaidan.studies.experiment import experiment
    from kaidan.studies.reproduction import reproduce
    from kaidan.studies.sensitivity import sensitivity
    from kaidan.surface import Surface
    from kaidan.sweeps import stream, sweep, verdicts
    from kaidan.terrain.profile import Profile
    from kaidan.terrain.stairs import Stairs
    from kaidan.verbs.building import building
    from kaidan.verbs.comparison import compare
    from kaidan.verbs.d_a_plane import plane
    from kaidan.verbs.design.designing import design
    from kaidan.verbs.doctor import doctor
    from kaidan.verbs.margin_curve import margin
    from kaidan.verbs.measure_robot import measure_robot
    from kaidan.verbs.measure_stairs import measure_stairs
    from kaidan.verbs.monitor import monitor
    from kaidan.verbs.posture import posture
    from kaidan.verbs.read import read
    from kaidan.verbs.report import report
    from kaidan.verbs.traverse import traverse

__version__ = "0.1.0"

_HOME = {
    "Assessment": "kaidan.assessment",
    "agree": "kaidan.studies.cross_check",
    "assess": "kaidan.assessment",
    "InputError": "kaidan.errors",
    "KaidanError": "kaidan.errors",
    "Payload": "kaidan.robot",
    "Posture": "kaidan.robot",
    "Profile": "kaidan.terrain.profile",
    "Question": "kaidan.question",
    "Robot": "kaidan.robot",
    "Stairs": "kaidan.terrain.stairs",
    "Surface": "kaidan.surface",
    "building": "kaidan.verbs.building",
    "compare": "kaidan.verbs.comparison",
    "design": "kaidan.verbs.design.designing",
    "doctor": "kaidan.verbs.doctor",
    "experiment": "kaidan.studies.experiment",
    "margin": "kaidan.verbs.margin_curve",
    "measure_robot": "kaidan.verbs.measure_robot",
    "measure_stairs": "kaidan.verbs.measure_stairs",
    "monitor": "kaidan.verbs.monitor",
    "plane": "kaidan.verbs.d_a_plane",
    "posture": "kaidan.verbs.posture",
    "read": "kaidan.verbs.read",
    "report": "kaidan.verbs.report",
    "reproduce": "kaidan.studies.reproduction",
    "sensitivity": "kaidan.studies.sensitivity",
    "stream": "kaidan.sweeps",
    "sweep": "kaidan.sweeps",
    "traverse": "kaidan.verbs.traverse",
    "verdicts": "kaidan.sweeps",
}

__all__ = [  # noqa: RUF022 - what a user meets first
    "assess",
    "posture",
    "traverse",
    "margin",
    "plane",
    "compare",
    "building",
    "design",
    "report",
    "doctor",
    "reproduce",
    "agree",
    "experiment",
    "sensitivity",
    "sweep",
    "verdicts",
    "stream",
    "monitor",
    "read",
    "measure_robot",
    "measure_stairs",
    "Question",
    "Assessment",
    "Robot",
    "Stairs",
    "Profile",
    "Surface",
    "Payload",
    "Posture",
    "KaidanError",
    "InputError",
    "__version__",
]


def __getattr__(name: str) -> "Any":
    """Public names, imported when first used, so that starting costs nothing."""
    if name not in _HOME:
        raise AttributeError(f"module 'kaidan' has no attribute {name!r}")
    from importlib import import_module

    return getattr(import_module(_HOME[name]), name)


def __dir__() -> list[str]:
    return sorted(__all__)

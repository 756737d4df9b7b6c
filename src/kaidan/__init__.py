"""kaidan: can this tracked robot take these stairs?"""

from kaidan.lazy import when_used

TYPE_CHECKING = False  # as typing has it, which takes longer to import than all of this
if TYPE_CHECKING:
    from kaidan.assessment import Assessment, assess
    from kaidan.errors import InputError, KaidanError
    from kaidan.question import Question
    from kaidan.robot import Payload, Posture, Robot
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
    from kaidan.verbs.sensitivity import sensitivity
    from kaidan.verbs.traverse import traverse

__version__ = "0.1.0"

_HOME = {
    "Assessment": "assessment",
    "assess": "assessment",
    "InputError": "errors",
    "KaidanError": "errors",
    "Payload": "robot",
    "Posture": "robot",
    "Profile": "terrain.profile",
    "Question": "question",
    "Robot": "robot",
    "Stairs": "terrain.stairs",
    "Surface": "surface",
    "building": "verbs.building",
    "compare": "verbs.comparison",
    "design": "verbs.design.designing",
    "doctor": "verbs.doctor",
    "margin": "verbs.margin_curve",
    "measure_robot": "verbs.measure_robot",
    "measure_stairs": "verbs.measure_stairs",
    "monitor": "verbs.monitor",
    "plane": "verbs.d_a_plane",
    "posture": "verbs.posture",
    "read": "verbs.read",
    "report": "verbs.report",
    "sensitivity": "verbs.sensitivity",
    "stream": "sweeps",
    "sweep": "sweeps",
    "traverse": "verbs.traverse",
    "verdicts": "sweeps",
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

__getattr__ = when_used("kaidan", _HOME)


def __dir__() -> list[str]:
    return sorted(__all__)

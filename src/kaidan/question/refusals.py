"""What a question cannot ask, each with the reason: questions are checked as a whole here."""

from kaidan.errors import InputError, shown
from kaidan.modes import CLOSED_FORM, MODELS, PHYSICS
from kaidan.question.fields import QuestionFields
from kaidan.terrain.profile import Profile
from kaidan.terrain.stairs import Stairs


def refuse_impossible(question: QuestionFields) -> None:
    """Refuse what robot, terrain, manner and model cannot have together."""
    if question.model not in MODELS:
        raise InputError(
            f"model = {shown(question.model)} is not known; known: {', '.join(MODELS)}"
        )
    for each in dict.fromkeys(question.postures.values()):  # refuses what the robot cannot have
        question.robot.stance(each, question.payload)
    _ = question.landings  # refuses sheets that contradict each other
    _ = question.profile  # refuses one that falls to a robot that goes up
    fastest = question.robot.drive.max_speed
    if question.speed is not None and fastest is not None and question.speed > fastest:
        raise InputError(
            f"speed = {question.speed:g} is not within 0 to {fastest:g} m/s, the most "
            f"{question.robot.name} can do"
        )
    if question.model != PHYSICS.name and (question.trials != 1 or question.track is not None):
        name = "trials" if question.trials != 1 else "track"
        raise InputError(f"{name} goes with the physics alone; give model = {PHYSICS.name}")
    _refuse_impossible_plan(question)
    if question.yaw:
        _refuse_impossible_yaw(question)


def _refuse_impossible_plan(question: QuestionFields) -> None:
    before = [each.before for each in question.changes]
    if before not in ([], ["traverse"], ["land"], ["traverse", "land"]):
        raise InputError(
            f"changes of posture before {', '.join(before)}: name each phase once, in order"
        )
    if (question.changes or question.best_of) and question.model == PHYSICS.name:
        raise InputError("a trial keeps one posture: state angles, flat or stowed")
    if question.changes and question.yaw:
        raise InputError("a plan of postures is driven straight on: leave the yaw out")
    if question.flipper_tolerance and not question.plannable:
        raise InputError(
            "flipper_tolerance: the contact model alone judges the flippers off their angles, "
            "straight on; state 0deg"
        )
    if question.changes and len(question.profile.nosings) == 0:
        raise InputError("a plan of postures needs a nosing to change before")


def _refuse_impossible_yaw(question: QuestionFields) -> None:
    if not isinstance(question.terrain, Stairs):
        raise InputError(
            "a profile lies along the heading already: leave the yaw out"
            if isinstance(question.terrain, Profile)
            else "several flights are driven straight on: leave the yaw out"
        )
    if question.robot.track.gauge is None:
        raise InputError(
            f"robot {question.robot.name!r}: track.gauge is not known, and a yaw needs the "
            "distance between the middles of the tracks"
        )
    if question.model == CLOSED_FORM.name:
        raise InputError("the closed form knows no yaw; ask the contact model")

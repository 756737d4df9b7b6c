"""Findings of one phase: what happens in it, whatever the others do."""

from kaidan import Question
from kaidan.models import contact_model, quasi_static
from kaidan.modes import FALL_DOWNHILL, TIP_DOWNHILL, Phase


def test_a_fall_is_found_in_its_phase_though_the_robot_rocks_in_others_alone():
    """Marmotte rocks on the IBC's flight; gravity tilted, it falls already as it enters."""
    question = Question.in_one_posture("marmotte", "ibc", friction=2.0)
    whole = contact_model.judge(question)
    of_phase = {
        phase: quasi_static.findings_of(question, whole.basis, phase=phase) for phase in Phase
    }
    rocks = [phase for phase in Phase if of_phase[phase].of(TIP_DOWNHILL).fails().any()]
    assert rocks == [Phase.TRAVERSE, Phase.LAND]
    falls = {phase: each.of(FALL_DOWNHILL) for phase, each in of_phase.items()}
    assert [phase for phase in Phase if falls[phase] is not None] == [Phase.ENTER]
    assert falls[Phase.ENTER].worst == whole.of(FALL_DOWNHILL).worst
    assert falls[Phase.ENTER].phase is Phase.ENTER

"""Answers that several tests look at, worked out once in a process."""

import kaidan.assessment

answer_to = kaidan.assessment.answer_to
ANSWERS = {}


def each_once(patch):
    """Answer a question that was asked before with what was found, however it is shown."""

    def answered(question, *, advice=True):
        key = question.to_json(), advice
        if key not in ANSWERS:
            ANSWERS[key] = answer_to(question, advice=advice)
        return ANSWERS[key]

    patch.setattr(kaidan.assessment, "answer_to", answered)

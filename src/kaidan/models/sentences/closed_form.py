"""What the reader must know of an answer by the closed form."""

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from kaidan.models.closed_form_figures import ClosedFormFigures
    from kaidan.question import Question
    from kaidan.terrain.stairs import Stairs


def notes(question: "Question", flight: "Stairs", figures: "ClosedFormFigures") -> tuple[str, ...]:
    """Notes on an answer within the model's validity."""
    each = ["The closed form judges the traverse of the regular flight, not entering or landing."]
    if flight.irregularity > 0:
        each.append(
            f"The steps differ by {1e3 * flight.irregularity:.1f} mm; the worst of them is judged "
            "as if the whole flight were like it."
        )
    if question.steps_uncertain:
        each.append("The doubt of single steps is taken as one of the whole flight.")
    energy, height = figures.measures.energy_margin_mm, figures.measures.speed_height_mm
    if height is not None and 0 < energy < height:
        each.append(
            f"At {question.speed:g} m/s the energy margin of {energy:.2f} mm is below the "
            f"kinetic-energy height of {height:.2f} mm: the robot may rock."
        )
    return tuple(each)

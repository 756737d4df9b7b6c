"""What to look at again in a measurement."""

FIRST_AND_LAST = (
    "First and last riser often differ from the others: measure both and state --first-rise and "
    "--last-rise."
)
ONE_OF_BOTH = (
    "The {end} riser often differs from the others too: measure it and state --{end}-rise."
)
UNCHECKED = (
    "Fewer than three spot checks: single steps are taken to differ by up to 9.5 mm, as IBC "
    "1011.5.4 allows. Check three rises and three goings (--rise, --going) to settle the doubt."
)


def sums_differ(least: float, most: float) -> str:
    """The scales show two masses."""
    return (
        f"The scales show {least:.2f} kg once and {most:.2f} kg another time: more than they are "
        "said to err. Let one support roll, zero the scales and weigh again."
    )

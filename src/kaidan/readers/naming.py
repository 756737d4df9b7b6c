"""Identities and names of a building's flights, each of its own."""

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace

from kaidan.readers.building import Flight


def _told_apart(flights: Sequence[Flight]) -> Iterator[Flight]:
    """Flights with identities of their own."""
    total = Counter(each.identity for each in flights)
    seen: Counter[str] = Counter()
    for each in sorted(flights, key=lambda one: float(one.estimate.middle[0, 2])):
        seen[each.identity] += 1
        if total[each.identity] == 1:
            yield each
            continue
        number = seen[each.identity]
        yield replace(
            each,
            identity=f"{each.identity}.{number}",
            name=f"{each.name} {number}",
            parents=(each.identity, each.name, *each.parents),
        )


def named_apart(drawn: Sequence[Flight]) -> tuple[Flight, ...]:
    """Flights with identities and names of their own; the model's ones still mean all of them.

    drawn: with the identity and the name of what each is drawn as.
    """
    flights = list(_told_apart(drawn))
    total = Counter(each.name for each in flights)
    seen: Counter[str] = Counter()
    found = []
    for each in flights:
        seen[each.name] += 1
        more = total[each.name] > 1
        name = f"{each.name} {seen[each.name]}" if more else each.name
        parents = (each.name, *each.parents) if more else each.parents
        found.append(replace(each, name=name, parents=parents))
    return tuple(found)

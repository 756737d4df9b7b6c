"""What a simulator's plugins declare of a robot: which links are tracks, and how fast they run."""

import re

from kaidan.readers.xml_tree import Element

_OF_TRACKS = re.compile(r"track", re.IGNORECASE)
_LINK = re.compile(r"^(?:left|right)?_?(?:track|link)$")
_SPEED = frozenset({"max_velocity", "maximum_velocity"})


def declared_tracks(root: Element) -> tuple[tuple[str, ...], float | None]:
    """Links that plugins declare to be tracks, and the largest speed that they state [m/s].

    Gazebo's TrackController names one link, its tracked vehicle one for each side.
    """
    links: dict[str, None] = {}
    speeds = []
    for plugin in root.descendants():
        if plugin.tag != "plugin":
            continue
        called = plugin.attributes.get("name", "") + plugin.attributes.get("filename", "")
        if not _OF_TRACKS.search(called):
            continue
        for element in plugin.descendants():
            if _LINK.match(element.tag):
                name = element.text.strip() or element.word("link")
                if name:
                    links[name] = None
            if element.tag in _SPEED and element.text.strip():
                speeds.append(element.number(element.text, element.tag))
    positive = [speed for speed in speeds if 0.001 <= speed <= 30.0]
    return tuple(links), min(positive, default=None)

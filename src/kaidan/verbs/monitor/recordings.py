"""Samples of inertial sensors in recordings of ROS 1 and ROS 2, and of one message, without ROS.

The frames are those of REP 103: x towards the nose, y to the left, z up. An Imu message measures
the specific force, so that gravity has to be taken out with the orientation that it brings.
"""

import math
import os
from pathlib import Path
from typing import Any

from kaidan.errors import listed, needed
from kaidan.mechanics import STANDARD_GRAVITY
from kaidan.readers.formats import bags
from kaidan.readers.opening import LARGEST_STREAM, Source
from kaidan.verbs.monitor.samples import Sample

IMU = "sensor_msgs/msg/Imu"
"""Type of the messages that are read."""
_HEADS = (b"#ROSBAG", b"\x89MCAP", b"SQLite format 3")
"""How recordings begin."""


def is_recording(path: str | os.PathLike[str]) -> bool:
    """Whether a file is a recording by its content, or it is a folder."""
    where = Path(path)
    try:
        if not where.is_file():
            return where.is_dir()
        with where.open("rb") as file:
            return file.read(16).startswith(_HEADS)
    except (OSError, ValueError):  # what opens it says why
        return False


def sample_of_imu(message: Any, t: float, *, nose_up: bool = True, row: int = 0) -> Sample:
    """Sample of an Imu message.

    ::

        inclination = asin(2 (q_x q_z - q_w q_y))    z component of the body's x axis
        rate        = -omega_y cos(roll) + omega_z sin(roll)
        a           = +-(f_x - g sin(inclination))   + with the nose up the stairs

    Parameters
    ----------
    message : sensor_msgs/Imu
        Whatever has its fields: of rclpy, or as rosbags reads it.
    t : float
        Its time [s].
    nose_up : bool
        Whether the nose points up the stairs.
    row : int
        Its number.

    Returns
    -------
    Sample
        With a fault where the message has no orientation (first covariance -1).
    """
    q, rate, force = message.orientation, message.angular_velocity, message.linear_acceleration
    lost = Sample(t, math.nan, math.nan, math.nan, row=row)
    length = math.sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w)
    if float(message.orientation_covariance[0]) == -1.0 or not 0.5 < length < 2.0:
        return lost._replace(fault="the message has no orientation")
    x, y, z, w = (each / length for each in (q.x, q.y, q.z, q.w))
    inclination = math.asin(min(max(2.0 * (x * z - w * y), -1.0), 1.0))
    roll = math.atan2(2.0 * (w * x + y * z), 1.0 - 2.0 * (x * x + y * y))
    along = float(force.x) - STANDARD_GRAVITY * math.sin(inclination)
    return Sample(
        t=t,
        inclination=inclination,
        inclination_rate=-float(rate.y) * math.cos(roll) + float(rate.z) * math.sin(roll),
        acceleration=along if nose_up else -along,
        row=row,
    )


def samples_of_recording(
    path: str | os.PathLike[str], *, topic: str | None = None, nose_up: bool = True
) -> list[Sample]:
    """Samples of the Imu messages of a recording, by their own time.

    Parameters
    ----------
    path : str or path
        ROS 1 bag, MCAP, db3, or the folder of a ROS 2 recording.
    topic : str, optional
        Of the messages; needed where several topics have such messages.
    nose_up : bool
        Whether the nose points up the stairs.

    Raises
    ------
    InputError
        A file that cannot be read, no such topic, or several and none named.
    MissingExtraError
        rosbags is not installed.
    """
    needed("rosbags", "a recording of ROS", "bags")
    source = Source.of(Path(path))
    source.refuse_larger(LARGEST_STREAM)
    with source.foreign():
        reader, store = bags.opened(source)
        reader.open()  # one that fails is closed again, and says why
        try:
            known = {each.topic: each for each in reader.connections if each.msgtype == IMU}
            chosen = known[_topic(source, topic, sorted(known))]
            return [
                _sample(bags.deserialised(store, bytes(raw), chosen), row, nose_up)
                for row, (_, _, raw) in enumerate(reader.messages(connections=[chosen]), start=1)
            ]
        finally:
            reader.close()


def _sample(message: Any, row: int, nose_up: bool) -> Sample:
    stamp = message.header.stamp
    t = float(stamp.sec) + 1e-9 * float(stamp.nanosec)
    return sample_of_imu(message, t, nose_up=nose_up, row=row)


def _topic(source: Source, topic: str | None, known: list[str]) -> str:
    if topic is None and len(known) == 1:
        return known[0]
    names = listed(known) or "none"
    if topic is None:
        raise source.refuse(f"topics of {IMU}: {names}; give a file with one")
    if topic not in known:
        raise source.refuse(f"no topic {topic[:60]!r} of {IMU}; known: {names}")
    return topic

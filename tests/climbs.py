"""A climb as its inertial sensor has it, made by hand: level, on the flight, rearing."""

import math
from typing import NamedTuple

SLOPE = 0.80
"""Slope of the flight [rad]."""
HEAD = "t,inclination,inclination_rate,acceleration"


class Row(NamedTuple):
    t: float
    inclination: float
    inclination_rate: float


def climb(seconds=7.0, rate=20.0):
    """Rows: a second level, two seconds nose up to the slope, on it, the last second rearing.

    Its rate is never twice the same, as that of a sensor that is alive.
    """
    rows = []
    for k in range(int(seconds * rate)):
        t, noise = k / rate, 1e-4 * (k % 2)
        if t < 1:
            rows.append(Row(t, 0.0, noise))
        elif t < 3:
            rows.append(Row(t, SLOPE * (t - 1) / 2, SLOPE / 2 + noise))
        elif t < seconds - 1:
            rows.append(Row(t, SLOPE, noise))
        else:
            rows.append(Row(t, SLOPE + 0.3 * (t - seconds + 1), 0.3 + noise))
    return rows


def csv_of(rows):
    """Rows as a file of samples."""
    return "\n".join(
        [HEAD, *(f"{r.t:.3f},{r.inclination!r},{r.inclination_rate!r},0" for r in rows), ""]
    )


def imu_of(kind, row, *, yaw=0.4, roll=0.0, g=9.80665):
    """Imu message of a row in frames of REP 103, at a heading and a roll of its own.

    By hand: the body is turned by yaw about z, then by minus the inclination about y, then by roll
    about x; at rest the sensor feels the specific force g away from the ground.
    """
    names = ["orientation", "angular_velocity", "linear_acceleration", "orientation_covariance"]
    cy, sy = math.cos(yaw / 2), math.sin(yaw / 2)
    cp, sp = math.cos(-row.inclination / 2), math.sin(-row.inclination / 2)
    cr, sr = math.cos(roll / 2), math.sin(roll / 2)
    q = {
        "w": cr * cp * cy + sr * sp * sy, "x": sr * cp * cy - cr * sp * sy,
        "y": cr * sp * cy + sr * cp * sy, "z": cr * cp * sy - sr * sp * cy,
    }  # fmt: skip
    # rate of the inclination: about the horizontal axis to the left, as the rolled body has it
    w = {"x": 0.0, "y": -row.inclination_rate * math.cos(roll),
         "z": row.inclination_rate * math.sin(roll)}  # fmt: skip
    up = math.cos(row.inclination)
    f = {"x": g * math.sin(row.inclination), "y": g * up * math.sin(roll),
         "z": g * up * math.cos(roll)}  # fmt: skip
    return kind(**dict(zip(names, (q, w, f, [0.0] * 9), strict=True)))


def recording(rows, folder, *, mcap=True, topics=("/imu/data",)):
    """ROS 2 recording of Imu messages, as rosbags writes it; its one file."""
    import numpy as np
    from rosbags.rosbag2 import StoragePlugin, Writer
    from rosbags.typesys import Stores, get_typestore

    store = get_typestore(Stores.ROS2_HUMBLE)
    types = store.types

    def message(**parts):
        nine = np.array(parts["orientation_covariance"])
        return types["sensor_msgs/msg/Imu"](
            header=header,
            orientation=types["geometry_msgs/msg/Quaternion"](**parts["orientation"]),
            orientation_covariance=nine,
            angular_velocity=types["geometry_msgs/msg/Vector3"](**parts["angular_velocity"]),
            angular_velocity_covariance=nine,
            linear_acceleration=types["geometry_msgs/msg/Vector3"](**parts["linear_acceleration"]),
            linear_acceleration_covariance=nine,
        )

    plugin = StoragePlugin.MCAP if mcap else StoragePlugin.SQLITE3
    with Writer(folder, version=9, storage_plugin=plugin) as writer:
        kind = "sensor_msgs/msg/Imu"
        for topic in topics:
            connection = writer.add_connection(topic, kind, typestore=store)
            for row in rows:
                whole, part = divmod(round(1e9 * row.t), 10**9)
                stamp = types["builtin_interfaces/msg/Time"](sec=whole, nanosec=part)
                header = types["std_msgs/msg/Header"](stamp=stamp, frame_id="imu")
                raw = store.serialize_cdr(imu_of(message, row), kind)
                writer.write(connection, round(1e9 * row.t), raw)
    (file,) = [each for each in folder.iterdir() if each.suffix in (".mcap", ".db3")]
    return file

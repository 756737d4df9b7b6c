"""The node: parameters in, a service, topics and diagnostics out. What it says is `climb`'s."""

import math
from typing import Any

import rclpy
from diagnostic_msgs.msg import DiagnosticArray, DiagnosticStatus, KeyValue
from rclpy.node import Node
from rclpy.qos import qos_profile_sensor_data
from sensor_msgs.msg import Imu
from std_msgs.msg import Bool, Float64, String
from std_srvs.srv import Trigger

from kaidan.verbs.monitor.live import LiveState
from kaidan_ros.climb import PARAMETERS, Climb

PERIOD = 0.5
"""Between two diagnostics [s]."""
LOOK = 0.05
"""Between two looks whether a message is overdue [s]."""


class KaidanNode(Node):
    """Node ``kaidan``: service ``~/assess``, topics ``~/margin_deg`` and so on."""

    def __init__(self) -> None:
        super().__init__("kaidan")
        for name, value in PARAMETERS.items():
            self.declare_parameter(name, value)
        self._taken = self._parameters()
        self.climb = Climb(self._taken)
        self._margin = self.create_publisher(Float64, "~/margin_deg", 10)
        self._time = self.create_publisher(Float64, "~/time_to_tip", 10)
        self._alarm = self.create_publisher(Bool, "~/alarm", 10)
        self._state = self.create_publisher(String, "~/state", 10)
        self._diagnostics = self.create_publisher(DiagnosticArray, "/diagnostics", 10)
        self.create_service(Trigger, "~/assess", self.assess)
        self.create_subscription(Imu, "imu", self.take, qos_profile_sensor_data)
        self.create_timer(PERIOD, self.diagnose)
        self.create_timer(LOOK, self.look)

    def assess(self, request: Trigger.Request, response: Trigger.Response) -> Trigger.Response:
        """Answer the service; with parameters that were changed a new climb begins."""
        now = self._parameters()
        try:
            if now != self._taken:
                self.climb, self._taken = Climb(now), now
        except Exception as error:  # what has no meaning is an answer, not the end of the node
            response.success, response.message = False, str(error)
            return response
        response.success, response.message = self.climb.assess()
        return response

    def take(self, message: Imu) -> None:
        """Publish what the monitor says of a sample."""
        self._publish(self.climb.feed(message, self._now()))

    def look(self) -> None:
        """Publish the alarm of a message that has not come in time."""
        missing = self.climb.overdue(self._now())
        if missing is not None:
            self._publish(missing)

    def _publish(self, state: LiveState) -> None:
        if state.margin_deg is not None:
            self._margin.publish(Float64(data=state.margin_deg))
            time = math.inf if state.time_to_tip_s is None else state.time_to_tip_s
            self._time.publish(Float64(data=time))
        self._alarm.publish(Bool(data=state.alarm))
        self._state.publish(String(data=state.model_dump_json()))

    def diagnose(self) -> None:
        """Publish the diagnostic status."""
        level, text, values = self.climb.status()
        status = DiagnosticStatus(
            level=bytes([level]),
            name="kaidan: tip-over",
            message=text,
            hardware_id=self.climb.question.robot.name,
            values=[KeyValue(key=key, value=value) for key, value in values],
        )
        array = DiagnosticArray(status=[status])
        array.header.stamp = self.get_clock().now().to_msg()
        self._diagnostics.publish(array)

    def _parameters(self) -> dict[str, Any]:
        return {name: self.get_parameter(name).value for name in PARAMETERS}

    def _now(self) -> float:
        return 1e-9 * self.get_clock().now().nanoseconds


def main() -> None:
    """Run the node until it is interrupted."""
    rclpy.init()
    node = KaidanNode()
    try:
        rclpy.spin(node)
    except KeyboardInterrupt:
        pass
    finally:
        node.destroy_node()
        rclpy.try_shutdown()

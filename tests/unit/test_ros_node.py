"""The node of ROS 2, fed with recorded messages, on a stub of rclpy."""

import json
import math
import sys
from pathlib import Path
from types import ModuleType, SimpleNamespace

import pytest

import kaidan
from climbs import climb, imu_of

ROS = Path(__file__).parents[2] / "ros" / "kaidan_ros"
PARAMETERS = {"robot": "absolem", "stairs": "ibc", "flippers": "flat", "friction": "0.6..1.0"}


def messages():
    """Imu messages of a climb that ends rearing, with their stamps."""
    for row in climb():
        made = imu_of(_message, row)
        whole, part = divmod(round(1e9 * row.t), 10**9)
        made.header = SimpleNamespace(stamp=SimpleNamespace(sec=whole, nanosec=part))
        yield row.t, made


def _message(**parts):
    return SimpleNamespace(
        **{key: SimpleNamespace(**each) if isinstance(each, dict) else each
           for key, each in parts.items()}
    )  # fmt: skip


@pytest.fixture
def logic(monkeypatch):
    monkeypatch.syspath_prepend(str(ROS))
    from kaidan_ros import climb as module

    return module


def test_the_service_answers_as_assess(logic):
    found = logic.Climb(PARAMETERS).assess()
    answer = kaidan.assess("absolem", "ibc", flippers="flat", friction="0.6..1.0")
    assert found == (answer.verdict == "go", answer.to_json())
    stopped = logic.Climb({"robot": "kenaf", "stairs": "ibc", "friction": "0.8"}).assess()
    assert not stopped.success
    assert json.loads(stopped.message)["verdict"] == "no-go"


def test_the_status_follows_the_climb(logic):
    watch = logic.Climb(PARAMETERS)
    assert watch.status().level == logic.STALE
    levels = []
    for t, message in messages():
        state = watch.feed(message, t)
        assert state.t_s == pytest.approx(t)
        levels.append(watch.status().level)
    assert levels[0] == logic.OK
    assert levels[-1] == logic.ERROR
    assert dict(watch.status().values)["phase"] == "traverse"
    assert watch.overdue(t + 0.1) is None
    assert watch.overdue(t + 0.25).causes == ("tipped over", "silent")
    silent = watch.status()
    assert (silent.level, silent.message) == (logic.STALE, "alarm: tipped over, silent")


def test_parameters_without_meaning_are_refused(logic):
    with pytest.raises(kaidan.InputError, match="robot and stairs: name both"):
        logic.Climb({"robot": "absolem"})
    with pytest.raises(kaidan.InputError, match="margin_off"):
        logic.Climb(PARAMETERS | {"clear_margin_deg": 1.0})


def test_messages_of_a_recording_are_taken_as_they_are(logic, tmp_path):
    pytest.importorskip("rosbags", reason="skipped: rosbags not installed")
    from rosbags.highlevel import AnyReader

    from climbs import recording

    recording(climb(), tmp_path / "climb")
    watch, states = logic.Climb(PARAMETERS), []
    with AnyReader([tmp_path / "climb"]) as reader:
        for connection, t, raw in reader.messages():
            states.append(watch.feed(reader.deserialize(raw, connection.msgtype), 1e-9 * t))
    assert [each.alarm for each in states[:: len(states) - 1]] == [False, True]


class StubNode:
    """As much of rclpy's Node as the node uses."""

    def __init__(self, name):
        self.name, self.values, self.sent, self.time = name, {}, {}, 0.0
        self.services, self.subscriptions, self.timers = {}, {}, []

    def declare_parameter(self, name, value):
        self.values[name] = PARAMETERS.get(name, value)

    def get_parameter(self, name):
        return SimpleNamespace(value=self.values[name])

    def create_publisher(self, kind, topic, depth):
        said = self.sent.setdefault(topic, [])
        return SimpleNamespace(publish=said.append)

    def create_service(self, kind, name, callback):
        self.services[name] = callback

    def create_subscription(self, kind, topic, callback, quality):
        self.subscriptions[topic] = callback

    def create_timer(self, period, callback):
        self.timers.append(callback)

    def get_clock(self):
        now = SimpleNamespace(nanoseconds=1e9 * self.time, to_msg=lambda: self.time)
        return SimpleNamespace(now=lambda: now)


@pytest.fixture
def node(logic, monkeypatch):
    def record(name):
        return type(name, (SimpleNamespace,), {})

    def array(status):
        return SimpleNamespace(status=status, header=SimpleNamespace(stamp=None))

    stubs = {
        "rclpy": {},
        "rclpy.node": {"Node": StubNode},
        "rclpy.qos": {"qos_profile_sensor_data": "sensor"},
        "sensor_msgs": {},
        "sensor_msgs.msg": {"Imu": record("Imu")},
        "std_msgs": {},
        "std_msgs.msg": {name: record(name) for name in ("Bool", "Float64", "String")},
        "std_srvs": {},
        "std_srvs.srv": {"Trigger": SimpleNamespace(Request=object, Response=object)},
        "diagnostic_msgs": {},
        "diagnostic_msgs.msg": {
            "DiagnosticArray": array,
            "DiagnosticStatus": record("DiagnosticStatus"),
            "KeyValue": record("KeyValue"),
        },
    }
    for name, content in stubs.items():
        module = ModuleType(name)
        module.__dict__.update(content)
        monkeypatch.setitem(sys.modules, name, module)
    monkeypatch.delitem(sys.modules, "kaidan_ros.node", raising=False)
    from kaidan_ros.node import KaidanNode

    yield KaidanNode()
    sys.modules.pop("kaidan_ros.node", None)


def test_the_node_publishes_margins_alarm_and_diagnostics(node, logic):
    for t, message in messages():
        node.time = t
        node.subscriptions["imu"](message)
    node.timers[0]()
    assert node.sent["~/alarm"][-1].data is True
    assert node.sent["~/alarm"][0].data is False
    states = [json.loads(each.data) for each in node.sent["~/state"]]
    margins = [each.data for each in node.sent["~/margin_deg"]]
    assert margins == [each["margin_deg"] for each in states if each["margin_deg"] is not None]
    assert any(math.isinf(each.data) for each in node.sent["~/time_to_tip"])
    (status,) = node.sent["/diagnostics"][0].status
    assert status.level == bytes([logic.ERROR])
    assert {each.key for each in status.values} >= {"margin_deg", "tilt_deg", "phase"}


def test_the_node_says_that_messages_no_longer_come(node, logic):
    come = [(t, message) for t, message in messages() if t < 1.5]  # 20 a second
    for t, message in come:
        node.time = t
        node.subscriptions["imu"](message)
        node.timers[1]()
    assert [each.data for each in node.sent["~/alarm"]] == [False] * len(come)
    for _ in range(10):  # looked at every 50 ms
        node.time += 0.05
        node.timers[1]()
    said = [json.loads(each.data) for each in node.sent["~/state"]][len(come) :]
    assert all(each["causes"] == ["silent"] for each in said)
    assert len(said) == 7  # from 0.2 s on
    assert node.sent["~/alarm"][-1].data is True
    node.timers[0]()
    assert node.sent["/diagnostics"][-1].status[0].level == bytes([logic.STALE])


def test_a_frozen_sensor_is_an_error_of_its_own_name(logic):
    watch = logic.Climb(PARAMETERS | {"no_data_s": 1.0})
    (_, first), *_ = messages()
    for k in range(80):
        first.header.stamp.nanosec = 10_000_000 * k
        watch.feed(first, 0.01 * k)
    assert watch.status()[:2] == (logic.ERROR, "alarm: frozen")
    assert watch.overdue(0.79 + 0.9) is None
    coarse = logic.Climb(PARAMETERS | {"resolution_deg": 0.1})
    for k in range(80):
        first.header.stamp.nanosec = 10_000_000 * k
        coarse.feed(first, 0.01 * k)
    assert coarse.status()[:2] == (logic.OK, "no alarm")
    with pytest.raises(kaidan.InputError, match="no_data_on"):
        logic.Climb(PARAMETERS | {"no_data_s": -1.0})


def test_the_service_takes_parameters_that_were_changed(node):
    response, before = SimpleNamespace(success=None, message=None), node.climb
    node.services["~/assess"](None, response)
    assert json.loads(response.message)["question"]["robot"]["name"] == "absolem"
    assert node.climb is before  # whose alarm goes on
    node.values["flippers"] = "20deg,-5deg"
    node.services["~/assess"](None, response)
    assert node.climb is not before
    node.values["robot"] = "nobody"
    node.services["~/assess"](None, response)
    assert (response.success, response.message[:18]) == (False, "no robot is called")


def test_the_package_names_what_it_imports():
    manifest = (ROS / "package.xml").read_text(encoding="utf-8")
    for name in ("rclpy", "std_msgs", "std_srvs", "sensor_msgs", "diagnostic_msgs"):
        assert f"<exec_depend>{name}</exec_depend>" in manifest
    assert f"<version>{kaidan.__version__}</version>" in manifest

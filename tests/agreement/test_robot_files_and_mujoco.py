"""Mass, centroid and inertia of robot files, judged by MuJoCo, which reads them on its own.

The band is 1e-6 relative (issue: equal to 1e-6): both work in double precision on the same numbers;
MuJoCo keeps principal moments and a quaternion, which costs some 1e-12.
"""

import mujoco
import numpy as np
import pytest

from kaidan.readers.formats import mjcf
from kaidan.readers.formats import urdf as urdf_reader
from kaidan.readers.xml_tree import parse_xml
from robot_files import ACROSS, arm_of_four, urdf, urdf_joint, urdf_link, urdf_shape

BAND = 1e-6
KEPT = '<mujoco><compiler fusestatic="false" balanceinertia="false"/></mujoco>'


@pytest.fixture(autouse=True)
def _elsewhere(tmp_path, monkeypatch):
    """MuJoCo writes its warnings into a file of the folder it is in."""
    monkeypatch.chdir(tmp_path)


def judged(model, angles):
    """Mass, centroid and inertia about it by MuJoCo, in the frame of its world."""
    data = mujoco.MjData(model)
    for name, value in angles.items():
        joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, name)
        assert joint >= 0, name
        data.qpos[model.jnt_qposadr[joint]] = value
    mujoco.mj_kinematics(model, data)
    mujoco.mj_comPos(model, data)
    mass = model.body_mass[1:]
    centroid = mass @ data.xipos[1:] / mass.sum()
    inertia = np.zeros((3, 3))
    for body in range(1, model.nbody):
        turned = data.ximat[body].reshape(3, 3)
        away = data.xipos[body] - centroid
        inertia += turned @ np.diag(model.body_inertia[body]) @ turned.T
        inertia += model.body_mass[body] * (away @ away * np.eye(3) - np.outer(away, away))
    return mass.sum(), centroid, inertia


def agrees(found, expected):
    np.testing.assert_allclose(found[0], expected[0], rtol=BAND)
    np.testing.assert_allclose(found[1], expected[1], rtol=BAND, atol=BAND)
    scale = np.abs(expected[2]).max()
    np.testing.assert_allclose(found[2], expected[2], rtol=0, atol=BAND * scale)


@pytest.mark.parametrize(
    "angles",
    [
        {},
        {"shoulder": 1.0, "elbow": -2.2, "lift": 0.3},
        {"shoulder": -2.9, "elbow": 7.5, "lift": -0.4},
        {"elbow": 0.01},
    ],
)
def test_a_chain_of_oblique_joints_in_urdf(angles):
    root = parse_xml(arm_of_four(), origin="arm")
    model = mujoco.MjModel.from_xml_string(
        arm_of_four("world_link").decode().replace("<link", KEPT + "<link", 1)
    )
    agrees(urdf_reader.mechanism(root).mass_properties(angles), judged(model, angles))


def test_a_joint_that_follows_another_in_urdf():
    """By hand: at lead 0.5 the other is at -2 * 0.5 + 0.3 = -0.7, set as such in MuJoCo."""
    mimic = '<mimic joint="lead" multiplier="-2" offset="0.3"/>'
    parts = [
        urdf_link("base", 4.0),
        urdf_link("one", 1.0, "0.3 0 0"),
        urdf_link("two", 2.0, "0.2 0 0.1"),
        urdf_joint("lead", "revolute", "base", "one", "0.5 0 0"),
    ]
    last = {"parent": "base", "child": "two", "xyz": "-0.5 0 0", "axis": "0 0 1"}
    follows = urdf(*parts, urdf_joint("other", "revolute", **last, more=mimic))
    plain = urdf(
        '<link name="w"/>', *parts, urdf_joint("other", "revolute", **last),
        '<joint name="f" type="fixed"><parent link="w"/><child link="base"/></joint>',
    )  # fmt: skip
    found = urdf_reader.mechanism(parse_xml(follows, origin="r")).mass_properties({"lead": 0.5})
    model = mujoco.MjModel.from_xml_string(plain.decode().replace("<link", KEPT + "<link", 1))
    agrees(found, judged(model, {"lead": 0.5, "other": -0.7}))


MJCF = """
<mujoco model="tested">
  <compiler {compiler}/>
  <default>
    <geom density="700"/>
    <default class="wheel"><geom type="cylinder" size="0.1 0.04"/><joint axis="0 1 0"/></default>
    <default class="arm"><geom type="capsule"/>
      <default class="finger"><geom rgba="1 0 0 1" density="3000"/></default>
    </default>
  </default>
  <worldbody>
    <geom type="plane" size="5 5 .1"/>
    <body name="hull" pos="1 2 3" euler="{e}">
      <freejoint/>
      <geom type="box" size="0.3 0.2 0.1" pos="0.05 0 0.1" euler="{e}"/>
      <geom type="sphere" size="0.07" pos="0.3 0 0.2" mass="0.9"/>
      <geom type="ellipsoid" size="0.1 0.05 0.02" pos="-0.2 0.1 0" quat="1 2 3 4"/>
      <geom type="box" size="0.3 0.2 0.1" group="3" mass="2" contype="0" conaffinity="0"/>
      <frame pos="0.1 0.2 0.3" axisangle="0 1 1 {a}">
        <geom type="cylinder" size="0.05 0.2" xyaxes="1 1 0 0 0 1"/>
        <body name="spun" pos="0.2 0 0" zaxis="1 1 1" childclass="wheel">
          <joint name="spin"/>
          <geom/>
          <geom class="finger" type="capsule" fromto="0 0 0 0.1 0.2 0.3" size="0.03"/>
        </body>
      </frame>
      <body name="arm" pos="0.2 -0.3 0.1" childclass="arm">
        <joint name="turn" pos="0.1 0.02 -0.1" axis="1 0 2" ref="{a}"/>
        <joint name="tilt" pos="-0.1 0.05 0" axis="0 1 0.3"/>
        <joint name="reach" type="slide" axis="1 1 0" ref="0.05"/>
        <geom size="0.05 0.2" pos="0.1 0 0"/>
        <body name="hand" pos="0.3 0 0" quat="0.9 0.1 0.2 0.3">
          <inertial pos="0.05 0.01 0" mass="0.8" fullinertia="0.03 0.05 0.06 0.002 -0.001 0.004"/>
          <joint name="wrist" axis="0 0 1"/>
          <geom type="box" fromto="0 0 0 0.1 0 0" size="0.02"/>
        </body>
        <body name="tip"><inertial pos="1 0 0" euler="{e}" mass="0.2" diaginertia="0.1 0.2 0.15"/>
        </body>
      </body>
    </body>
  </worldbody>
</mujoco>
"""


@pytest.mark.parametrize(
    ("compiler", "e", "a"),
    [
        ('angle="radian" autolimits="true"', "0.3 -0.4 0.9", "0.7"),
        ("", "20 -35 70", "40"),
        ('eulerseq="XYZ"', "20 -35 70", "40"),
        ('eulerseq="zyx" inertiagrouprange="0 2"', "20 -35 70", "40"),
        ('inertiafromgeom="true" settotalmass="20"', "10 5 70", "-40"),
    ],
)
@pytest.mark.parametrize(
    "angles", [{}, {"turn": 0.4, "tilt": -1.1, "reach": 0.2, "wrist": 2.0, "spin": 0.5}]
)
def test_a_model_of_mjcf(compiler, e, a, angles):
    text = MJCF.format(compiler=compiler, e=e, a=a)
    if 'true" settotal' in compiler:  # then a body needs geoms that have a mass
        text = text.replace("</body>\n      </body>", '<geom size=".02 .1"/></body></body>', 1)
    found = mjcf.mechanism(parse_xml(text.encode(), origin="m")).mass_properties(angles)
    agrees(found, judged(mujoco.MjModel.from_xml_string(text), angles))


def test_a_cylinder_of_urdf_lies_along_z():
    """MuJoCo takes a missing inertial from the shapes; here only the shape's extent is compared."""
    text = urdf(
        urdf_link("base", shapes=urdf_shape('<cylinder radius="0.1" length="0.5"/>', rpy=ACROSS))
    )
    (shape,) = urdf_reader.mechanism(parse_xml(text, origin="r")).links["base"].shapes
    model = mujoco.MjModel.from_xml_string(text.decode())
    assert (shape.size[0], shape.size[1] / 2) == tuple(model.geom_size[0][:2])
    turned = np.zeros(9)
    mujoco.mju_quat2Mat(turned, model.geom_quat[0])
    np.testing.assert_allclose(shape.place[:3, 2], turned.reshape(3, 3)[:, 2], atol=1e-12)

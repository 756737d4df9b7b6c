"""The package for colcon."""

from setuptools import setup

setup(
    name="kaidan_ros",
    version="0.1.0",
    packages=["kaidan_ros"],
    data_files=[
        ("share/ament_index/resource_index/packages", ["resource/kaidan_ros"]),
        ("share/kaidan_ros", ["package.xml"]),
    ],
    install_requires=["setuptools", "kaidan"],
    maintainer="The kaidan authors",
    description="kaidan as a node of ROS 2",
    license="MIT",
    entry_points={"console_scripts": ["kaidan_node = kaidan_ros.node:main"]},
)

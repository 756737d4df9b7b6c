"""kaidan as a node of ROS 2: `node` speaks ROS, `climb` does not."""

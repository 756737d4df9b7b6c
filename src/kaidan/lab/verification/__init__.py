"""The paper's verification test in MuJoCo, for any robot and spacings."""

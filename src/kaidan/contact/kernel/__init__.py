"""The kernel: ordinary functions of floats and arrays, run as they stand or compiled."""

"""Formulas that judge the kernel from outside, and equations of the paper that nothing uses."""

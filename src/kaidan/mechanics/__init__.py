"""Mechanics of tracks on stairs: pure formulas of numbers and arrays.

Nothing here knows a robot, a file or a unit other than SI and radians. Every function takes
keyword arguments in the symbols of the source (Endo & Nagatani 2016, in ASCII), passes floats,
arrays and labelled arrays through unchanged, and answers NaN, never a clipped number, where its
equation has no solution. Read the modules in the order of the paper:

``slipping`` (Eqs. 1-4, 14), ``triangle`` (8-10, 13, 20-23), ``tipping`` (5-7, 11-12, 15-18),
``plane`` (the states A-D and the five areas of the d-a plane), ``margin`` (19-24), ``loads``
(how the contacts share the weight), ``measures`` (published stability measures),
``transitions`` (entering, riser start, crest), ``rearing`` (a tail in the corner of a tread),
``rocking`` (what of a turn counts on a flight), ``drive`` (traction, torque, power), ``oblique``
(approach with a yaw), ``margins`` (every failure mode at once), ``weighing`` (the centroid from
scales, tape and level), ``grousers`` (what a belt with grousers holds), ``clearance``
and ``turning`` (room on a flight, at a corner, through a door, on a landing).

Symbols, floats or arrays that broadcast, which a formula lists only where it means another:
``theta_s`` slope of the line through the nosings [rad], ``p`` nosing spacing [m], ``L`` length of
the flat underside [m], ``C_L``, ``C_N`` centroid behind the uphill tip and above the underside
[m], ``M`` mass [kg], ``a`` acceleration up the stairs [m/s^2], ``psi`` yaw off the line of
steepest ascent, to the left positive [rad], ``mu_s`` static friction [1], ``g`` gravity [m/s^2].
The glossary in the documentation has all of them.

A robot that faces down the stairs is the same robot with its ends swapped: write ``L - C_L``
for ``C_L`` and every formula holds.
"""

from typing import Any

STANDARD_GRAVITY = 9.80665
"""Standard acceleration of gravity [m/s^2] (CGPM 1901); the default of every ``g``."""

Number = Any
"""A float, a numpy array or an xarray object: whatever numpy's operators and ufuncs accept."""

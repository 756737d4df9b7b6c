"""Stairs from solids as a program draws them: exact, z up, in metres.

`levels` finds what can be stood on, `runs` the straight flights among it, `section` their nosings,
`room` what is clear beside and above them. Plan polygons are shapely's, which comes with the
extras that read solids.
"""

"""Figures, tables and files of what the other parts find.

Computing and drawing are apart: a module that ends in ``_figure`` takes plain data and returns a
matplotlib figure, its neighbour without the ending makes the data. ``look`` holds what all
figures share, ``files`` writes them whole or not at all, ``text`` sets tables for the terminal.
"""

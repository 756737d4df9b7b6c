"""The neighbouring systems from the paper's references, re-derived, each "after" its authors.

Endo & Nagatani 2016 stand among others who asked other questions of robots on stairs. Their texts
were not at hand (what of them could be seen, ``docs/neighbours.md`` says): the question is theirs,
the formulas are derived anew from the mechanics of this package, and no equation is quoted.

``entering`` (after Guo et al. 2010), ``climbing_ability`` (after Liu J. et al. 2005),
``tipover_monitor`` (after Liu & Liu 2009), ``heading`` (after Martens & Newman 1994).
"""

"""Many robots and many stairs: labelled sweeps, pairs by the million, streams."""

from kaidan.sweeps.pairs import stream as stream
from kaidan.sweeps.pairs import verdicts as verdicts
from kaidan.sweeps.sweeping import sweep as sweep

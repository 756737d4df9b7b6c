"""Samples of a live source with the times at which they came, and whether one comes in time."""

import threading
import time
from collections.abc import Iterator
from queue import Empty, Queue
from typing import NamedTuple

from kaidan.verbs.monitor.samples import Sample

MOST_WAITING = 2_000
"""Most samples that wait, and that are taken at once; then the source has to wait."""


class Arrival(NamedTuple):
    """A sample and when it came."""

    sample: Sample
    at: float
    """By the clock of `Arrivals.now` [s]."""


class Arrivals:
    """Samples of a source that is read in the background, so that its silence can be noticed.

    Parameters
    ----------
    samples : iterator of Sample
        Of a source that may make one wait.
    """

    now = staticmethod(time.monotonic)
    """Clock of the arrivals [s]."""

    def __init__(self, samples: Iterator[Sample]) -> None:
        self._waiting: Queue[Arrival | BaseException] = Queue(MOST_WAITING)
        self._end: BaseException | None = None
        threading.Thread(target=self._read, args=(samples,), daemon=True).start()

    def take(self, within: float | None = None) -> list[Arrival] | None:
        """Samples that came and nobody took.

        Parameters
        ----------
        within : float, optional
            How long one is waited for [s]; for ever without it.

        Returns
        -------
        list of Arrival or None
            Empty if none came within that time, None if the source has ended.

        Raises
        ------
        InputError
            What the source raised.
        """
        came: list[Arrival] = []
        try:
            while self._end is None and len(came) < MOST_WAITING:
                found = self._waiting.get(not came, within)
                if isinstance(found, BaseException):
                    self._end = found
                else:
                    came.append(found)
        except Empty:
            return came
        if came:
            return came
        if self._end is None or isinstance(self._end, StopIteration):
            return None
        raise self._end

    def _read(self, samples: Iterator[Sample]) -> None:
        try:
            for sample in samples:
                self._waiting.put(Arrival(sample, self.now()))
        except BaseException as error:  # told to who takes the samples
            self._waiting.put(error)
        else:
            self._waiting.put(StopIteration())

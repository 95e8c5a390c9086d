"""Showing how far a long computation is."""

from __future__ import annotations

import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

#: Is told how much is done, and how much there is.
Told = Callable[[int, int], object]
#: A function that is told, ``True`` for a bar, ``False`` for nothing; ``None`` for a bar after a second.
Progress = Told | bool | None

#: Whoever waits longer than this sees a bar.
PATIENCE = 1.0


@contextmanager
def told(progress: Progress, what: str, unit: str) -> Iterator[Told | None]:
    """The function that the compiled part is to call. Bars are those of ``tqdm``, where it is installed."""
    if progress is False:
        yield None
        return
    if callable(progress):
        yield progress
        return
    bar = _Bar(what, unit, 0.0 if progress else PATIENCE)
    try:
        yield bar.tell
    finally:
        bar.close()


class _Bar:
    def __init__(self, what: str, unit: str, patience: float) -> None:
        self.what, self.unit = what, unit
        self.begin = time.monotonic() + patience
        self.bar: Any = None

    def tell(self, done: int, of: int) -> None:
        if self.bar is None and time.monotonic() >= self.begin and done < of:
            try:
                from tqdm.auto import tqdm
            except ImportError:
                return
            self.bar = tqdm(total=of, desc=self.what, unit=self.unit, unit_scale=True)
        if self.bar is not None:
            self.bar.update(done - self.bar.n)

    def close(self) -> None:
        if self.bar is not None:
            self.bar.close()

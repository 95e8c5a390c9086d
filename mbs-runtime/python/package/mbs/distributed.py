"""Sweeps on the workers of a Dask cluster.

A task carries the text of the mechanism and the runs that it is to make, compiles the one, which takes milliseconds, and
makes the others. A task that is repeated, because its worker was lost, gives the same numbers to the bit; what other
tasks have done is not touched.
"""

from __future__ import annotations

from functools import lru_cache
from math import prod
from typing import TYPE_CHECKING, Any

import numpy as np

from mbs.errors import Error
from mbs.progress import Told

if TYPE_CHECKING:
    from mbs._native import Swept
    from mbs.mechanism import Mechanism
    from mbs.sweep import Client, Request

#: Tasks for every thread of the cluster, unless it is said how many runs a task has.
TASKS_PER_THREAD = 16

#: A task is given to other workers so often where its worker is lost.
RETRIES = 3

Source = tuple[str, str, str | None]


@lru_cache(maxsize=8)
def _mechanism(source: Source) -> Mechanism:
    """Compiled once a process."""
    from mbs.mechanism import _compiled

    return _compiled(*source)


def share(source: Source, request: Request, first: int, last: int) -> tuple[int, Swept]:
    """What a worker does: some runs of a sweep, with the threads that it has."""
    from distributed import get_worker

    from mbs.sweep import here

    threads = int(get_worker().state.nthreads)
    return first, here(_mechanism(source), request, first, last, None, threads)


def sweep(mechanism: Mechanism, request: Request, client: Client, chunk: int | None, tell: Told | None) -> Swept:
    """All runs of a sweep, by the workers of a client; results are put together as they come."""
    from distributed import as_completed

    if mechanism._source is None:
        raise Error(f"{mechanism.name} was compiled by rustc; workers compile a text, which it does not have")
    count = prod(request.shape)
    size = chunk if chunk is not None else _size(client, count)
    if size < 1:
        raise Error("a task of a sweep has at least one run")
    futures = [
        client.submit(share, mechanism._source, request, first, min(first + size, count), retries=RETRIES, pure=False)
        for first in range(0, count, size)
    ]
    whole: Swept | None = None
    done = 0
    try:
        for future, (first, part) in as_completed(futures, with_results=True):
            whole = _joined(whole, part, first, count)
            done += min(size, count - first)
            if tell is not None:
                tell(done, count)
            # the worker need not keep what was taken
            future.release()
    finally:
        for future in futures:
            future.cancel()
    if whole is None:
        raise Error("a sweep has at least one run")
    whole["reasons"].sort()
    return whole


def _size(client: Client, count: int) -> int:
    workers = client.scheduler_info()["workers"].values()
    threads = sum(int(worker["nthreads"]) for worker in workers)
    return max(1, -(-count // (TASKS_PER_THREAD * max(1, threads))))


def _joined(whole: Swept | None, part: Swept, first: int, count: int) -> Swept:
    if whole is None:
        blank: dict[str, Any] = {
            name: (unit, *(np.full(count, np.nan) for _ in columns))
            for name, (unit, *columns) in part["extents"].items()
        }
        whole = {"extents": blank, "failed": 0, "reasons": []}
    for name, (_, *columns) in part["extents"].items():
        for target, column in zip(whole["extents"][name][1:], columns):
            assert not isinstance(target, str)
            target[first : first + len(column)] = column
    whole["failed"] += part["failed"]
    whole["reasons"] += [(first + index, reason) for index, reason in part["reasons"]]
    return whole

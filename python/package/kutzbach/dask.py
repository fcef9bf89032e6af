"""A sweep on many machines: each worker of Dask does shares of it, and writes each as a Parquet file.

Shares that have a file are not done again, so that a sweep which was broken off goes on. Workers that die are Dask's concern: it gives
their shares to others. ::

    from dask.distributed import Client
    import kutzbach, kutzbach.dask

    client = Client("scheduler:8786")
    files = kutzbach.dask.sweep(client, "four_bar.urdf", {"a": "0..2:2001", "b": "0..2:2001"}, "rows/", shards=256)
    rows = kutzbach.dask.table(files)
"""

from __future__ import annotations

import hashlib
import os
import uuid
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING, Any

from ._mechanism import Mechanism, load
from .sweeps import Progress, Values, joined, over_text, planned
from .sweeps import sweep as _sweep

if TYPE_CHECKING:
    import distributed
    import pyarrow


class Cancelled(Exception):
    """The sweep was given up while a share of it was under way."""


def share(
    mechanism: Mechanism,
    over: Mapping[str, str],
    folder: str,
    shard: tuple[int, int],
    question: Mapping[str, Any],
    cancelled: str | None = None,
) -> str:
    """Does one share, unless its file is there, and gives the file's name.

    `cancelled` names an event of Dask; where it is set, the share ends with :class:`Cancelled` within about a second, and nothing
    is written.
    """
    name = os.path.join(folder, f"{_key(mechanism, over, question)}_{shard[0]:06}_of_{shard[1]:06}.parquet")
    if not os.path.exists(name):
        watch = None if cancelled is None else _watch(cancelled)
        _sweep(mechanism, over, shard=shard, progress=watch, **question).to_parquet(name)
    return name


def _watch(name: str) -> Progress:
    """Looks between pieces of a share, which take half a second each, whether the sweep is given up."""
    import distributed

    event = distributed.Event(name)

    def watch(done: int, count: int) -> None:
        # The last piece is kept: all is done.
        if done < count and event.is_set():
            raise Cancelled(f"the sweep was given up after {done} of {count} rows")

    return watch


def _key(mechanism: Mechanism, over: Mapping[str, str], question: Mapping[str, Any]) -> str:
    """What rows depend on, in twelve letters: files of another sweep are not taken for its own."""
    # What a sweep states of itself has the file's hash, but not what it includes; the mechanism read has.
    head = planned(mechanism, over, **question).head(False)
    return hashlib.sha256(f"{head}\n{mechanism.native()}".encode()).hexdigest()[:12]


def sweep(
    client: distributed.Client,
    source: Mechanism | str | os.PathLike[str],
    over: Mapping[str, Values],
    folder: str | os.PathLike[str],
    *,
    shards: int,
    retries: int = 3,
    progress: Progress | None = None,
    **question: Any,
) -> list[str]:
    """Does a sweep on the workers of a client, and gives the names of its files in `folder`, in the order of the shares.

    All workers must see the folder, and the file of the mechanism if it was read from one. `shards` is the number of shares: a few for
    each worker, so that none is idle at the end, and enough that a share that is lost costs little; a share uses all processors of its
    machine. `retries` is how often a share that failed is done again. `progress` is told, after each share, how many rows are done and
    how many there are; ``dask.distributed.progress`` and the dashboard show more. `question` are arguments of :func:`kutzbach.sweep`:
    ``sample``, ``depth``, ``configuration``, ``closure_tolerance``.

    Where a share fails for good its error is raised, and on Ctrl-C ``KeyboardInterrupt``; in both cases the shares under way end within
    about a second, and no other is begun. Files of shares that are done stay, and the same call goes on.
    """
    import distributed

    if shards < 1:
        raise ValueError(f"a sweep has one share or more, but {shards} were asked for")
    mechanism = source if isinstance(source, Mechanism) else load(source)
    folder = os.fspath(folder)
    os.makedirs(folder, exist_ok=True)
    written = {name: over_text(name, values).removeprefix(f"{name}=") for name, values in over.items()}
    # What is wrong with the question is told here, and not by each worker.
    count = planned(mechanism, written, **question).count()
    cancelled = distributed.Event(f"kutzbach-{uuid.uuid4().hex}", client=client)
    # Of its own for each call: what an earlier call lets go of may reach the scheduler later than this.
    everywhere = client.scatter(mechanism, broadcast=True, hash=False)
    numbers = {
        client.submit(
            share, everywhere, written, folder, (number, shards), question, cancelled.name, retries=retries, pure=False
        ): number
        for number in range(1, shards + 1)
    }
    names: dict[int, str] = {}
    done = 0
    try:
        for future in distributed.as_completed(list(numbers)):
            number = numbers[future]
            names[number] = future.result()
            done += len(range(number - 1, count, shards))
            if progress is not None:
                progress(done, count)
    except BaseException:
        cancelled.set()
        client.cancel(list(numbers))
        raise
    return [names[number] for number in range(1, shards + 1)]


def table(files: Iterable[str | os.PathLike[str]]) -> pyarrow.Table:
    """The rows of all files as one table, in the order of their numbers: :meth:`kutzbach.Sweep.to_arrow` of the whole sweep."""
    import pyarrow.parquet

    return joined([pyarrow.parquet.read_table(os.fspath(file)) for file in files])

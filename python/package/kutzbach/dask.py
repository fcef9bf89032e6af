"""A sweep on many machines: each worker of Dask does shares of it, and writes each as a Parquet file.

Shares that have a file are not done again, so that a sweep which was broken off goes on. Workers that die are Dask's concern: it gives
their shares to others. ::

    from dask.distributed import Client
    import kutzbach, kutzbach.dask

    client = Client("scheduler:8786")
    files = kutzbach.dask.sweep(client, "four_bar.urdf", {"a": "0..2:2001", "b": "0..2:2001"}, "rows/", shards=256)
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from ._mechanism import Mechanism, load
from .sweeps import Values, over_text
from .sweeps import sweep as _sweep

if TYPE_CHECKING:
    import distributed


def share(
    mechanism: Mechanism, over: Mapping[str, str], folder: str, shard: tuple[int, int], question: Mapping[str, Any]
) -> str:
    """Does one share, unless its file is there, and gives the file's name."""
    name = os.path.join(folder, f"{_key(mechanism, over, question)}_{shard[0]:06}_of_{shard[1]:06}.parquet")
    if not os.path.exists(name):
        _sweep(mechanism, over, shard=shard, **question).to_parquet(name)
    return name


def _key(mechanism: Mechanism, over: Mapping[str, str], question: Mapping[str, Any]) -> str:
    """What a share depends on, in twelve letters: files of another sweep are not taken for its own."""
    asked = json.dumps([mechanism.native(), list(over.items()), sorted(question.items())])
    return hashlib.sha256(asked.encode()).hexdigest()[:12]


def sweep(
    client: distributed.Client,
    source: Mechanism | str | os.PathLike[str],
    over: Mapping[str, Values],
    folder: str | os.PathLike[str],
    *,
    shards: int,
    retries: int = 3,
    **question: Any,
) -> list[str]:
    """Does a sweep on the workers of a client, and gives the names of its files in `folder`, which all of them must see.

    `shards` is the number of shares: a few for each worker, so that none is idle at the end, and enough that a share that is lost costs
    little. `question` are arguments of :func:`kutzbach.sweep`: ``sample``, ``depth``, ``configuration``, ``closure_tolerance``. Ctrl-C
    cancels what is not done; ``dask.distributed.progress`` and the dashboard show how far it is.
    """
    mechanism = source if isinstance(source, Mechanism) else load(source)
    folder = os.fspath(folder)
    os.makedirs(folder, exist_ok=True)
    written = {name: over_text(name, values).removeprefix(f"{name}=") for name, values in over.items()}
    everywhere = client.scatter(mechanism, broadcast=True)
    futures = [
        client.submit(share, everywhere, written, folder, (number, shards), question, retries=retries, pure=False)
        for number in range(1, shards + 1)
    ]
    try:
        names: list[str] = client.gather(futures)
    except KeyboardInterrupt:
        client.cancel(futures)
        raise
    return names

"""Many variants: rows, shares, files."""

import os
import signal
import subprocess
import threading
import time
from collections.abc import Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import kutzbach
import numpy
import pytest


def test_rows_are_those_of_single_answers(linkage: kutzbach.Mechanism, linkage_text: str) -> None:
    rows = kutzbach.sweep(linkage, {"coupler": [3, Fraction(10, 3)], "crank": "1..9:3"})
    assert [row["variant"] for row in rows] == list(range(6))
    assert [row["crank"] for row in rows] == [1, 5, 9] * 2
    assert rows.column("coupler") == [3, 3, 3, "10/3", "10/3", "10/3"]
    for row in rows:
        single = kutzbach.analyse(kutzbach.load(linkage_text, crank=row["crank"], coupler=row["coupler"]), "verdict")
        told = (row["status"], row["verdict"], row["finite"], row["instantaneous"], row["pose"])
        assert told == (single.status, single.verdict, single.freedom, single.instantaneous, single.pose)
    assert rows.head["schema"] == "kutzbach-sweep-1"


def test_columns_become_arrays(linkage: kutzbach.Mechanism) -> None:
    rows = kutzbach.sweep(linkage, {"coupler": "1..8:8", "crank": "1..8:4"})
    crank, coupler, finite = rows.grid("crank", "coupler", "finite")
    assert (len(crank), len(coupler), finite.shape) == (4, 8, (8, 4))
    assert crank == pytest.approx(list(numpy.linspace(1, 8, 4)))
    assert numpy.isnan(finite).any() and (finite == 1).any()


def test_shares_are_the_whole(linkage: kutzbach.Mechanism) -> None:
    whole = kutzbach.sweep(linkage, {"crank": "1..8:23"}, depth="rank").rows
    shares = [kutzbach.sweep(linkage, {"crank": "1..8:23"}, depth="rank", shard=(number, 4)) for number in range(1, 5)]
    together = sorted((row for share in shares for row in share), key=lambda row: row["variant"])
    assert together == whole


@pytest.mark.parametrize("ending", ["csv", "jsonl"])
def test_files_are_those_of_the_command_line(linkage_text: str, tmp_path: Path, ending: str) -> None:
    program = os.environ.get("KUTZBACH_PROGRAM")
    if not program:
        pytest.skip("KUTZBACH_PROGRAM is not set to the program")
    source, own, theirs = tmp_path / "four_bar.urdf", tmp_path / f"own.{ending}", tmp_path / f"theirs.{ending}"
    source.write_text(linkage_text)
    seen: list[tuple[int, int]] = []
    kutzbach.sweep(
        kutzbach.load(source),
        {"crank": "1..8:101"},
        depth="motions",
        output=own,
        progress=lambda done, count: seen.append((done, count)),
    )
    arguments = ["sweep", str(source), "--over", "crank=1..8:101", "--depth", "motions", "-o", str(theirs)]
    subprocess.run([program, *arguments], check=True, capture_output=True)
    assert own.read_bytes() == theirs.read_bytes()
    assert seen[-1] == (101, 101)


def test_a_slip_is_an_error_and_a_bad_variant_a_row(linkage: kutzbach.Mechanism) -> None:
    with pytest.raises(kutzbach.MechanismError, match="crnk"):
        kutzbach.sweep(linkage, {"crnk": [1]})
    with pytest.raises(kutzbach.MechanismError):
        kutzbach.sweep(linkage, {"crank": "1..2"})
    rows = kutzbach.sweep(linkage, {"crank": ["1", "1/0"]}).rows
    assert [row["status"] for row in rows] == ["analysed", "invalid"]
    assert rows[1]["reason"]


def test_tables_of_arrow(linkage: kutzbach.Mechanism, tmp_path: Path) -> None:
    pytest.importorskip("pyarrow")
    from pyarrow import parquet

    rows = kutzbach.sweep(linkage, {"crank": "1..8:8"}, depth="motions")
    table = rows.to_arrow()
    assert table.num_rows == 8 and set(rows.columns) == set(table.column_names)
    rows.to_parquet(tmp_path / "rows.parquet")
    assert parquet.read_table(tmp_path / "rows.parquet").equals(table)
    assert [path.name for path in tmp_path.iterdir()] == ["rows.parquet"]


@pytest.fixture
def cluster() -> Iterator[Any]:
    """Two workers in threads of this process."""
    pytest.importorskip("pyarrow")
    distributed = pytest.importorskip("distributed")
    with distributed.Client(processes=False, n_workers=2, threads_per_worker=1, dashboard_address=None) as client:
        yield client


def test_workers_of_dask_write_shares(cluster: Any, linkage: kutzbach.Mechanism, tmp_path: Path) -> None:
    import kutzbach.dask

    over = {"crank": "1..8:10", "coupler": ["7/2", Fraction(10, 3), 3]}
    seen: list[tuple[int, int]] = []
    asked = (cluster, linkage, over, tmp_path)
    files = kutzbach.dask.sweep(*asked, shards=4, depth="motions", progress=lambda done, all: seen.append((done, all)))
    assert len(files) == 4
    assert [all for _, all in seen] == [30] * 4
    assert sorted(done for done, _ in seen) == [done for done, _ in seen] and seen[-1] == (30, 30)
    # Some shares have expressions among the numbers and some have none: together they are what the whole is.
    whole = kutzbach.sweep(linkage, over, depth="motions").to_arrow()
    assert kutzbach.dask.table(files).equals(whole, check_metadata=True)
    times = [Path(file).stat().st_mtime_ns for file in files]
    # What has a file is not done again; another question has files of its own.
    assert kutzbach.dask.sweep(*asked, shards=4, depth="motions") == files
    assert [Path(file).stat().st_mtime_ns for file in files] == times
    assert not set(kutzbach.dask.sweep(*asked, shards=4, depth="rank")) & set(files)


def test_shares_without_rows(cluster: Any, linkage: kutzbach.Mechanism, tmp_path: Path) -> None:
    import kutzbach.dask

    files = kutzbach.dask.sweep(cluster, linkage, {"crank": "1..2:2"}, tmp_path, shards=5)
    assert len(files) == 5 and kutzbach.dask.table(files).num_rows == 2
    with pytest.raises(ValueError, match="one share or more"):
        kutzbach.dask.sweep(cluster, linkage, {"crank": "1..2:2"}, tmp_path, shards=0)


def test_a_question_that_is_wrong_is_told_before_any_work(
    cluster: Any, linkage: kutzbach.Mechanism, tmp_path: Path
) -> None:
    import kutzbach.dask

    with pytest.raises(kutzbach.MechanismError, match="crnk"):
        kutzbach.dask.sweep(cluster, linkage, {"crnk": [1]}, tmp_path, shards=2)
    assert list(tmp_path.iterdir()) == []


def test_workers_end_at_ctrl_c(cluster: Any, linkage: kutzbach.Mechanism, tmp_path: Path) -> None:
    import kutzbach.dask

    def press() -> None:
        time.sleep(2)
        os.kill(os.getpid(), signal.SIGINT)

    thread = threading.Thread(target=press)
    thread.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            kutzbach.dask.sweep(cluster, linkage, {"crank": "1..2:10000000"}, tmp_path, shards=4, depth="everything")
    finally:
        thread.join()
    patience = time.monotonic() + 20
    while any(cluster.processing().values()) and time.monotonic() < patience:
        time.sleep(0.1)
    assert not any(cluster.processing().values())
    # Nothing is left half done, and nothing is computed that nobody waits for.
    assert list(tmp_path.iterdir()) == []
    time.sleep(2)
    before = time.process_time()
    time.sleep(0.5)
    assert time.process_time() - before < 0.3

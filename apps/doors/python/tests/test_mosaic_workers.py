# SPDX-License-Identifier: Apache-2.0
"""Mosaics whose workers are processes: those of Dask, and ones that are killed at any time."""

import os
import random
import signal
import subprocess
import sys
import threading

import numpy as np
import pytest
from conftest import terrain

import tetrakis
from tetrakis import mosaic

SMALL = dict(regions=64, tile=256, lossless=True)

ONE_RUN = """
import sys
import numpy as np, tetrakis
source, out, work = sys.argv[1:]
heights = np.load(source, mmap_mode="r")
tetrakis.mosaic.encode(heights, out, workdir=work, workers=2, lossless=True, regions=64, tile=256)
"""


@pytest.fixture(scope="module")
def ground(tmp_path_factory):
    """Where an array lies, and the stream of its mosaic."""
    folder = tmp_path_factory.mktemp("ground")
    heights = terrain(1100, 1300, "i2")
    np.save(folder / "a.npy", heights)
    mosaic.encode(heights, folder / "a.tks", workers=1, **SMALL)
    return folder / "a.npy", (folder / "a.tks").read_bytes()


@pytest.fixture(scope="module")
def cluster():
    """Of two processes. Workers of this test die more often than a scheduler expects."""
    distributed = pytest.importorskip("distributed")
    import dask

    settings = {
        "distributed.scheduler.allowed-failures": 100,
        "distributed.admin.log-format": "%(message)s",
        "logging.distributed": "critical",
    }
    with dask.config.set(settings), distributed.LocalCluster(
        n_workers=2, threads_per_worker=1, processes=True, dashboard_address=":0"
    ) as cluster, distributed.Client(cluster) as client:
        yield client


def test_dask_makes_the_same_bytes(tmp_path, ground, cluster):
    path, expected = ground
    told = []
    for name, source in dict(mapped=np.load(path, mmap_mode="r"), array=np.load(path)).items():
        mosaic.encode(source, tmp_path / name, client=cluster, progress=told.append, **SMALL)
        assert (tmp_path / name).read_bytes() == expected, name
    assert told[-1] == 1
    assert sorted(os.listdir(tmp_path)) == ["array", "mapped"]


def test_dask_arrays_are_read_by_workers(tmp_path, ground, cluster):
    array = pytest.importorskip("dask.array")
    path, expected = ground
    source = array.from_array(np.load(path, mmap_mode="r"), chunks=(300, 700))
    mosaic.encode(source, tmp_path / "a.tks", client=cluster, **SMALL)
    assert (tmp_path / "a.tks").read_bytes() == expected


class Broken:
    """A source of which no worker can read the southern windows."""

    shape, dtype = (1100, 1300), np.dtype("i2")

    def __init__(self):
        self.home = os.getpid()

    def __getitem__(self, window):
        rows, columns = window
        if rows.start > 500 and os.getpid() != self.home:
            raise LookupError("the storage is away")
        return np.zeros((rows.stop - rows.start, columns.stop - columns.start), "i2")


def test_what_a_source_raises_comes_from_dask(tmp_path, cluster):
    with pytest.raises(LookupError, match="away"):
        mosaic.encode(Broken(), tmp_path / "a.tks", client=cluster, **SMALL)
    assert not list(tmp_path.iterdir())


def is_at_work(process):
    return process is not None and process.status.name == "running"


def test_workers_of_dask_may_be_killed(tmp_path, ground, cluster):
    path, expected = ground
    killed, ended = [], threading.Event()
    # The other one stays: Dask does not replace a worker that is killed as soon as it has started.
    chosen_one = next(iter(cluster.cluster.workers.values()))

    def kill():
        chosen = random.Random(1)
        while len(killed) < 4 and not ended.wait(chosen.uniform(0.05, 0.3)):
            if is_at_work(chosen_one.process):
                killed.append(chosen_one.pid)
                os.kill(killed[-1], signal.SIGKILL)

    killer = threading.Thread(target=kill)
    killer.start()
    try:
        work = tmp_path / "work"
        mosaic.encode(np.load(path), tmp_path / "a.tks", client=cluster, workdir=work, **SMALL)
    finally:
        ended.set()
        killer.join()
    assert killed
    assert (tmp_path / "a.tks").read_bytes() == expected


def test_runs_may_be_killed(tmp_path, ground):
    """At any time; what each has done counts for the next one."""
    path, expected = ground
    command = [sys.executable, "-c", ONE_RUN, path, tmp_path / "a.tks", tmp_path / "work"]
    chosen, done = random.Random(1), []
    for _ in range(20):
        run = subprocess.Popen(command)
        try:
            assert run.wait(chosen.uniform(0.2, 0.6)) == 0
            break
        except subprocess.TimeoutExpired:
            run.kill()
            run.wait()
            done.append(len(list((tmp_path / "work").glob("*.part"))))
    assert done and done == sorted(done)
    assert subprocess.run(command, timeout=100).returncode == 0
    assert (tmp_path / "a.tks").read_bytes() == expected
    np.testing.assert_array_equal(tetrakis.open(expected).heights(), np.load(path))

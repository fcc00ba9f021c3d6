# SPDX-License-Identifier: LGPL-2.1-or-later
"""Members through a local Dask cluster's executor, unchanged."""

import pytest
from distributed import Client, LocalCluster
from test_build import APART, schedule

from BendTorsionWB import project
from BendTorsionWB.exchange.dxf import plate_dxf

pytestmark = [pytest.mark.optional, pytest.mark.slow]


def test_a_dask_cluster_gives_the_same_files(tmp_path):
    path = schedule(tmp_path / "two.xlsx", APART)
    wanted = project.Wanted(model=False, sheets=False)
    with (
        LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        executor = client.get_executor()
        given, jobs = project.read_jobs(path)
        spread = project.compute(given, jobs, executor)
        result = project.build(path, tmp_path / "out", executor=executor, wanted=wanted)
    here = project.compute(given, jobs)
    for name, item in here.items():
        assert [plate_dxf(plate) for plate in spread[name].record.plates] == [
            plate_dxf(plate) for plate in item.record.plates
        ]
    assert not result.failed and len(list((tmp_path / "out" / "plates").iterdir())) > 8

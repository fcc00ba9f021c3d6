# SPDX-License-Identifier: LGPL-2.1-or-later
"""Combined DXF files: joined by a worker or here, the same, and only when they are not there."""

from concurrent.futures import Future

import pytest
from flat_plates import member as record_of
from flat_plates import rectangle

from BendTorsionWB import combined_files
from BendTorsionWB.combined_files import CombinedFiles
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.parallel import Workers
from BendTorsionWB.exchange.dxf import plate_dxf
from BendTorsionWB.exchange.dxf_nest import nest_dxf
from BendTorsionWB.exchange.known_hashes import file_hash
from BendTorsionWB.exchange.output_folder import OutputFolder, read_manifest

KEYS = {"M1": "one", "M2": "two"}


def records():
    return [
        record_of(name, (rectangle(mark=f"{name}-T1"), rectangle(mark=f"{name}-B1", length=900.0)))
        for name in KEYS
    ]


def written(out, executor):
    """The names of the files, of a folder with those of the plates, and the folder."""
    folder = OutputFolder(out, read_manifest(out))
    for record in records():
        for plate in record.plates:
            folder.write(f"plates/{plate.mark}.dxf", plate_dxf(plate), "key", record.member)
    combined = CombinedFiles(folder, executor)
    combined.start_frames(records(), KEYS)
    combined.start(records(), KEYS)
    names = combined.begun
    combined.finish(lambda *told: None)
    assert combined.begun == []
    folder.close()
    return names, folder


@pytest.mark.parametrize("again", ["plates/M1.dxf", "plates/m1.dxf", "plates/Me\u0301.dxf"])
def test_a_build_never_writes_one_name_twice(tmp_path, again):
    folder = OutputFolder(tmp_path, {})
    for name in ("plates/M1.dxf", "plates/M\u00e9.dxf"):
        folder.write(name, b"first", "")
    for anew in (lambda: folder.write(again, b"second", ""), lambda: folder.begin(again)):
        with pytest.raises(BendTorsionError) as told:
            anew()
        assert told.value.findings[0].code == "file-name-twice"
    assert (tmp_path / "plates/M1.dxf").read_bytes() == b"first"


class Lost(Workers):
    """Workers that are lost with all they are given."""

    def submit(self, function, /, *arguments, **named):
        future = Future()
        future.set_exception(OSError("gone"))
        return future


@pytest.mark.parametrize("kind", [None, Workers, Lost])
def test_workers_join_what_is_joined_here(tmp_path, kind, monkeypatch):
    executor = kind(2) if kind else None
    try:
        names, folder = written(tmp_path, executor)
        plates = [plate for record in records() for plate in record.plates]
        expected = nest_dxf([(plate.mark, plate_dxf(plate)) for plate in plates])
        assert names == ["plates/all/20mm Q355B.dxf"]
        assert (tmp_path / names[0]).read_bytes() == expected
        assert read_manifest(tmp_path)[names[0]].sha256 == file_hash(tmp_path / names[0])
        monkeypatch.setattr(combined_files, "nest_dxf", lambda *given: pytest.fail("joined"))
        again, folder = written(tmp_path, executor)
        assert again == [] and names[0] in folder.now
    finally:
        if executor is not None:
            executor.shutdown()


def test_a_disk_that_is_full_for_the_worker_is_told(tmp_path):
    (tmp_path / "plates").mkdir()
    (tmp_path / "plates" / "all").write_text("in the way", encoding="utf-8")
    workers = Workers(1)
    try:
        with pytest.raises(BendTorsionError) as told:
            written(tmp_path, workers)
    finally:
        workers.shutdown()
    assert {finding.code for finding in told.value.findings} == {"file-not-written"}

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Hashes of files: not taken again of what nobody touched, taken of whatever was."""

import builtins
import hashlib
import os
import shutil
import time

import pytest

from BendTorsionWB.exchange import known_hashes
from BendTorsionWB.exchange.known_hashes import FILE, SETTLED, KnownHashes, file_hash

LATER = 3 * SETTLED


def sha256(path):
    return hashlib.sha256(path.read_bytes()).hexdigest()


@pytest.fixture
def folder(tmp_path):
    """Two files whose hashes were kept long after they were written."""
    out = tmp_path / "out"
    (out / ".cache").mkdir(parents=True)
    known = KnownHashes(out)
    for name in ("one", "two"):
        (out / name).write_bytes(name.encode() * 1000)
        assert known.of(name) == sha256(out / name)
    known.keep({"one", "two"}, time.time_ns() + LATER)
    # The disk's clock ticks.
    time.sleep(0.05)
    return out


@pytest.fixture
def read(monkeypatch):
    """Names of the files that were read for their hash."""
    names = []
    real = known_hashes._hashed

    def spy(path):
        names.append(os.path.basename(path))
        return real(path)

    monkeypatch.setattr(known_hashes, "_hashed", spy)
    return names


def test_what_nobody_touched_is_not_read_again(folder, read):
    known = KnownHashes(folder)
    assert [known.of(name) for name in ("one", "two")] == [
        sha256(folder / name) for name in ("one", "two")
    ]
    assert read == [] and known.of("three") == ""


def in_place(path):
    """Another content of the same length, in the same place, at the same time."""
    told = path.stat()
    with open(path, "r+b") as stream:
        stream.write(b"X")
    os.utime(path, ns=(told.st_atime_ns, told.st_mtime_ns))


def replaced(path):
    told = path.stat()
    other = path.with_name("other")
    other.write_bytes(b"Y" * told.st_size)
    os.utime(other, ns=(told.st_atime_ns, told.st_mtime_ns))
    os.replace(other, path)


def longer(path):
    with open(path, "ab") as stream:
        stream.write(b"Z")


@pytest.mark.parametrize("change", [in_place, replaced, longer])
def test_whatever_was_touched_is_read_again(folder, read, change):
    before = sha256(folder / "one")
    change(folder / "one")
    known = KnownHashes(folder)
    assert known.of("one") == sha256(folder / "one") != before and read == ["one"]
    (folder / "two").unlink()
    assert known.of("two") == ""


def test_a_file_changed_shortly_before_the_record_is_read_again(folder, read):
    (folder / "one").write_bytes(b"now")
    known = KnownHashes(folder)
    known.wrote("one", sha256(folder / "one"))
    changed = (folder / "one").stat().st_ctime_ns
    known.keep({"one"}, changed + SETTLED // 2)
    assert KnownHashes(folder).of("one") == sha256(folder / "one") and read == ["one"]
    known.keep({"one"}, changed + 2 * SETTLED)
    assert KnownHashes(folder).of("one") == sha256(folder / "one") and read == ["one"]


def test_a_file_changed_while_it_is_read_is_not_known(folder, read, monkeypatch):
    (folder / "one").write_bytes(b"begun")
    known = KnownHashes(folder)
    real = builtins.open

    class Slow:
        def __init__(self, stream):
            self.stream = stream

        def __enter__(self):
            return self

        def __exit__(self, *problem):
            self.stream.close()

        def fileno(self):
            return self.stream.fileno()

        def read(self, count):
            part = self.stream.read(count)
            if not part:
                longer(folder / "one")
            return part

    def opened(path, mode="r", *given, **named):
        stream = real(path, mode, *given, **named)
        return Slow(stream) if mode == "rb" else stream

    with monkeypatch.context() as patch:
        patch.setattr(builtins, "open", opened)
        known.of("one")
    known.keep({"one"}, time.time_ns() + LATER)
    read.clear()
    assert KnownHashes(folder).of("one") == sha256(folder / "one") and read == ["one"]


@pytest.mark.parametrize("content", ["", "one", "1 2 3 one", "1 2 3 4 5 one", "1 2 3 x 5 one"])
def test_a_damaged_record_is_none(folder, read, content):
    (folder / FILE).write_text(content, encoding="utf-8")
    assert KnownHashes(folder).of("one") == sha256(folder / "one") and read == ["one"]


def test_of_a_copied_folder_everything_is_read(folder, read, tmp_path):
    shutil.copytree(folder, tmp_path / "copy")
    assert KnownHashes(tmp_path / "copy").of("one") == sha256(folder / "one") and read == ["one"]


def test_a_folder_without_kept_results_stays_without(tmp_path):
    (tmp_path / "one").write_bytes(b"1")
    known = KnownHashes(tmp_path)
    known.of("one")
    known.keep({"one"}, time.time_ns() + LATER)
    assert [path.name for path in tmp_path.iterdir()] == ["one"]
    assert file_hash(tmp_path / "one") == sha256(tmp_path / "one")
    assert file_hash(tmp_path / "none") == ""

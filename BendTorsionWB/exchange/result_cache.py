# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results of members kept in a folder by a hash of all they come from; safe to delete at any time.

A file is a line with the hash of what follows, and a pickle that is read back with this program's
own classes and numpy's arrays only. What is damaged, foreign or of another version is as good as
absent: the member is computed again.
"""

from __future__ import annotations

import functools
import hashlib
import importlib
import io
import pickle
import sys
from collections.abc import Iterable
from contextlib import contextmanager
from dataclasses import dataclass, is_dataclass
from pathlib import Path

import numpy
import scipy

from BendTorsionWB import __version__
from BendTorsionWB.core.collection import without_collection
from BendTorsionWB.core.detailing import DetailedMember
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.memo import content_hash
from BendTorsionWB.core.unpacking import ARRAY, array_of
from BendTorsionWB.exchange.whole_file import write_whole

FOLDER = ".cache"
SUFFIX, PLAIN_SUFFIX = ".member", ".fragment"
_PACKAGE = Path(__file__).parent.parent
_OWN = "BendTorsionWB.core."
_ARRAYS = frozenset(
    {
        ("numpy", "ndarray"),
        ("numpy", "dtype"),
        ("numpy.core.multiarray", "_reconstruct"),
        ("numpy.core.multiarray", "scalar"),
        ("numpy.core.numeric", "_frombuffer"),
        ("numpy._core.multiarray", "_reconstruct"),
        ("numpy._core.multiarray", "scalar"),
        ("numpy._core.numeric", "_frombuffer"),
    }
)


@functools.cache
def program_key() -> str:
    """Hash of everything results depend on besides their input: version, source, libraries."""
    digest = hashlib.sha256(
        f"{__version__} {sys.version_info[:2]} {numpy.__version__} {scipy.__version__}".encode()
    )
    for path in sorted(_PACKAGE.rglob("*.py")):
        digest.update(str(path.relative_to(_PACKAGE)).encode() + path.read_bytes())
    return digest.hexdigest()


def key_of(*given) -> str:
    """The key of what is made from these values by this program."""
    return content_hash(program_key(), *given)


@dataclass(frozen=True)
class ResultCache:
    """The results kept in one folder."""

    folder: Path

    def has(self, key: str) -> bool:
        """Whether something is kept under this key, good or damaged."""
        return any(self._path(key, suffix).exists() for suffix in (SUFFIX, PLAIN_SUFFIX))

    def find(self, key: str) -> DetailedMember | None:
        """The result of this key, or None."""
        found = self._found(key, SUFFIX)
        return found if isinstance(found, DetailedMember) else None

    def find_plain(self, key: str) -> tuple | None:
        """What keep_plain kept under this key, or None."""
        found = self._found(key, PLAIN_SUFFIX)
        return found if isinstance(found, tuple) else None

    def _found(self, key: str, suffix: str) -> object:
        try:
            content = self._path(key, suffix).read_bytes()
        except OSError:
            return None
        stamp, _, body = content.partition(b"\n")
        if stamp != _stamp(key, body):
            return None
        try:
            with without_collection():
                return _Reader(io.BytesIO(body)).load()
        except (pickle.UnpicklingError, ArithmeticError, AttributeError, EOFError, ImportError):
            return None
        except (LookupError, TypeError, ValueError, MemoryError):
            return None

    def keep(self, key: str, result: DetailedMember, packed: bytes = b"") -> None:
        """Keep a result; packed: as a worker packed it. A folder that cannot be written to costs
        time at the next build only."""
        # Of members computed until an interrupt too.
        self._keep(key, SUFFIX, packed or pickle.dumps(result, 5), safe_point=False)

    def keep_plain(self, key: str, values: tuple) -> None:
        """Keep plain values, as `keep`."""
        self._keep(key, PLAIN_SUFFIX, pickle.dumps(values, 5))

    def _keep(self, key: str, suffix: str, body: bytes, safe_point: bool = True) -> None:
        try:
            write_whole(self._path(key, suffix), _stamp(key, body) + b"\n" + body, safe_point)
        except BendTorsionError:
            return

    def sweep(self, wanted: Iterable[str]) -> None:
        """Remove what is kept under all other keys."""
        keep = set(wanted)
        for path in self.folder.iterdir() if self.folder.is_dir() else ():
            if path.suffix in (SUFFIX, PLAIN_SUFFIX) and path.stem not in keep:
                with _unless_in_use():
                    path.unlink()

    def _path(self, key: str, suffix: str) -> Path:
        return self.folder / f"{key}{suffix}"


class _Reader(pickle.Unpickler):
    """Makes dataclasses and named tuples of the core and numpy arrays, and nothing else."""

    def find_class(self, module: str, name: str):
        return _class_of(module, name)


@functools.cache
def _class_of(module: str, name: str):
    if (module, name) in _ARRAYS:
        return array_of if name == ARRAY else getattr(importlib.import_module(module), name)
    if module.startswith(_OWN) and "." not in name:
        found = getattr(importlib.import_module(module), name, None)
        own = isinstance(found, type) and found.__module__ == module
        if own and (is_dataclass(found) or hasattr(found, "_fields")):
            return found
    raise pickle.UnpicklingError(f"{module}.{name} has no place in a result")


def _stamp(key: str, body: bytes) -> bytes:
    return hashlib.sha256(key.encode() + body).hexdigest().encode()


@contextmanager
def _unless_in_use():
    try:
        yield
    except OSError:
        return

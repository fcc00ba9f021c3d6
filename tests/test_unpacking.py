# SPDX-License-Identifier: LGPL-2.1-or-later
"""Results unpacked as they were packed, and pipes that take a whole one."""

import fcntl
import pickle

import numpy as np
import pytest

from BendTorsionWB.core.unpacking import array_of, unpacked
from BendTorsionWB.core.worker_processes import RESULT_SIZE, Workers

ARRAYS = [
    np.arange(7.0),
    np.arange(12.0).reshape(3, 4),
    np.asfortranarray(np.arange(12.0).reshape(3, 4)),
    np.zeros((0, 2)),
    np.array(3.5),
    np.array(["M1", "Größe"]),
    np.array([True, False]),
    np.arange(20)[::3],
]


def test_arrays_are_what_numpy_itself_makes_of_them():
    ARRAYS[0].flags.writeable = False
    packed = pickle.dumps((ARRAYS, {"same": ARRAYS[1]}), 5)
    (mine, more), (theirs, _) = unpacked(packed), pickle.loads(packed)
    for own, other, given in zip(mine, theirs, ARRAYS, strict=True):
        assert np.array_equal(own, given) and own.dtype == given.dtype
        assert own.shape == other.shape and own.strides == other.strides
        assert own.flags.writeable == other.flags.writeable
    assert more["same"] is mine[1]


def test_no_array_of_objects_is_made_of_bytes():
    with pytest.raises(pickle.UnpicklingError):
        array_of(bytes(8), np.dtype(object), (1,), "C")
    with pytest.raises(TypeError):
        array_of(bytes(8), np.dtype(float), (2,), "C")


def test_a_worker_does_not_wait_with_a_whole_result():
    workers = Workers(1)
    try:
        assert len(workers.submit(bytes, RESULT_SIZE).result()) == RESULT_SIZE
        pipe = workers._workers[0].answers.fileno()
        assert fcntl.fcntl(pipe, fcntl.F_GETPIPE_SZ) >= RESULT_SIZE
    finally:
        workers.shutdown()

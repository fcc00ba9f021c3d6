# SPDX-License-Identifier: LGPL-2.1-or-later
"""Zip archives put together of parts that were packed before, each by itself.

A deflated text is a chain of blocks; parts that end on a whole byte and look back to no other part
follow each other as they are. Only their checksums have to be combined.
"""

from __future__ import annotations

import struct
import zlib
from collections.abc import Iterable, Sequence
from dataclasses import dataclass

import numpy as np

LEVEL = 3
"""Of compression: tables shrink hardly more with higher ones, which take twice the time."""
_END = b"\x03\x00"
"""The last block, an empty one."""
_EARLIEST = (0, 0x21)
"""1 January 1980, the earliest time and date zip can tell: no time stamps in our files."""
_LARGEST = 2**32 - 1
_POLYNOMIAL = 0xEDB88320


@dataclass(frozen=True)
class Packed:
    """A part of a file: checksum and size of its text, and the text deflated."""

    crc: int
    size: int
    content: bytes


def packed(text: str) -> Packed:
    """Text as a part."""
    plain = text.encode("utf-8", "replace")
    deflate = zlib.compressobj(LEVEL, zlib.DEFLATED, -zlib.MAX_WBITS)
    content = deflate.compress(plain) + deflate.flush(zlib.Z_FULL_FLUSH)
    return Packed(zlib.crc32(plain), len(plain), content)


def zip_bytes(files: Iterable[tuple[str, Sequence[Packed]]]) -> bytes:
    """The archive of files by name, each of its parts. Raises OverflowError beyond 4 GB."""
    body, directory, place = [], [], 0
    files = list(files)
    powers = iter(_powers([part.size for _, parts in files for part in parts]))
    for name, parts in files:
        title = name.encode("ascii")
        crc, size = 0, 0
        for part in parts:
            crc, size = _product(next(powers), crc) ^ part.crc, size + part.size
        content = [*(part.content for part in parts), _END]
        length = sum(map(len, content))
        if max(size, place + length) > _LARGEST:
            raise OverflowError(f"{name}: too large for a zip archive")
        about = struct.pack("<5H3L2H", 20, 0, 8, *_EARLIEST, crc, length, size, len(title), 0)
        body += [b"PK\x03\x04", about, title, *content]
        directory.append(
            b"PK\x01\x02\x14\x00" + about + struct.pack("<3H2L", 0, 0, 0, 0, place) + title
        )
        place += 4 + len(about) + len(title) + length
    end = struct.pack(
        "<4H2LH", 0, 0, len(directory), len(directory), sum(map(len, directory)), place, 0
    )
    return b"".join([*body, *directory, b"PK\x05\x06", end])


def combined(first: int, second: int, size: int) -> int:
    """CRC-32 of two texts in a row from those of each and the size of the second: the first is
    multiplied by x to the power of the bits that follow, modulo the polynomial."""
    return _product(_powers([size])[0], first) ^ second


def _powers(sizes: Sequence[int]) -> list[int]:
    """x to the power of the bits of so many bytes each, modulo the polynomial; of all at once, as
    a workbook has thousands of parts."""
    left = np.array(sizes, np.int64)
    # 1, and x to the 8th, lowest power first.
    powers, factor = np.full(len(left), 0x80000000, np.int64), 0x00800000
    while left.any():
        powers = np.where(left & 1, _products(powers, factor), powers)
        factor = _product(factor, factor)
        left >>= 1
    return powers.tolist()


def _products(a: np.ndarray, b: int) -> np.ndarray:
    """`_product` of each of `a` with b."""
    total, bit = np.zeros_like(a), 0x80000000
    while bit:
        total ^= np.where(a & bit, b, 0)
        b = (b >> 1) ^ _POLYNOMIAL if b & 1 else b >> 1
        bit >>= 1
    return total


def _product(a: int, b: int) -> int:
    """Product of two polynomials over GF(2) modulo that of CRC-32, highest bit lowest power."""
    total, bit = 0, 0x80000000
    while bit:
        if a & bit:
            total ^= b
        b = (b >> 1) ^ _POLYNOMIAL if b & 1 else b >> 1
        bit >>= 1
    return total

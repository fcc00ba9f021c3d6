# SPDX-License-Identifier: LGPL-2.1-or-later
"""Names that every file system takes as the name of one file in one folder."""

from __future__ import annotations

import hashlib
import re
import unicodedata

from ..core.finding import unseen

LONGEST = 80
_REFUSED = re.compile(r'[<>:"/\\|?*#]')
_DEVICE = re.compile(r"(con|prn|aux|nul|com[0-9¹²³]|lpt[0-9¹²³]|conin\$|conout\$)", re.IGNORECASE)


def is_device(name: str) -> bool:
    """Whether Windows takes a file of this name, whatever its ending, for a device."""
    return bool(_DEVICE.fullmatch(name.partition(".")[0].strip()))


def same_file(name: str) -> str:
    """What names have in common that are one file where a file system tells neither capital letters
    nor how accents are coded, as on Windows and macOS."""
    return unicodedata.normalize("NFC", unicodedata.normalize("NFC", name).casefold())


def seen(text: str) -> str:
    """A text with `_` for what is not seen."""
    return text.translate(dict.fromkeys(map(ord, unseen(text)), "_"))


def file_name(text: str) -> str:
    """A text as the name of a file without its ending: what a file system would refuse or read as
    a path is `_`, and it is cut to LONGEST characters. Texts that differ have names that differ:
    one that is changed ends in six digits of its hash."""
    name = _REFUSED.sub("_", seen(text)).strip(" .")[:LONGEST].strip(" .")
    name = f"_{name}" if not name or is_device(name) else name
    if name == text:
        return name
    return f"{name}-{digits(text)}"


def digits(text: str) -> str:
    """Six digits of a text's hash, which tell names apart that would be one."""
    return hashlib.sha256(text.encode("utf-8", "replace")).hexdigest()[:6]

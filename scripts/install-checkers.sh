#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs the programs that tests marked `external` ask about our files: LibreCAD, LibreOffice and
# poppler from Debian; ifcopenshell and another Open CASCADE from PyPI, in build/checkers.
set -eu
cd "$(dirname "$0")/.."

libraries="ifcopenshell==0.9.0.post1 cadquery-ocp==8.0.1.1.0 pytest"
packages="librecad libreoffice-calc-nogui poppler-utils python3-venv"
failed=""

if command -v dpkg-query >/dev/null 2>&1; then
    missing=""
    for package in $packages; do
        state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
        [ "$state" = installed ] || missing="$missing $package"
    done
    # A LibreOffice with windows serves as well.
    command -v soffice >/dev/null 2>&1 && missing=$(echo "$missing" | sed 's/libreoffice-calc-nogui//')
    if [ -n "$(echo "$missing" | tr -d ' ')" ]; then
        privilege=""
        [ "$(id -u)" -eq 0 ] || privilege="sudo"
        echo "BendTorsion: installing checkers:$missing"
        $privilege apt-get update -q </dev/null >/dev/null || true
        $privilege env DEBIAN_FRONTEND=noninteractive apt-get install -y -q \
            --no-install-recommends $missing </dev/null >/dev/null || failed="$missing"
    fi
else
    echo "BendTorsion: not a Debian system, install the equivalents of: $packages" >&2
fi

stamp=build/checkers/.installed
if [ "$(cat "$stamp" 2>/dev/null)" != "$libraries" ]; then
    mkdir -p build
    python=$([ -x /usr/bin/python3 ] && echo /usr/bin/python3 || echo python3)
    if "$python" -m venv build/checkers &&
        build/checkers/bin/pip install --quiet --disable-pip-version-check $libraries; then
        echo "$libraries" >"$stamp"
    else
        failed="$failed $libraries"
    fi
fi

if [ -n "$failed" ]; then
    echo "BendTorsion: these checkers could not be installed:$failed" >&2
    exit 1
fi

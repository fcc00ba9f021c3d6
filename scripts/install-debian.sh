#!/bin/sh
# SPDX-License-Identifier: LGPL-2.1-or-later
# Installs the Debian packages BendTorsion runs and is tested with. Silent when none is missing.
set -eu

packages="freecad python3-numpy python3-scipy python3-ezdxf python3-openpyxl python3-pytest
python3-pytest-xdist python3-hypothesis
xvfb xauth libxtst6 poppler-utils fonts-wqy-microhei"

if ! command -v dpkg-query >/dev/null 2>&1; then
    echo "BendTorsion: not a Debian system, nothing installed; it needs the equivalents of:" \
        $packages >&2
    exit 0
fi

missing=""
for package in $packages; do
    state=$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$state" = installed ] || missing="$missing $package"
done
[ -n "$missing" ] || exit 0

command="apt-get install -y --no-install-recommends$missing"
if [ "$(id -u)" -eq 0 ]; then
    privilege=""
elif command -v sudo >/dev/null 2>&1; then
    privilege="sudo"
else
    echo "BendTorsion: installing needs root and there is no sudo; as root run:" \
        "apt-get update && $command" >&2
    exit 1
fi

echo "BendTorsion: installing$missing"
# A package list that cannot be refreshed may still be good enough to install from.
$privilege apt-get update -q </dev/null || true
$privilege env DEBIAN_FRONTEND=noninteractive $command -q </dev/null || {
    echo "BendTorsion: these packages could not be installed:$missing; as root run:" \
        "apt-get update && $command" >&2
    exit 1
}

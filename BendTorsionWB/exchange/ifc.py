# SPDX-License-Identifier: LGPL-2.1-or-later
"""IFC4: an assembly per delivery piece, a plate per plate with its exact boundary.

Written by hand as STEP physical file text (ISO 10303-21): the few entities needed are plain, and
the file has the same bytes for the same input.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence

import numpy as np

from ..core.site import AT_ORIGIN, SiteDatum
from .ifc_entities import Numbered, Written, listed, place_of, quoted, reference
from .ifc_fragment import Assembly, IfcFragment, ifc_fragment

_UNITS = (
    ("LENGTHUNIT", ".MILLI.", "METRE"),
    ("AREAUNIT", "$", "SQUARE_METRE"),
    ("VOLUMEUNIT", "$", "CUBIC_METRE"),
    ("PLANEANGLEUNIT", "$", "RADIAN"),
    ("MASSUNIT", ".KILO.", "GRAM"),
)


def project_name(project: str) -> str:
    """What a project without a name is called in the file."""
    return project or "BendTorsion"


def ifc_bytes(
    project: str, assemblies: Sequence[Assembly], site: SiteDatum = AT_ORIGIN, version: str = ""
) -> bytes:
    """The whole file of these assemblies."""
    fragment = ifc_fragment(project_name(project), assemblies)
    return b"".join(ifc_file(project, [fragment], site, version))


def ifc_file(
    project: str, fragments: Iterable[IfcFragment], site: SiteDatum = AT_ORIGIN, version: str = ""
) -> Iterator[bytes]:
    """The file of these members, part by part; the fragments are of this project."""
    project = project_name(project)
    yield _header(project, version).encode("ascii")
    file = Numbered()
    written = Written(project)
    places = [place_of(own) for own in _start(written, site)]
    text, names = file.append(written.done())
    yield text.encode("ascii")
    here, body, building = (names[place] for place in places)
    made: list[str] = []
    plates: dict[str, list[str]] = {}
    for fragment in fragments:
        text, names = file.append(fragment.entities, (here, body))
        yield text.encode("ascii")
        made += [names[place] for place in fragment.assemblies]
        for grade, own in fragment.plates:
            plates.setdefault(grade, []).extend(names[place] for place in own)
    every = [building, *made, *(name for own in plates.values() for name in own)]
    written = Written(project, len(every))
    _end(written, len(made), {grade: len(own) for grade, own in plates.items()})
    yield file.append(written.done(), every)[0].encode("ascii")
    yield b"ENDSEC;\nEND-ISO-10303-21;\n"


def _header(project: str, version: str) -> str:
    software = quoted("BendTorsion " + version)
    return (
        "ISO-10303-21;\nHEADER;\n"
        "FILE_DESCRIPTION(('ViewDefinition [ReferenceView_V1.2]'),'2;1');\n"
        f"FILE_NAME({quoted(project)},'1970-01-01T00:00:00',(''),(''),"
        f"{software},{software},'');\n"
        "FILE_SCHEMA(('IFC4'));\nENDSEC;\nDATA;\n"
    )


def _start(file: Written, site: SiteDatum) -> tuple[str, str, str]:
    """What comes before the members: the placement they lie in, the context of bodies, and the
    building."""
    units = listed(
        [file.add(f"IFCSIUNIT(*,.{k}.,{prefix},.{name}.)") for k, prefix, name in _UNITS]
    )
    units = file.add(f"IFCUNITASSIGNMENT({units})")
    model = file.add(
        f"IFCGEOMETRICREPRESENTATIONCONTEXT($,'Model',3,1.E-05,{file.placement((0, 0, 0))},$)"
    )
    body = file.add(
        f"IFCGEOMETRICREPRESENTATIONSUBCONTEXT('Body','Model',*,*,*,*,{model},$,.MODEL_VIEW.,$)"
    )
    name = quoted(file.project)
    project = file.add(f"IFCPROJECT({file.identity('project')},$,{name},$,$,$,$,({model}),{units})")
    x = (np.cos(site.rotation), np.sin(site.rotation), 0.0)
    lies = file.add(f"IFCLOCALPLACEMENT($,{file.placement((site.x, site.y, site.z), x=x)})")
    place = file.add(
        f"IFCSITE({file.identity('site')},$,'Site',$,$,{lies},$,$,.ELEMENT.,$,$,$,$,$)"
    )
    here = file.add(f"IFCLOCALPLACEMENT({lies},{file.placement((0, 0, 0))})")
    building = file.add(
        f"IFCBUILDING({file.identity('building')},$,{name},$,$,{here},$,$,.ELEMENT.,$,$,$)"
    )
    file.aggregate("project", project, [place])
    file.aggregate("site", place, [building])
    return here, body, building


def _end(file: Written, assemblies: int, plates: dict[str, int]) -> None:
    """What comes after the members, by numbers of their assemblies and, by material, plates."""
    places = iter(map(reference, range(1 + assemblies + sum(plates.values()))))
    building = next(places)
    if assemblies:
        made = listed([next(places) for _ in range(assemblies)])
        contained = file.identity("contained")
        file.add(f"IFCRELCONTAINEDINSPATIALSTRUCTURE({contained},$,$,$,{made},{building})")
    for grade, count in plates.items():
        own = listed([next(places) for _ in range(count)])
        material = file.add(f"IFCMATERIAL({quoted(grade)},$,'steel')")
        identity = file.identity("material", grade)
        file.add(f"IFCRELASSOCIATESMATERIAL({identity},$,$,$,{own},{material})")

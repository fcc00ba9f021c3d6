# SPDX-License-Identifier: LGPL-2.1-or-later
"""What each member gives to the tables and the report of its project: made by workers, and kept, so
that a change of one member does not make those of all others again."""

from __future__ import annotations

from collections.abc import Mapping
from concurrent.futures import Executor, Future
from dataclasses import dataclass
from functools import partial

from BendTorsionWB.core.axes.axis_input import AxisInput
from BendTorsionWB.core.detailing import MemberJob, uncertainty_of
from BendTorsionWB.core.finding import BendTorsionError
from BendTorsionWB.core.geometry.surface import Surface
from BendTorsionWB.core.lofting import MemberRecord
from BendTorsionWB.core.parallel import done_or
from BendTorsionWB.core.site import SiteDatum
from BendTorsionWB.exchange.html_report import plate_rows
from BendTorsionWB.exchange.patterns_picture import patterns_svg
from BendTorsionWB.exchange.report import member_line
from BendTorsionWB.exchange.result_cache import ResultCache, key_of
from BendTorsionWB.exchange.results_workbook import member_rows
from BendTorsionWB.exchange.xlsx_file import RowBlock
from BendTorsionWB.exchange.zip_parts import Packed
from BendTorsionWB.member_files import record_key


@dataclass(frozen=True)
class Fragment:
    """Rows of the workbook of results by table; the picture of all patterns; how far the axis is
    uncertain, mm, None where its points cannot tell; the line in report.json; the rows of plates in
    the HTML report."""

    rows: Mapping[str, RowBlock]
    patterns: str
    uncertainty: float | None
    told: str
    plates: str


@dataclass(frozen=True)
class _Given:
    record: MemberRecord
    axis: AxisInput
    surface: Surface | None
    site: SiteDatum
    highest: float


class Fragments:
    """The fragments of the members of a build. records: as they are written; keys: of the jobs."""

    def __init__(
        self,
        records: Mapping[str, MemberRecord],
        jobs: Mapping[str, MemberJob],
        keys: Mapping[str, str],
        site: SiteDatum,
        cache: ResultCache,
        executor: Executor | None,
    ):
        strains = [plate.strain_max for record in records.values() for plate in record.plates]
        self.highest = max(strains, default=0.0)
        """The strain the colours of the patterns run to."""
        self._cache = cache
        self._given = {
            name: _Given(record, jobs[name].axis, jobs[name].surface, site, self.highest)
            for name, record in records.items()
        }
        self.keys = {
            name: key_of("fragment", record_key(keys[name], record), site, self.highest)
            for name, record in records.items()
        }
        self._made: dict[str, Future | Fragment] = {}
        for name, given in self._given.items():
            if executor is not None and not cache.has(self.keys[name]):
                self._made[name] = executor.submit(fragment_of, given)

    def of(self, name: str) -> Fragment:
        """The fragment of a member."""
        found = self._made.get(name)
        if not isinstance(found, Fragment):
            self._made[name] = self._kept(name) if found is None else self._done(name, found)
        return self._made[name]

    def keep_all(self) -> None:
        """Keep those as well that no file of this build was in need of."""
        for name, found in list(self._made.items()):
            if isinstance(found, Future):
                self.of(name)

    def _kept(self, name: str) -> Fragment:
        plain = self._cache.find_plain(self.keys[name])
        return self._keep(name, fragment_of(self._given[name])) if plain is None else _read(plain)

    def _done(self, name: str, future: Future) -> Fragment:
        return self._keep(name, done_or(future, partial(fragment_of, self._given[name])))

    def _keep(self, name: str, made: Fragment) -> Fragment:
        self._cache.keep_plain(self.keys[name], _plain(made))
        return made


def fragment_of(given: _Given) -> Fragment:
    """Make the fragment of a member."""
    try:
        uncertainty = uncertainty_of(given.axis, given.surface).largest
    except BendTorsionError:
        # Too few points for two axes: nothing can be told, and the axis itself was good.
        uncertainty = None
    rows = member_rows(given.record, given.site)
    patterns = patterns_svg(given.record, given.highest)
    told, plates = member_line(given.record), plate_rows(given.record)
    return Fragment(rows, patterns, uncertainty, told, plates)


def _plain(made: Fragment) -> tuple:
    """As plain values, which are all a cache reads."""
    rows = {name: (own.count, *vars(own.packed).values()) for name, own in made.rows.items()}
    return rows, made.patterns, made.uncertainty, made.told, made.plates


def _read(plain: tuple) -> Fragment:
    rows, *rest = plain
    rows = {name: RowBlock(count, Packed(*own)) for name, (count, *own) in rows.items()}
    return Fragment(rows, *rest)

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Colours of plates and patterns, the strain map, and the pictures made of it."""

import math
import re
import xml.etree.ElementTree as tree

import curved_members
import numpy as np
import pytest
from flat_plates import rectangle

from BendTorsionWB.core.colour_scale import (
    ANCHORS,
    CLASS_COLOURS,
    COLOUR_BY,
    UNKNOWN,
    ColourScale,
    colouring,
    hex_text,
)
from BendTorsionWB.core.patterns.pattern import develop_plate
from BendTorsionWB.core.patterns.strain_map import strain_map
from BendTorsionWB.core.plates.plates import split_plates
from BendTorsionWB.sheets.strain_picture import strain_svg, write_strain_picture

PLATES = split_plates(curved_members.tapered(), {})[0]


def lightness(colour):
    """Relative luminance of sRGB (WCAG 2)."""
    colour = np.asarray(colour, float)
    linear = np.where(colour <= 0.04045, colour / 12.92, ((colour + 0.055) / 1.055) ** 2.4)
    return linear @ (0.2126, 0.7152, 0.0722)


def deuteranope(colour):
    """How a green-blind eye sees linear RGB (Viénot, Brettel & Mollon 1999)."""
    red, green, blue = np.asarray(colour, float) ** 2.2
    mixed = 0.29275 * red + 0.70725 * green
    return np.array([mixed, mixed, -0.02234 * red + 0.02234 * green + blue])


def test_the_scale_rises_in_lightness_and_holds_its_ends():
    scale = ColourScale(2.0, 6.0)
    values = np.linspace(2.0, 6.0, 101)
    assert (np.diff([lightness(colour) for colour in scale.colours(values)]) > 0).all()
    np.testing.assert_allclose(scale.colours(np.array([-9.0, 99.0])), ANCHORS[[0, -1]])
    np.testing.assert_allclose(scale.ticks(), [2.0, 3.0, 4.0, 5.0, 6.0])
    assert ColourScale(1.0, 1.0).colours(np.ones(3)).shape == (3, 3)


def test_every_colour_of_the_scale_stands_out_from_a_dark_view():
    dark = lightness((0x21 / 255, 0x25 / 255, 0x2B / 255))
    seen = [lightness(colour) for colour in ColourScale(0.0, 1.0).colours(np.linspace(0, 1, 101))]
    assert (min(seen) + 0.05) / (dark + 0.05) >= 3.0
    # Told apart at five steps, by a green-blind eye too.
    steps = [deuteranope(colour) for colour in ColourScale(0.0, 1.0).colours(np.linspace(0, 1, 5))]
    for one, other in zip(steps, steps[1:], strict=False):
        assert np.linalg.norm(one - other) > 0.1


def test_forming_classes_are_told_apart_by_a_green_blind_eye():
    seen = [deuteranope(colour) for colour in CLASS_COLOURS.values()]
    for i, one in enumerate(seen):
        for other in seen[i + 1 :]:
            assert np.linalg.norm(one - other) > 0.1


def test_every_figure_has_its_colour_and_legend():
    plates = [
        rectangle("A", forming="cold", strain_max=1e-5, length_error_max=0.0, thickness=16.0),
        rectangle("B", forming="flat", strain_max=3e-5, length_error_max=0.01, thickness=20.0),
        rectangle("C", strain_max=float("nan"), length_error_max=0.005, thickness=16.0),
    ]
    assert colouring(plates, "none").colours == ()
    assert colouring(plates, "forming").colours == (
        CLASS_COLOURS["cold"],
        CLASS_COLOURS["flat"],
        UNKNOWN,
    )
    assert [text for text, _ in colouring(plates, "forming").legend] == ["flat", "cold"]
    strains = colouring(plates, "strain")
    assert strains.colours[1] == pytest.approx(ANCHORS[-1]) and strains.colours[2] == UNKNOWN
    assert [text for text, _ in strains.legend][::4] == ["0.0 µm/m", "30.0 µm/m"]
    errors = colouring(plates, "length error")
    assert errors.colours[0] == pytest.approx(ANCHORS[0])
    assert errors.legend[-1][0] == "0.0100 mm" and errors.legend[-1][1] == errors.colours[1]
    thick = colouring(plates, "thickness")
    assert [text for text, _ in thick.legend] == ["16 mm", "20 mm"]
    assert thick.colours[0] == thick.colours[2] == thick.legend[0][1]
    assert {"none", "forming", "strain", "length error", "thickness"} < set(COLOUR_BY)
    assert hex_text((1.0, 0.5, 0.0)) == "#ff8000"


def test_figures_that_are_written_alike_have_one_colour_and_one_line():
    """On a scale of their own and on a common one; one that is told apart stays so."""
    plates = [rectangle(name, length_error_max=error) for name, error in (("A", 0.0), ("B", 4e-5))]
    for between in (None, (0.0, 4.5e-5)):
        found = colouring(plates, "length error", between)
        assert found.colours[0] == found.colours[1]
        assert found.legend == (("0.0000 mm", found.colours[0]),)
    alike = [rectangle(name, thickness=16.0 + wear) for name, wear in (("A", 0.0), ("B", 1e-9))]
    assert [text for text, _ in colouring(alike, "thickness").legend] == ["16 mm"]
    apart = colouring(plates, "length error", (0.0, 0.01))
    assert len(apart.legend) == 5 and apart.legend[0][1] == apart.colours[0]


def test_plates_coloured_by_how_they_are_bent_and_twisted():
    """Radius 8 m and 4 m are 0.125 and 0.25 1/m; a figure that is not there is grey."""
    formed = [develop_plate(plate) for plate in PLATES[:2]]
    plates = [
        rectangle("A", bending_radius_min=8000.0, forming_data=formed[0].forming_data),
        rectangle("B", bending_radius_min=4000.0, forming_data=formed[1].forming_data),
        rectangle("C", bending_radius_min=math.inf, forming_data=None),
    ]
    bent = colouring(plates, "curvature")
    assert [text for text, _ in bent.legend][::2] == ["0.0000 1/m", "0.1250 1/m", "0.2500 1/m"]
    assert bent.colours == tuple(colour for _, colour in (bent.legend[k] for k in (2, 4, 0)))
    for by, figure, unit in (
        ("twist", lambda data: math.degrees(1000.0 * data.twist_max), " °/m"),
        ("deviation", lambda data: data.flat_deviation, " mm"),
    ):
        found = colouring(plates, by)
        assert found.colours[2] == UNKNOWN
        largest = max(figure(plate.forming_data) for plate in plates[:2])
        assert found.legend[-1][0].endswith(unit)
        assert float(found.legend[-1][0].removesuffix(unit)) == pytest.approx(largest, abs=0.05)


@pytest.mark.parametrize("mode", ["edges", "energy"])
def test_the_strain_map_is_the_change_of_length_along_the_plate(mode):
    """Independent: flat over formed length of each cell's middle line, by its own points."""
    plate = PLATES[2]
    field = strain_map(plate, mode)
    rails = plate.rails.mid
    folds = plate.rails.mid_folds
    edges = [plate.start, *folds, plate.end]
    count = field.strain.shape[0]
    s = []
    for a, b in zip(edges[:-1], edges[1:], strict=True):
        s += np.linspace(a, b, max(2, int(np.ceil((b - a) / 100.0)) + 1))[:-1].tolist()
    s = np.array([*s, plate.end])
    assert len(s) == count + 1
    middle = 0.5 * (field.flat[:, :-1] + field.flat[:, 1:])
    flat = np.linalg.norm(np.diff(middle, axis=0), axis=2)
    w = (np.arange(12) + 0.5) / 12
    ends = rails(s).reshape(-1, 2, 3)
    points = ends[:, None, 0] + w[None, :, None] * (ends[:, 1] - ends[:, 0])[:, None]
    formed = np.linalg.norm(np.diff(points, axis=0), axis=2)
    wanted = flat / formed - 1.0
    # Chords of 100 mm differ by their sagitta only, alike on both sides but for normal curvature.
    chord = (100.0 / 20000.0) ** 2 / 24
    steady = np.abs(np.diff(s) - np.diff(s)[0]) < 50.0
    assert np.abs(field.strain - wanted)[steady].max() < 2.0 * chord + 1e-7
    assert field.scale.high == np.abs(field.strain).max()
    developed = develop_plate(plate, mode=mode)
    assert field.scale.high <= developed.strain_max * (1 + 1e-9)
    corners = np.concatenate(developed.outline)
    np.testing.assert_allclose(field.flat.reshape(-1, 2).min(axis=0), corners.min(axis=0), atol=1.0)
    np.testing.assert_allclose(field.lines[0], developed.lines[0].flat, atol=1e-9)


def test_the_picture_has_a_cell_for_each_value_and_the_legend_its_numbers(tmp_path):
    field = strain_map(PLATES[0])
    root = tree.fromstring(strain_svg(field))
    name = "{http://www.w3.org/2000/svg}"
    groups = root.findall(f"{name}g")
    cells = groups[0].findall(f"{name}polygon")
    assert len(cells) == field.strain.size
    worst = np.unravel_index(np.abs(field.strain).argmax(), field.strain.shape)
    assert cells[worst[0] * 12 + worst[1]].get("fill") == hex_text(ANCHORS[-1])
    texts = [text.text for text in root.findall(f"{name}text")]
    numbers = [float(re.match(r"[\d.]+", text)[0]) for text in texts[:5]]
    np.testing.assert_allclose(numbers, 1e6 * field.scale.ticks(), atol=0.051)
    assert texts[5].startswith("M1-T1: strain of laying it flat, mode edges")
    write_strain_picture(field, tmp_path / "map.svg")
    assert (tmp_path / "map.svg").read_text(encoding="utf-8") == strain_svg(field)


def test_the_png_shows_the_same_colours(tmp_path):
    from BendTorsionWB.sheets.pdf import start_qt

    field = strain_map(PLATES[0])
    write_strain_picture(field, tmp_path / "map.png")
    assert [item.name for item in tmp_path.iterdir()] == ["map.png"]
    _, qt_gui = start_qt()
    image = qt_gui.QImage(str(tmp_path / "map.png"))
    root = tree.fromstring(strain_svg(field))
    cell = root.findall("{http://www.w3.org/2000/svg}g")[0][len(field.strain) // 2 * 12 + 5]
    corners = np.array([p.split(",") for p in cell.get("points").split()], float)
    x, y = corners.mean(axis=0)
    colour = qt_gui.QColor(image.pixel(int(x), int(y)))
    wanted = qt_gui.QColor(cell.get("fill"))
    for part in ("red", "green", "blue"):
        assert abs(getattr(colour, part)() - getattr(wanted, part)()) <= 40

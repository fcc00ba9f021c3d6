# SPDX-License-Identifier: LGPL-2.1-or-later
"""The tolerances of the product, each with its one meaning; mm unless said otherwise."""

AXIS_ON_SURFACE = 0.005
"""A pulled axis leaves its surface by no more than this at the checked points."""

POINT_MOVED_WARNING = 1.0
"""A given point pulled farther than this onto the surface is worth a warning."""

POINTS_COINCIDE = 1e-3
"""Two given points closer than this are one point."""

MERGE_FRACTION_OF_MEAN_GAP = 0.15
"""Inner points closer than this fraction of the mean gap are merged before the fit."""

INTERPOLATION_RELATIVE = 1e-13
"""Piecewise interpolants reproduce their function to this fraction of its size."""

SAME_STATION = 1e-6
"""Arc lengths closer than this are the same place on the axis."""

STATION_AT_PLATE_END = 1.0
"""A station line closer than this to a plate's end line is the end line."""

STATION_AT_FOLD = 10.0
"""A station line closer than this to a fold is the fold line."""

FACES_FLUSH = 1e-6
"""Faces of two segments that differ by less than this are flush: no transition, no fold."""

RAILS_RESOLVED = 1e-4
"""Rails of plates are interpolated to this between their breaks, and most far better."""

THICKNESS_DRAWN = 0.1
"""Solids of twisted plates that are thicker than the plate by more than this are warned of, mm."""

SKIN_CORNER = 0.001
"""Corners of a skin between its stations; stations are doubled until they agree to this."""

VOLUME_RELATIVE = 1e-6
"""Largest relative difference between a solid's volume and the section integral."""

SMALLEST_SIZE = 0.1
"""A height, breadth or thickness of a section below this is an error, mm."""

LARGEST_SIZE = 50_000.0
"""A height, breadth or thickness of a section above this is an error, mm: a slip of the unit."""

NEAREST_STATIONS = 10.0
"""Measuring lines nearer to each other than this are an error, mm: nobody marks them, and there
would be no end to them."""

NARROWEST_STRIP = 10.0
"""A plate strip narrower than this between its neighbours is an error, mm."""

SHORTEST_PLATE = 10.0
"""Joints that would leave a plate, or the part of one before a fold, shorter than this are an
error."""

SEAM_LENGTH = 1e-6
"""Edges of a flat pattern in `edges` mode keep their length to this."""

WITNESS_INSET = 50.0
"""Distance of witness points from the plate's edge, on the marking face."""

SOLIDS_OVERLAP_VOLUME = 1e-3
"""mm3: two members whose solids share more than this intersect."""

LOCKED_IN_TWIST_WIDTH = 0.037
"""Twist rate times width (rad) above which `edges` locks in stress worth a warning."""

WELD_FIGURE = 1e-3
"""Legs, gaps, snipes (mm) and angles (degrees) of welds that miss their limit by less are at it."""

MANHOLE_LIGAMENT = 50.0
"""Least plate left between a manhole and the edge of its diaphragm or end plate."""

# SPDX-License-Identifier: LGPL-2.1-or-later
"""Products, assemblies and colours of a STEP file (ISO 10303-21, AP214), as CAD programs do them.

All parts stand at the origin of the model, so that one placement serves a whole assembly.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from ..core.colour_scale import Colour

SHARED = (
    "APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#2)",
    "APPLICATION_CONTEXT('core data for automotive mechanical design processes')",
    "PRODUCT_CONTEXT('',#2,'mechanical')",
    "PRODUCT_DEFINITION_CONTEXT('part definition',#2,'design')",
)
"""The first records of every file, numbered from 1."""
_MECHANICAL, _DESIGN = 3, 4


@dataclass(frozen=True)
class Product:
    """Numbers of a product's definition and of its shape."""

    definition: int
    shape: int


class Records:
    """Records in their order, as a template with a place for each number, and these; numbers of
    occurrences count downwards from -1."""

    def __init__(self, taken: int):
        self.last = taken
        self.occurrences = 0
        self.lines: list[str] = []
        self.numbers: list[int] = []

    def add(self, body: str, *numbers: int) -> int:
        """Append a record; its number. body: `%d` in it for each of the numbers."""
        self.last += 1
        self.lines.append(f"#%d = {body};\n")
        self.numbers += (self.last, *numbers)
        return self.last

    def placement(self) -> int:
        """The origin of the model."""
        origin = self.add("CARTESIAN_POINT('',(0.,0.,0.))")
        axes = [self.add(f"DIRECTION('',({axis}))") for axis in ("0.,0.,1.", "1.,0.,0.")]
        return self.add("AXIS2_PLACEMENT_3D('',#%d,#%d,#%d)", origin, *axes)

    def product(self, name: str, items: Sequence[int], context: int) -> Product:
        """A product whose shape is these items: a placement, and a solid if it is a part."""
        text = string(name)
        product = self.add(f"PRODUCT({text},{text},'',(#%d))", _MECHANICAL)
        self.add("PRODUCT_RELATED_PRODUCT_CATEGORY('part',$,(#%d))", product)
        formation = self.add("PRODUCT_DEFINITION_FORMATION('','',#%d)", product)
        definition = self.add("PRODUCT_DEFINITION('design','',#%d,#%d)", formation, _DESIGN)
        owner = self.add("PRODUCT_DEFINITION_SHAPE('','',#%d)", definition)
        kind = "ADVANCED_BREP_SHAPE_REPRESENTATION" if len(items) > 1 else "SHAPE_REPRESENTATION"
        places = ",".join("#%d" for _ in items)
        shape = self.add(f"{kind}('',({places}),#%d)", *items, context)
        self.add("SHAPE_DEFINITION_REPRESENTATION(#%d,#%d)", owner, shape)
        return Product(definition, shape)

    def put(self, part: Product, name: str, whole: Product, placements: tuple[int, int]) -> None:
        """A part in an assembly; placements: of the part and of the assembly."""
        self.occurrences += 1
        use = self.add(
            f"NEXT_ASSEMBLY_USAGE_OCCURRENCE('%d',{string(name)},'',#%d,#%d,$)",
            -self.occurrences,
            whole.definition,
            part.definition,
        )
        owner = self.add("PRODUCT_DEFINITION_SHAPE('Placement','Placement of an item',#%d)", use)
        move = self.add("ITEM_DEFINED_TRANSFORMATION('','',#%d,#%d)", *placements)
        relation = self.add(
            "( REPRESENTATION_RELATIONSHIP('','',#%d,#%d) "
            "REPRESENTATION_RELATIONSHIP_WITH_TRANSFORMATION(#%d) "
            "SHAPE_REPRESENTATION_RELATIONSHIP() )",
            part.shape,
            whole.shape,
            move,
        )
        self.add("CONTEXT_DEPENDENT_SHAPE_REPRESENTATION(#%d,#%d)", relation, owner)

    def style(self, colour: Colour) -> int:
        """The style of a surface colour (ISO 10303-46)."""
        red, green, blue = (f"{part:.6f}" for part in colour)
        made = self.add(f"COLOUR_RGB('',{red},{green},{blue})")
        for body in (
            "FILL_AREA_STYLE_COLOUR('',#%d)",
            "FILL_AREA_STYLE('',(#%d))",
            "SURFACE_STYLE_FILL_AREA(#%d)",
            "SURFACE_SIDE_STYLE('',(#%d))",
            "SURFACE_STYLE_USAGE(.BOTH.,#%d)",
            "PRESENTATION_STYLE_ASSIGNMENT((#%d))",
        ):
            made = self.add(body, made)
        return made

    def paint(self, solid: int, style: int, context: int) -> None:
        """Give a solid a style."""
        item = self.add("STYLED_ITEM('colour',(#%d),#%d)", style, solid)
        kind = "MECHANICAL_DESIGN_GEOMETRIC_PRESENTATION_REPRESENTATION"
        self.add(f"{kind}('',(#%d),#%d)", item, context)


def string(value: str) -> str:
    """A string within a template: quotes and backslashes doubled, beyond ASCII as UTF-8, as the
    kernel writes and reads it."""
    return "'" + value.replace("\\", "\\\\").replace("'", "''").replace("%", "%%") + "'"

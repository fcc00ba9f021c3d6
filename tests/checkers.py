# SPDX-License-Identifier: LGPL-2.1-or-later
"""Programs we did not write that look at our files: where they are, and what they say.

Run as a script by the interpreter of build/checkers, it prints what its libraries read as JSON.
"""

import json
import shutil
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
PYTHON = ROOT / "build" / "checkers" / "bin" / "python"
INSTALL = "sh scripts/install-checkers.sh"


def missing(tool):
    """Whether a tool is not installed."""
    if tool in ("ifcopenshell", "OCP"):
        found = list((ROOT / "build" / "checkers").glob(f"lib/python3*/site-packages/{tool}"))
        return not (found and PYTHON.exists())
    return shutil.which(tool) is None


def ask(task, path):
    """What a library of build/checkers reads from a file."""
    process = subprocess.run(
        [PYTHON, __file__, task, path], capture_output=True, encoding="utf-8", timeout=300
    )
    assert process.returncode == 0, process.stderr[-2000:]
    return json.loads(process.stdout)


def read_ifc(path):
    """Faults the schema and its rules find, and the plates with their assemblies."""
    import ifcopenshell
    import ifcopenshell.util.element as element
    import ifcopenshell.validate as validate

    file = ifcopenshell.open(path)
    log = validate.json_logger()
    validate.validate(file, log, express_rules=True)
    plates = {}
    for plate in file.by_type("IfcPlate"):
        sets = element.get_psets(plate)
        quantities = sets["Qto_PlateBaseQuantities"]
        assembly = element.get_aggregate(plate)
        plates[plate.Name] = {
            "id": plate.GlobalId,
            "assembly": assembly.Name,
            "volume": quantities["NetVolume"],
            "weight": quantities["NetWeight"],
            "quantities": quantities,
            "properties": sets["BendTorsion_Plate"],
            "material": element.get_material(plate).Name,
        }
    [site] = file.by_type("IfcSite")
    place = site.ObjectPlacement.RelativePlacement
    return {
        "schema": file.schema,
        "faults": [str(statement.get("message", statement)) for statement in log.statements],
        "plates": plates,
        "site": list(place.Location.Coordinates),
        "assemblies": len(file.by_type("IfcElementAssembly")),
    }


def read_ifc_volumes(path):
    """Volume of each plate's shape, m3, by the geometry kernel of ifcopenshell."""
    import ifcopenshell
    import ifcopenshell.geom
    import ifcopenshell.util.shape as shape

    file = ifcopenshell.open(path)
    settings = ifcopenshell.geom.settings()
    settings.set("mesher-linear-deflection", 1e-4)
    settings.set("mesher-angular-deflection", 0.02)
    return {
        plate.Name: shape.get_volume(ifcopenshell.geom.create_shape(settings, plate).geometry)
        for plate in file.by_type("IfcPlate")
    }


def read_step(path):
    """Name, colour, volume (mm3) and validity of each solid, and names of all assemblies."""
    from OCP.BRepCheck import BRepCheck_Analyzer
    from OCP.BRepGProp import BRepGProp
    from OCP.collections import Sequence_TDF_Label
    from OCP.GProp import GProp_GProps
    from OCP.Quantity import Quantity_Color
    from OCP.STEPCAFControl import STEPCAFControl_Reader
    from OCP.TCollection import TCollection_ExtendedString
    from OCP.TDataStd import TDataStd_Name
    from OCP.TDocStd import TDocStd_Document
    from OCP.TopAbs import TopAbs_SOLID
    from OCP.TopExp import TopExp_Explorer
    from OCP.XCAFDoc import XCAFDoc_ColorType, XCAFDoc_DocumentTool

    document = TDocStd_Document(TCollection_ExtendedString("XmlXCAF"))
    reader = STEPCAFControl_Reader()
    reader.SetNameMode(True)
    reader.SetColorMode(True)
    reader.ReadFile(path)
    reader.Transfer(document)
    shapes = XCAFDoc_DocumentTool.ShapeTool_s(document.Main())
    colours = XCAFDoc_DocumentTool.ColorTool_s(document.Main())

    def name(label):
        found = TDataStd_Name()
        return (
            found.Get().ToExtString() if label.FindAttribute(TDataStd_Name.GetID_s(), found) else ""
        )

    labels = Sequence_TDF_Label()
    shapes.GetShapes(labels)
    solids, assemblies = [], []
    for k in range(1, labels.Length() + 1):
        label = labels.Value(k)
        if shapes.IsAssembly_s(label):
            assemblies.append(name(label))
            continue
        shape = shapes.GetShape_s(label)
        explorer = TopExp_Explorer(shape, TopAbs_SOLID)
        count = 0
        while explorer.More():
            count += 1
            explorer.Next()
        figures, colour = GProp_GProps(), Quantity_Color()
        BRepGProp.VolumeProperties_s(shape, figures)
        kinds = (XCAFDoc_ColorType.XCAFDoc_ColorSurf, XCAFDoc_ColorType.XCAFDoc_ColorGen)
        painted = any(colours.GetColor(shape, kind, colour) for kind in kinds)
        sub = Sequence_TDF_Label()
        shapes.GetSubShapes_s(label, sub)
        for j in range(1, sub.Length() + 1):
            own = shapes.GetShape_s(sub.Value(j))
            painted |= any(colours.GetColor(own, kind, colour) for kind in kinds)
        solids.append(
            {
                "name": name(label),
                "solids": count,
                "volume": figures.Mass(),
                "valid": BRepCheck_Analyzer(shape).IsValid(),
                "colour": [colour.Red(), colour.Green(), colour.Blue()] if painted else None,
            }
        )
    return {"solids": solids, "assemblies": assemblies}


if __name__ == "__main__":
    sys.path[:] = [
        entry for entry in sys.path if Path(entry or ".").resolve() != Path(__file__).parent
    ]
    print(json.dumps(globals()[sys.argv[1]](sys.argv[2])))

# SPDX-License-Identifier: LGPL-2.1-or-later
"""In FreeCAD's window: a STEP file imported; label, parent, volume and colour of each object."""

import json
import os
import traceback

import FreeCAD
import ImportGui

seen = {}
try:
    # Imported as one compound otherwise.
    settings = FreeCAD.ParamGet("User parameter:BaseApp/Preferences/Mod/Import/hSTEP")
    settings.SetBool("ReadShapeCompoundMode", False)
    document = FreeCAD.newDocument("Read")
    ImportGui.insert(os.environ["BENDTORSION_WINDOW_STEP"], "Read")
    seen["objects"] = []
    for obj in document.Objects:
        # FreeCAD 1.0 gives each assembly axes and planes of its own.
        if obj.TypeId in ("App::Origin", "App::Line", "App::Plane", "App::Point"):
            continue
        own = {"label": obj.Label, "parents": [parent.Label for parent in obj.InList]}
        if obj.isDerivedFrom("Part::Feature"):
            shape = obj.Shape
            own |= {"solids": len(shape.Solids), "valid": shape.isValid(), "volume": shape.Volume}
            own |= {"x": shape.BoundBox.XMin, "colour": list(obj.ViewObject.ShapeColor[:3])}
        seen["objects"].append(own)
except Exception:  # noqa: BLE001 - told by the test
    seen["failed"] = traceback.format_exc()
with open(os.environ["BENDTORSION_WINDOW_RESULT"], "w", encoding="utf-8") as stream:
    json.dump(seen, stream)
os._exit(0)

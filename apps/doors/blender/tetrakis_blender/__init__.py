# SPDX-License-Identifier: Apache-2.0
"""Blender add-on: File, Import, Tetrakis opens terrains and scans (.tks)."""

from pathlib import Path

import bpy
from bpy.props import BoolProperty, IntProperty, StringProperty
from bpy_extras.io_utils import ImportHelper

from .shape import shape_of

bl_info = {
    "name": "Tetrakis (.tks)",
    "author": "Tetrakis",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "File > Import",
    "description": "Opens terrains and scans, whole or any first part of them",
    "category": "Import-Export",
}


def _tetrakis():
    """The package inside the add-on (scripts/doors blender), or one that Python has."""
    try:
        from . import tetrakis
    except ImportError:
        import tetrakis
    return tetrakis


def _mesh(shape):
    mesh = bpy.data.meshes.new(shape.name)
    mesh.from_pydata(shape.vertices.tolist(), [], shape.faces.tolist())
    mesh.polygons.foreach_set("use_smooth", [True] * len(mesh.polygons))
    if shape.corner_uv is not None:
        layer = mesh.uv_layers.new(name="UVMap")
        layer.data.foreach_set("uv", shape.corner_uv.ravel())
        mesh.materials.append(_material(shape))
    mesh.update()
    return mesh


def _material(shape):
    rows, columns = shape.image.shape[:2]
    image = bpy.data.images.new(shape.name, columns, rows, alpha=True)
    image.pixels.foreach_set(shape.image.ravel())
    image.update()
    image.pack()
    material = bpy.data.materials.new(shape.name)
    material.use_nodes = True
    nodes, links = material.node_tree.nodes, material.node_tree.links
    texture = nodes.new("ShaderNodeTexImage")
    texture.image = image
    surface = next(node for node in nodes if node.type == "BSDF_PRINCIPLED")
    links.new(texture.outputs["Color"], surface.inputs["Base Color"])
    return material


class ImportTks(bpy.types.Operator, ImportHelper):
    """Opens a terrain or a scan (.tks)"""

    bl_idname = "import_mesh.tks"
    bl_label = "Import TKS"
    bl_options = {"REGISTER", "UNDO"}

    filename_ext = ".tks"
    filter_glob: StringProperty(default="*.tks", options={"HIDDEN"})
    triangles: IntProperty(
        name="Triangles", description="At most; 0: all", default=200000, min=0
    )
    kilobytes: IntProperty(
        name="Kilobytes", description="Read no more of the file; 0: all", default=0, min=0
    )
    y_is_up: BoolProperty(
        name="Y is up", description="Turn scans that have y up", default=False
    )

    def execute(self, context):
        tetrakis = _tetrakis()
        try:
            limit = 1000 * self.kilobytes or None
            with tetrakis.open(self.filepath, bytes=limit) as stream:
                shape = shape_of(stream, self.triangles, self.y_is_up)
        except (tetrakis.TksError, OSError) as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        if not shape.name:
            shape = shape._replace(name=Path(self.filepath).stem)
        thing = bpy.data.objects.new(shape.name, _mesh(shape))
        context.collection.objects.link(thing)
        bpy.ops.object.select_all(action="DESELECT")
        thing.select_set(True)
        context.view_layer.objects.active = thing
        return {"FINISHED"}


def _in_menu(menu, _context):
    menu.layout.operator(ImportTks.bl_idname, text="Tetrakis (.tks)")


def register():
    bpy.utils.register_class(ImportTks)
    bpy.types.TOPBAR_MT_file_import.append(_in_menu)


def unregister():
    bpy.types.TOPBAR_MT_file_import.remove(_in_menu)
    bpy.utils.unregister_class(ImportTks)

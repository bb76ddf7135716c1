# Grows trees with Blender's add-on "Sapling Tree Gen" as it makes them by default, and writes each as OUT/NAME.glb:
#   blender --background --factory-startup --python sapling.py -- OUT NAME=PRESET...
# PRESET is one of the add-on's own files (white_birch, douglas_fir, ...) or "default" for what its button makes. Leaves and
# thickness (off in its default) are switched on; nothing else is changed. Sapling gives no materials: bark and leaves get
# plain colours here.
import ast
import os
import sys

import numpy

numpy.bool = bool  # Blender 3.4's exporter uses a name that numpy 1.24 dropped
import addon_utils
import bpy

addon_utils.enable("add_curve_sapling")
words = sys.argv[sys.argv.index("--") + 1:]
presets = os.path.join(os.path.dirname(sys.modules["add_curve_sapling"].__file__), "presets")


def plain(name, colour):
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    material.use_backface_culling = False
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    shader.inputs["Roughness"].default_value = 0.9
    return material


for word in words[1:]:
    name, preset = word.split("=")
    bpy.ops.wm.read_factory_settings(use_empty=True)
    addon_utils.enable("add_curve_sapling")
    settings = {}
    if preset != "default":
        with open(os.path.join(presets, preset + ".py")) as file:
            settings = ast.literal_eval(file.read())
    settings = {**settings, "do_update": True, "showLeaves": True, "bevel": True}
    known = bpy.ops.curve.tree_add.get_rna_type().properties.keys()
    bpy.ops.curve.tree_add(**{k: v for k, v in settings.items() if k in known})
    bark, leaf = plain("bark", (0.16, 0.13, 0.10)), plain("leaf", (0.07, 0.12, 0.04))
    for thing in list(bpy.context.scene.objects):
        leaves = "leaves" in thing.name
        thing.data.materials.clear()
        thing.data.materials.append(leaf if leaves else bark)
    path = os.path.join(words[0], name + ".glb")
    bpy.ops.export_scene.gltf(filepath=path, export_apply=True)
    print("SAPLING", path, [(o.name, o.type) for o in bpy.context.scene.objects])

#!/usr/bin/env bash
# Imports glTF files into a headless Blender and says what arrived; with a picture's name draws the last one:
#   scripts/check_blender.sh FILE.glb... [OUT.png]
# Needs Blender 3.4 or later (apt-get install blender; large, so no part of setup.sh and of the tests).
# Prints a line for each file: objects, triangles, materials, cameras, lights, and the extras of one tree.
# Exit status: 0 all opened, 1 a file was refused, 2 usage or no Blender.
set -euo pipefail
[ $# -ge 1 ] || { sed -n 2,6p "$0" | cut -c3- >&2; exit 2; }
command -v blender >/dev/null || { echo "no Blender: apt-get install blender" >&2; exit 2; }
script=$(mktemp --suffix=.py)
trap 'rm -f "$script"' EXIT
cat >"$script" <<'PYTHON'
import math
import sys

import numpy

numpy.bool = bool  # Blender 3.4's importer uses a name that numpy 1.24 dropped
import bpy
from mathutils import Vector

words = sys.argv[sys.argv.index("--") + 1:]
picture = words.pop() if words[-1].endswith(".png") else None
refused = 0
for name in words:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    try:
        # "Lighting Mode: Unitless" of the import panel, else the sun's strength is taken for lux; Blender 4 renamed it.
        known = bpy.ops.import_scene.gltf.get_rna_type().properties.keys()
        mode = next(k for k in ("export_import_convert_lighting_mode", "convert_lighting_mode") if k in known)
        bpy.ops.import_scene.gltf(filepath=name, **{mode: "COMPAT"})
    except RuntimeError as error:
        print(f"BOSQUET {name}: refused: {str(error).strip().splitlines()[-1]}")
        refused += 1
        continue
    objects = bpy.context.scene.objects
    meshes = [o for o in objects if o.type == "MESH"]
    triangles = 0
    for o in meshes:
        o.data.calc_loop_triangles()
        triangles += len(o.data.loop_triangles)
    low = Vector((math.inf,) * 3)
    high = -low
    for o in meshes:
        for corner in o.bound_box:
            p = o.matrix_world @ Vector(corner)
            low = Vector(map(min, low, p))
            high = Vector(map(max, high, p))
    tree = next((o for o in objects if "species" in o.keys()), None)
    said = {k: tree[k] for k in ("species", "height_m") if k in tree.keys()} if tree else None
    kinds = {kind: sum(o.type == kind for o in objects) for kind in ("CAMERA", "LIGHT")}
    suns = [round(light.energy, 3) for light in bpy.data.lights]
    print(f"BOSQUET {name}: {len(meshes)} meshes, {triangles} triangles, {len(bpy.data.materials)} materials, "
          f"{kinds['CAMERA']} cameras, {kinds['LIGHT']} lights {suns}, box {[round(x, 2) for x in (*low, *high)]}, tree {said}")
if picture and refused < len(words):
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.device = "CPU"
    scene.cycles.samples = 16
    scene.cycles.use_denoising = False  # Debian builds Blender without a denoiser
    scene.render.resolution_x, scene.render.resolution_y = 960, 540
    scene.world = bpy.data.worlds.new("sky")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.6, 0.75, 0.95, 1.0)
    scene.world.node_tree.nodes["Background"].inputs[1].default_value = 0.6  # beside a sun of strength 3
    camera = next((o for o in objects if o.type == "CAMERA"), None)
    if camera is None:
        camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
        scene.collection.objects.link(camera)
        middle, reach = (low + high) / 2, (high - low).length
        camera.location = middle + Vector((0.25, -1.0, 0.45)).normalized() * 1.1 * reach
        camera.rotation_euler = (middle - camera.location).to_track_quat("-Z", "Y").to_euler()
    scene.camera = camera
    scene.render.filepath = picture
    bpy.ops.render.render(write_still=True)
sys.exit(1 if refused else 0)
PYTHON
status=0
blender --background --factory-startup --python-exit-code 1 --python "$script" -- "$@" >"$script.log" 2>&1 || status=1
grep '^BOSQUET' "$script.log" | cut -d' ' -f2- || { cat "$script.log" >&2; status=1; }
[ $status = 0 ] || tail -5 "$script.log" >&2
rm -f "$script.log"
exit $status

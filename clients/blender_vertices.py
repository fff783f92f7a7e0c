"""Run by Blender's Python: opens a file and prints where chosen vertices of every body are at frames.

Arguments: file, frames a second, a JSON list of frames. Prints, for each frame, for each body by name, the
world positions of vertices 0, n/3 and 2n/3 of its mesh and the same in the frame of the mesh; z is up.
"""

import json
import sys

import bpy


def main(path, fps, frames):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.fps = fps
    if path.endswith(".glb"):
        bpy.ops.import_scene.gltf(filepath=path)
    else:
        bpy.ops.wm.usd_import(filepath=path)
    found = []
    for frame in frames:
        scene.frame_set(frame)
        found.append(dict(bodies(bpy.context.evaluated_depsgraph_get())))
    print("FOUND " + json.dumps({
        "meshes": len(bpy.data.meshes),
        "metres": scene.unit_settings.scale_length,
        "frames": found,
    }))


def bodies(graph):
    """Name, and pairs of vertices in the mesh and in the world; instances by the name of their parent."""
    for instance in graph.object_instances:
        shown = instance.object
        if shown.type != "MESH":
            continue
        vertices = shown.data.vertices
        chosen = [vertices[k * len(vertices) // 3].co for k in range(3)]
        name = instance.parent.name if instance.is_instance else shown.name
        placed = instance.matrix_world
        yield name, [[list(v), list(placed @ v)] for v in chosen]


main(sys.argv[1], int(sys.argv[2]), json.loads(sys.argv[3]))

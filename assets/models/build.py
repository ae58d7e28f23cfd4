"""Builds the models of this folder.

    blender -b --factory-startup -P assets/models/build.py                     all of them
    blender -b --factory-startup -P assets/models/build.py -- --only cabin     one
    ... -- --only cabin --preview driver,lever --no-occlusion --facing --out DIR   while modelling

Models are written beside this file (or to --out), textures and pictures to a temporary folder (--work).
"""
import os
import sys
import tempfile
import time

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, HERE)
sys.dont_write_bytecode = True

from craft import export, facing, materials, occlusion, preview, scene, textures, visibility  # noqa: E402

ARGUMENTS = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else []


def option(name, default=None):
    return ARGUMENTS[ARGUMENTS.index(name) + 1] if name in ARGUMENTS else default


def look(cameras, hide=None):
    """Renders the pictures that --preview requests."""
    names = [n for n in option("--preview", "").split(",") if n in cameras]
    preview.render(names, cameras, option("--samples", "48"), option("--size", "960x540"), hide)


def build_cabin(path):
    from cabin import assemble, sight

    assemble.build()
    scene.drop_leftovers()
    if "--facing" in ARGUMENTS:
        print("seen from behind, % of rays:", facing.seen_from_behind(sight.VIEWPOINTS))
    parts = scene.meshes()
    seen = visibility.seen_faces(parts, sight.VIEWPOINTS, sight.MOVING)
    if "--no-occlusion" not in ARGUMENTS:
        occlusion.add(seen, sight.density)
    print("%d faces are never seen and left out" % visibility.cut(parts, seen, sight.MOVING))
    look(sight.CAMERAS, sight.HIDDEN)
    export.write(path, keep_uv=("KnobCap",))


def build_gearbox(path):
    from gearbox import assemble

    assemble.build()
    scene.drop_leftovers()
    look(assemble.CAMERAS)
    export.write(path)


def build_hand(path):
    from hand import assemble

    assemble.build(path)


def build_road(path):
    from road import assemble

    assemble.build()
    scene.drop_leftovers()
    look(assemble.CAMERAS)
    export.write(path)


MODELS = {"cabin": build_cabin, "gearbox": build_gearbox, "hand": build_hand, "road": build_road}


def main():
    textures.FOLDER = option("--work") or tempfile.mkdtemp(prefix="models_")
    os.makedirs(textures.FOLDER, exist_ok=True)
    for name, build in MODELS.items():
        if option("--only", name) != name:
            continue
        start = time.time()
        scene.clear()
        materials.clear()
        textures.restart()
        path = os.path.join(option("--out", HERE), name + ".glb")
        build(path)
        print("%s: %d bytes, %.0f s" % (path, os.path.getsize(path), time.time() - start))


main()

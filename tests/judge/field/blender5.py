"""Judges how Cycles lights a floor from a sphere, a triangle, a rectangle and a disk, in the package of Blender.

    pip install bpy==5.0.1 && python blender5.py [--samples 4096] [--json FILE]

Every case renders the radiance that a diffuse floor reflects under one light of radiance 1, with multiple importance sampling, and divides it
by the closed form in double precision: a right renderer prints 1. The floor is the plane z = 0, its point (x, y, 0), and lights shine
downwards. Exits with 1 for a finding, with 2 for a wrong argument.
"""

import argparse
import json
import math
import os
import sys
import tempfile
import warnings

import numpy as np

ALBEDO = 0.5
SIGMAS, BIAS = 6.0, 5e-3


# Irradiances at (x, y, 0) with the normal (0, 0, 1) under a light of radiance 1.


def under_polygon(corners, x, y):
    """Lambert's formula; all corners are above the floor."""
    corners = [np.asarray(corner, np.float64) - (x, y, 0) for corner in corners]
    total = 0.0
    for a, b in zip(corners, corners[1:] + corners[:1]):
        cross = np.cross(a, b)
        length = np.linalg.norm(cross)
        if length > 0:
            total += math.atan2(length, a @ b) * cross[2] / length
    return abs(total) / 2


def under_sphere(height):
    """A sphere of radius 1 straight above, whole above the floor."""
    return math.pi / height**2


def under_disk(height, x):
    """A disk of radius 1 that is parallel to the floor."""
    far = x * x + height * height
    return math.pi / 2 * (1 - (far - 1) / math.sqrt((far + 1) ** 2 - 4 * x * x))


# What is rendered.

# Half-sizes by x and y, the height of the light, and the point of the floor.
RECTANGLES = [
    *((1, 1, h, 0, 0) for h in (1000, 100, 10, 1, 0.1, 0.01, 0.004, 0.002, 0.001)),
    *((1, 1, h, 0.5, 0.25) for h in (1, 0.1, 0.01, 0.004, 0.002, 0.001)),
    *((1, 1, h, 1.5, 0) for h in (1, 0.1, 0.01, 0.001, 0.00025)),
    *((1, 1, h, 3, 0) for h in (0.1, 0.01, 0.005, 0.0005)),
    *((100, 1, h, 150, 0) for h in (10, 1, 0.1)),
    *((100, 1, h, 0, 0) for h in (100, 10, 1)),
]
TRIANGLES = [
    *((1, 1, h, 0, 0) for h in (1000, 100, 10, 3, 1)),
    *((1, 1, h, 0.5, 0.5) for h in (0.1, 0.01, 0.001)),
    *((1, 1, h, 1.5, 0) for h in (0.1, 0.01, 0.001, 0.00025)),
    *((1, 1, h, 100, 0) for h in (100, 20, 5, 2)),
    *((100, 1, h, 0, 2) for h in (100, 10, 1, 0.1)),
    *((10000, 1, h, 0, 2) for h in (10000, 1000)),
]
SPHERES = [1e5, 1e4, 3e3, 1e3, 300, 100, 30, 10, 3, 1.5, 1.1, 1.01]
DISKS = [(h, x) for x in (0, 0.5, 1.5) for h in (100, 10, 1, 0.1, 0.01)]


class Room:
    """A floor, and a camera that sees one millimetre of it from above."""

    def __init__(self, bpy, samples, folder):
        self.bpy, self.path = bpy, os.path.join(folder, "floor.exr")
        bpy.ops.wm.read_factory_settings(use_empty=True)
        scene = self.scene = bpy.context.scene
        scene.render.engine = "CYCLES"
        settings = scene.cycles
        settings.device, settings.samples, settings.max_bounces = "CPU", samples, 0
        settings.use_denoising = settings.use_adaptive_sampling = False
        settings.sample_clamp_direct = settings.light_sampling_threshold = 0
        scene.render.resolution_x = scene.render.resolution_y = 8
        scene.render.filter_size = 0.01
        scene.view_settings.view_transform = "Raw"
        scene.render.image_settings.file_format, scene.render.image_settings.color_depth = "OPEN_EXR", "32"
        scene.render.filepath = self.path
        scene.world = bpy.data.worlds.new("dark")
        scene.world.use_nodes = True
        scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0
        bpy.ops.mesh.primitive_plane_add(size=100)
        self.floor = bpy.context.object
        self.floor.data.materials.append(self.material("ShaderNodeBsdfDiffuse", Color=(ALBEDO,) * 3 + (1,)))
        camera = bpy.data.cameras.new("camera")
        camera.type, camera.ortho_scale = "ORTHO", 1e-4
        self.camera = self.add(camera, (0, 0, 10))
        scene.camera = self.camera

    def material(self, shader, **inputs):
        material = self.bpy.data.materials.new(shader)
        material.use_nodes = True
        tree = material.node_tree
        tree.nodes.clear()
        node, output = tree.nodes.new(shader), tree.nodes.new("ShaderNodeOutputMaterial")
        for name, value in inputs.items():
            node.inputs[name].default_value = value
        tree.links.new(node.outputs[0], output.inputs[0])
        return material

    def add(self, data, location):
        thing = self.bpy.data.objects.new("thing", data)
        thing.location = location
        self.scene.collection.objects.link(thing)
        return thing

    def light(self, kind, height, area, **shape):
        """A light of radiance 1, whose power in watts is its area times pi, for spheres without "soft falloff", which makes them disks that face the point."""
        data = self.bpy.data.lights.new("light", kind)
        for name, value in shape.items():
            setattr(data, name, value)
        data.energy = math.pi * area
        data.cycles.use_multiple_importance_sampling = True
        return self.add(data, (0, 0, height))

    def reflected(self, thing, x, y):
        """The radiance of the floor at (x, y), and its standard error by the 64 pixels; removes the light."""
        thing.visible_camera = False
        self.floor.location, self.camera.location = (x, y, 0), (x, y, 10)
        self.bpy.ops.render.render(write_still=True)
        image = self.bpy.data.images.load(self.path, check_existing=False)
        pixels = np.array(image.pixels[:], np.float64).reshape(-1, 4)[:, 0]
        self.bpy.data.images.remove(image)
        self.bpy.data.objects.remove(thing)
        return pixels.mean(), pixels.std() / math.sqrt(len(pixels) - 1)


def cases(room):
    """Names, lights, points, and irradiances."""
    for a, b, h, x, y in RECTANGLES:
        light = room.light("AREA", h, 4 * a * b, shape="RECTANGLE", size=2 * a, size_y=2 * b)
        corners = [(-a, -b, h), (a, -b, h), (a, b, h), (-a, b, h)]
        yield "rectangle", f"{2 * a} by {2 * b} at z = {h}", light, x, y, under_polygon(corners, x, y)
    for a, b, h, x, y in TRIANGLES:
        corners = [(-a, -b, h), (a, -b, h), (-a, b, h)]
        mesh = room.bpy.data.meshes.new("triangle")
        mesh.from_pydata(corners, [], [(0, 1, 2)])
        glow = room.material("ShaderNodeEmission", Strength=1.0)
        glow.cycles.emission_sampling = "FRONT_BACK"
        mesh.materials.append(glow)
        yield "triangle", f"({-a}, {-b}), ({a}, {-b}), ({-a}, {b}) at z = {h}", room.add(mesh, (0, 0, 0)), x, y, under_polygon(corners, x, y)
    for h in SPHERES:
        light = room.light("POINT", h, 4 * math.pi, shadow_soft_size=1.0, use_soft_falloff=False)
        yield "sphere", f"radius 1 at z = {h:g}", light, 0, 0, under_sphere(h)
    for h, x in DISKS:
        light = room.light("AREA", h, math.pi, shape="DISK", size=2.0)
        yield "disk", f"radius 1 at z = {h:g}", light, x, 0, under_disk(h, x)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--samples", type=int, default=4096, help="samples of each of the 64 pixels")
    parser.add_argument("--json", help="a file for all cases")
    arguments = parser.parse_args()
    if not 1 <= arguments.samples <= 1 << 20:
        parser.error(f"--samples is from 1 to 1048576, not {arguments.samples}")
    try:
        import bpy
    except ImportError as error:
        parser.error(f"pip install bpy==5.0.1 comes first: {error}")

    warnings.simplefilter("ignore", DeprecationWarning)
    rows = []
    with tempfile.TemporaryDirectory() as folder:
        room = Room(bpy, arguments.samples, folder)
        # Blender writes its progress to standard output, past Python.
        output = os.fdopen(os.dup(1), "w")
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        print(f"Blender {bpy.app.version_string} ({bpy.app.build_hash.decode()}), {arguments.samples} samples", file=output, flush=True)
        for shape, name, light, x, y, irradiance in cases(room):
            wanted = ALBEDO / math.pi * irradiance
            got, error = room.reflected(light, x, y)
            wrong = not abs(got - wanted) <= SIGMAS * error + BIAS * wanted
            rows.append({"shape": shape, "light": name, "x": x, "y": y, "ratio": got / wanted, "error": error / wanted, "wrong": wrong})
            mark = "WRONG" if wrong else "right"
            print(f"{mark}  {got / wanted:<10.4g} ± {error / wanted:<8.2g} {shape} {name}, floor at ({x:g}, {y:g})", file=output, flush=True)
    if arguments.json:
        try:
            with open(arguments.json, "w", encoding="utf-8") as file:
                json.dump({"version": bpy.app.version_string, "cases": rows}, file, indent=1)
        except OSError as error:
            print(f"{arguments.json}: {error.strerror}", file=sys.stderr)
            return 2
    return 1 if any(row["wrong"] for row in rows) else 0


if __name__ == "__main__":
    sys.exit(main())

"""Traces the same camera rays and shadow rays through the triangles of scenes by this renderer and by Embree, on one core.

    pip install mitsuba numpy                      # and LLVM, which DRJIT_LIBLLVM_PATH names
    cargo build --release -p etendue-benches --example trace_rays
    python3 benches/peers/rays_beside_embree.py target/release/examples/trace_rays FOLDER SCENE...

Mitsuba's LLVM variants trace as many rays at once by Embree as the processor has lanes. Rates are millions of rays per second of the
processor's time, the best of 30 times; Embree's are the better of `coherent` and not. For shadow rays that is its nearest hit within the distance of
the light, which is more than to tell whether there is one: `ray_test` of Mitsuba 3.9 returned in less time than any trace takes. The last
columns are fractions of the rays.
"""
import os, subprocess, sys, time

os.sched_setaffinity(0, {0})
import numpy as np
import drjit as dr
import mitsuba as mi

mi.set_variant('llvm_ad_rgb')
dr.set_thread_count(1)


def rays(path, limited):
    columns = np.fromfile(path, '<f4').reshape(7 if limited else 6, -1)
    origin, direction = mi.Point3f(*columns[:3]), mi.Vector3f(*columns[3:6])
    if not limited:
        return mi.Ray3f(origin, direction)
    return mi.Ray3f(origin, direction, mi.Float(columns[6]), 0, mi.Color0f())


def rate(trace, count):
    fastest = float('inf')
    for _ in range(30):
        dr.sync_thread()
        start = time.process_time()
        dr.eval(trace())
        dr.sync_thread()
        fastest = min(fastest, time.process_time() - start)
    return count / fastest / 1e6


binary, folder, *scenes = sys.argv[1:]
print('| scene | triangles | camera rays: ours | Embree | shadow rays: ours | Embree, nearest | Embree finds a hit | unoccluded |')
print('|---|---|---|---|---|---|---|---|')
for scene in scenes:
    name, triangles, camera, shadow = subprocess.run([binary, scene, folder], check=True, capture_output=True, text=True).stdout.split()
    points = np.fromfile(f'{folder}/triangles.f32', '<f4').reshape(-1, 3)
    mesh = mi.Mesh('mesh', len(points), len(points) // 3)
    parameters = mi.traverse(mesh)
    parameters['vertex_positions'] = points.ravel()
    parameters['faces'] = np.arange(len(points), dtype=np.uint32)
    parameters.update()
    world = mi.load_dict(dict(type='scene', mesh=mesh))
    first, second = rays(f'{folder}/camera.f32', False), rays(f'{folder}/shadow.f32', True)
    dr.eval(first, second)
    count = dr.width(first.o)
    both = lambda of: max(rate(lambda: of(coherent), count) for coherent in [True, False])
    hits = both(lambda coherent: world.ray_intersect_preliminary(first, coherent).t)
    nearest = both(lambda coherent: world.ray_intersect_preliminary(second, coherent).t)
    found = np.isfinite(np.array(world.ray_intersect_preliminary(first, True).t)).mean()
    lit = 1 - np.array(world.ray_test(second, True)).mean()
    print(f'| {os.path.basename(name)} | {triangles} | {camera} | {hits:.2f} | {shadow} | {nearest:.2f} | {found:.4f} | {lit:.4f} |', flush=True)

#!/usr/bin/env python3
"""A pass of ARAP by other libraries beside a pass of stylizing, on the same meshes, by turns.

  bench/peer_arap.py STYLIZE_BENCH [--into RAW.json] [--benchmark_filter=REGEX]

STYLIZE_BENCH is the program of bench/stylize_bench.cpp: its pass does the local step with a normal each, the global
step, looks targets up again and computes both energies. libigl's (Python's igl) has the same neighbourhoods, spokes and
rims, Open3D's spokes alone; neither has normals, targets or energies. A pass is what ten passes more take, the median of
five. Libraries that are not installed are left out. --into adds the times to results of STYLIZE_BENCH. Other arguments are Google Benchmark's and pass unheeded.
"""

import argparse
import importlib.util
import json
import pathlib
import re
import statistics
import subprocess
import time

SIZES = [3000, 10000, 20000, 50000, 200000]
PASSES = 10
REPETITIONS = 5


def torus(vertices):
    """That of bench/stylize_bench.cpp, but for the way it is turned."""
    import numpy

    around = round(vertices**0.5)
    a, b = numpy.meshgrid(numpy.arange(around), numpy.arange(around), indexing="ij")
    u, v = 2 * numpy.pi * a.ravel() / around, 2 * numpy.pi * b.ravel() / around
    radius = 1 + 0.4 * numpy.cos(v)
    positions = numpy.stack([radius * numpy.cos(u), radius * numpy.sin(u), 0.4 * numpy.sin(v)], axis=1)
    number = lambda i, j: (i % around) * around + j % around
    corners = [number(a, b), number(a + 1, b), number(a + 1, b + 1), number(a, b + 1)]
    p, q, r, s = (corner.ravel() for corner in corners)
    triangles = numpy.concatenate([numpy.stack([p, q, r], axis=1), numpy.stack([p, r, s], axis=1)])
    return positions, triangles


def igl_passes(positions, triangles):
    import igl
    import numpy

    held = numpy.array([0, 1], dtype=numpy.int32)
    targets = positions[held] * [[1.0], [1.01]]
    data = igl.ARAPData()
    data.energy = igl.ARAP_ENERGY_TYPE_SPOKES_AND_RIMS
    igl.arap_precomputation(positions, triangles.astype(numpy.int64), 3, held, data)

    def run(passes):
        data.max_iter = passes
        start = time.perf_counter()
        igl.arap_solve(targets, data, positions)
        return time.perf_counter() - start

    return run


def open3d_passes(positions, triangles):
    import open3d

    open3d.utility.set_verbosity_level(open3d.utility.VerbosityLevel.Error)
    vectors = open3d.utility.Vector3dVector
    mesh = open3d.geometry.TriangleMesh(vectors(positions), open3d.utility.Vector3iVector(triangles))
    held, targets = open3d.utility.IntVector([0, 1]), vectors(positions[[0, 1]] * [[1.0], [1.01]])

    def run(passes):
        start = time.perf_counter()
        mesh.deform_as_rigid_as_possible(held, targets, max_iter=passes)
        return time.perf_counter() - start

    return run


def of_a_pass(run):
    """Seconds. What is prepared in the same call is in both."""
    return (run(PASSES + 1) - run(1)) / PASSES


def our_pass(program, vertices):
    command = [program, "--benchmark_format=json", f"--benchmark_filter=^passes/arap/opencl/double/{vertices}/"]
    result = json.loads(subprocess.run(command, check=True, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL).stdout)
    return result["benchmarks"][0]["real_time"] / 1e3 / PASSES


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", metavar="STYLIZE_BENCH")
    parser.add_argument("--into", metavar="RAW.json")
    parser.add_argument("--benchmark_filter", default="", metavar="REGEX")
    arguments = parser.parse_known_args()[0]
    runs = []
    peers = {"igl": igl_passes, "open3d": open3d_passes}
    for library, passes_of in peers.items():
        if not importlib.util.find_spec(library):
            continue
        for vertices in SIZES:
            name = f"passes/{library}_arap/{vertices}"
            if not re.search(arguments.benchmark_filter, name):
                continue
            run = passes_of(*torus(vertices))
            pairs = [(of_a_pass(run), our_pass(arguments.program, vertices)) for _ in range(REPETITIONS)]
            theirs, ours = (1e3 * statistics.median(times) for times in zip(*pairs))
            runs.append({"name": name, "real_time": PASSES * theirs, "ours": PASSES * ours, "time_unit": "ms"})
            print(f"{name:32} {theirs:9.2f} ms, ours {ours:9.2f} ms: {theirs / ours:.1f} times as long")
    if arguments.into:
        path = pathlib.Path(arguments.into)
        results = json.loads(path.read_text(encoding="utf-8"))
        results["benchmarks"] += runs
        path.write_text(json.dumps(results), encoding="utf-8")


if __name__ == "__main__":
    main()

#!/usr/bin/python3
"""ARAP (as rigid as possible) by Open3D, for scale: the authors' meshes and handles, 10 iterations.

  bench/peer_open3d.py [--benchmark_filter=REGEX]

ARAP does other work than reshaping, as bench/peer_cgal_bench.cpp tells; the energy is the one asked of CGAL there. Open3D
weighs, factors and iterates in one call, so the times are of all that: compare with the sum of CGAL's two. Prints the
median of three. Other arguments are Google Benchmark's and pass unheeded.
"""

import argparse
import json
import pathlib
import re
import statistics
import time

import numpy
import open3d

GESTURES = pathlib.Path(__file__).resolve().parents[2] / "shared" / "oracle" / "reshape"
ITERATIONS = 10
REPETITIONS = 3


def read_mesh(path):
    """Vertices in the file's order, which Open3D's own reader does not promise."""
    positions, triangles = [], []
    for line in path.read_text(encoding="utf-8").splitlines():
        kind, *words = line.split() or [""]
        if kind == "v":
            positions.append([float(word) for word in words[:3]])
        elif kind == "f":
            triangles.append([int(word.split("/")[0]) - 1 for word in words])
    return numpy.array(positions), numpy.array(triangles)


def edits():
    """Name, positions, triangles, handles, targets of each gesture."""
    for path in sorted(GESTURES.glob("*/*.deform")):
        positions, triangles = read_mesh(path.with_suffix(".obj"))
        diagonal = numpy.linalg.norm(numpy.ptp(positions, axis=0))
        for gesture in json.loads(path.read_text(encoding="utf-8")):
            handles = [int(vertex) for vertex in gesture["displacements"]]
            targets = positions[handles] + diagonal * numpy.array(list(gesture["displacements"].values()))
            yield f"{path.stem}/{gesture['label']}", positions, triangles, handles, targets


def seconds_of_arap(positions, triangles, handles, targets):
    vectors = open3d.utility.Vector3dVector
    mesh = open3d.geometry.TriangleMesh(vectors(positions), open3d.utility.Vector3iVector(triangles))
    start = time.perf_counter()
    mesh.deform_as_rigid_as_possible(open3d.utility.IntVector(handles), vectors(targets), max_iter=ITERATIONS)
    return time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--benchmark_filter", default="", metavar="REGEX")
    pattern = parser.parse_known_args()[0].benchmark_filter
    open3d.utility.set_verbosity_level(open3d.utility.VerbosityLevel.Error)
    for name, positions, triangles, handles, targets in edits():
        name = "open3d_arap/" + name
        if not re.search(pattern, name):
            continue
        times = [seconds_of_arap(positions, triangles, handles, targets) for _ in range(REPETITIONS)]
        print(f"{name:45} {1e3 * statistics.median(times):9.1f} ms  iterations={ITERATIONS} triangles={len(triangles)}")


if __name__ == "__main__":
    main()

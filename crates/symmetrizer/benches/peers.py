#!/usr/bin/env python3
"""Reads files with symmetrizer, trimesh and Open3D, side by side in one run.

    cargo build --release --example read
    python3 crates/symmetrizer/benches/peers.py bunny.obj bunny.ply [--grid]

--grid adds a generated binary PLY of 1,000,000 triangles. Peers that are not installed are left out
(pip install trimesh open3d-cpu). Milliseconds, the fastest and the median of seven times.
"""

import os
import statistics
import subprocess
import sys
import tempfile
import time

TIMES = 7


def grid(path):
    """A binary PLY of 1,000,000 triangles."""
    import numpy as np

    n = 709
    x, y = np.meshgrid(np.linspace(0, 1, n), np.linspace(0, 1, n))
    vertices = np.stack([x, y, 0.1 * np.sin(9 * x) * np.cos(7 * y)], -1).reshape(-1, 3).astype("<f4")
    i = np.arange(n * n).reshape(n, n)
    a, b, c, d = (s.ravel() for s in (i[:-1, :-1], i[:-1, 1:], i[1:, 1:], i[1:, :-1]))
    faces = np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)])[:1_000_000]
    rows = np.zeros(len(faces), dtype=[("n", "u1"), ("v", "<i4", 3)])
    rows["n"], rows["v"] = 3, faces
    header = (
        f"ply\nformat binary_little_endian 1.0\nelement vertex {len(vertices)}\n"
        "property float x\nproperty float y\nproperty float z\n"
        f"element face {len(faces)}\nproperty list uchar int vertex_indices\nend_header\n"
    )
    with open(path, "wb") as file:
        file.write(header.encode() + vertices.tobytes() + rows.tobytes())


def peers():
    """Name and reader of each peer that is installed."""
    try:
        import trimesh

        yield "trimesh", lambda f: len(trimesh.load(f, force="mesh", process=False).faces)
    except ImportError:
        print("trimesh is not installed", file=sys.stderr)
    try:
        import open3d

        open3d.utility.set_verbosity_level(open3d.utility.VerbosityLevel.Error)
        yield "Open3D", lambda f: len(open3d.io.read_triangle_mesh(f).triangles)
    except ImportError:
        print("Open3D is not installed", file=sys.stderr)


def timed(read, path):
    faces, times = read(path), []
    for _ in range(TIMES):
        begun = time.perf_counter()
        read(path)
        times.append(1e3 * (time.perf_counter() - begun))
    return faces, min(times), statistics.median(times)


def main():
    files = [f for f in sys.argv[1:] if f != "--grid"]
    root = os.path.join(os.path.dirname(os.path.abspath(__file__)), "../../..")
    target = os.environ.get("CARGO_TARGET_DIR", os.path.join(root, "target"))
    readers = list(peers())
    with tempfile.TemporaryDirectory() as folder:
        if "--grid" in sys.argv:
            files.append(os.path.join(folder, "grid.ply"))
            grid(files[-1])
        for path in files:
            ours = subprocess.run(
                [os.path.join(target, "release/examples/read"), path], check=True, capture_output=True, text=True
            ).stdout.split("\t")
            print(f"{os.path.basename(path)}, {int(ours[1]):,} faces")
            own = float(ours[3])
            print(f"  {'symmetrizer':12} {float(ours[2]):8.1f} {own:8.1f}")
            for name, read in readers:
                _, fastest, median = timed(read, path)
                print(f"  {name:12} {fastest:8.1f} {median:8.1f}  {median / own:5.1f} x")


if __name__ == "__main__":
    main()

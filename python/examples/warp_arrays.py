"""Particles for NVIDIA Warp: positions and masses as arrays of a device, and Γ of every particle by a kernel there.

Needs: pip install warp-lang
"""

import numpy as np
import warp as wp

import sphpack as sp


@wp.kernel
def sum_volumes(
    grid: wp.uint64,
    position: wp.array(dtype=wp.vec3),
    volume: wp.array(dtype=float),
    radius: float,
    found: wp.array(dtype=float),
):
    i = wp.tid()
    total = float(0.0)
    for j in wp.hash_grid_query(grid, position[i], radius):
        if wp.length(position[i] - position[j]) < radius:
            total += volume[j]
    found[i] = total


def main():
    packed = sp.pack(sp.sphere((0.0, 0.0, 0.0), 1.0), spacing=0.1)
    position = wp.array(packed.position.astype(np.float32), dtype=wp.vec3)
    volume = wp.array(packed.volume.astype(np.float32), dtype=float)
    radius = 3.0 * float(packed.spacing[0])
    grid = wp.HashGrid(32, 32, 32)
    grid.build(position, radius)
    found = wp.zeros(len(packed), dtype=float)
    wp.launch(sum_volumes, dim=len(packed), inputs=[grid.id, position, volume, radius, found])
    middle = int(np.argmin(np.linalg.norm(packed.position, axis=1)))
    ball = 4.0 / 3.0 * np.pi * radius**3
    print(len(packed), "particles; volume within three spacings of the middle, over the ball's:", found.numpy()[middle] / ball)


if __name__ == "__main__":
    main()

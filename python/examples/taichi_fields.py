"""Particles for Taichi: fields of positions and masses.

Needs: pip install taichi
"""

import numpy as np
import taichi as ti

import sphpack as sp

ti.init(arch=ti.cpu)


def main():
    packed = sp.pack(sp.circle((0.0, 0.0), 1.0), spacing=0.05, density=2.0)
    position = ti.Vector.field(packed.dimension, dtype=ti.f64, shape=len(packed))
    mass = ti.field(dtype=ti.f64, shape=len(packed))
    position.from_numpy(np.ascontiguousarray(packed.position))
    mass.from_numpy(packed.mass)

    @ti.kernel
    def weigh() -> ti.f64:
        total = ti.cast(0.0, ti.f64)
        for i in position:
            if position[i].norm() < 1.0:
                total += mass[i]
        return total

    print(len(packed), "particles; mass of the disc:", weigh(), "for", 2.0 * np.pi)


if __name__ == "__main__":
    main()

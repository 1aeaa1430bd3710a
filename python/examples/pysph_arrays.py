"""Particles for PySPH: an array of fluid and one of solid, as `create_particles` of an application gives them.

Needs: pip install pysph
"""

import sphpack as sp


def create_particles(particles):
    from pysph.base.utils import get_particle_array

    arrays = []
    for side in ("fluid", "solid"):
        some = particles.select(side=side)
        x, y = some.position[:, 0], some.position[:, 1]
        z = some.position[:, 2] if some.dimension == 3 else 0.0
        arrays.append(get_particle_array(name=side, x=x, y=y, z=z, m=some.mass, rho=some.density, h=some.h))
    return arrays


if __name__ == "__main__":
    packed = sp.pack(sp.circle((0.0, 0.0), 1.0), spacing=0.1, density=2.0)
    for array in create_particles(packed):
        print(array.name, array.get_number_of_particles(), "particles, mass", array.m.sum())

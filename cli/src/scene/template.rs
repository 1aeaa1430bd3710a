//! The scene that `sphpack init` writes.

/// A commented scene with every key; it packs as it is.
pub const TEMPLATE: &str = r#"# A scene for sphpack: bodies in a box, to be filled with evenly spread particles.
# Pack it with: sphpack pack THIS_FILE
# Keys that are commented out have the value shown, unless said otherwise. Lengths are in one unit of your choice.

spacing = 0.1                    # the particle spacing: the square (cube) root of a particle's area (volume); dp, dx too

# [refinement]                   # particles that grow away from the bodies (no default); spacing is then on their surfaces
# coarsest = 0.4                 # far away
# finest = 0.01                  # no finer than this, whatever bodies and regions say (no default)
# growth = 1.08                  # ratio of neighbouring particles' spacings, at most: 1.02 to 1.3
# field = "spacing.csv"          # spacings at the nodes of a grid, columns x, y (, z) and spacing (no default)
# region = [{ shape = { box = { min = [1.0, -0.5], max = [2.0, 0.5] } }, spacing = 0.1 }]   # any shapes or files

[domain]                         # the box; two numbers for 2-D, three for 3-D
min = [-2.0, -2.0]
max = [2.0, 2.0]
# margin = 0.8                   # instead of min and max: a box around the bodies, this far from them (no default)
# periodic = [false, false]      # axes that wrap around

[[body]]                         # as many as you like; solid ones may touch, but overlap only by precedence
name = "cylinder"
shape = { circle = { center = [0.0, 0.0], radius = 1.0 } }
# Other shapes (`sphpack list shapes`):
# shape = { polygon = { points = [[-1.0, -1.0], [1.0, -1.0], [0.0, 1.0]] } }
# shape = { naca = { digits = "0015", chord = 1.0 } }
# shape = { sphere = { center = [0.0, 0.0, 0.0], radius = 1.0 } }
# shape = { file = "body.stl" }  # a closed mesh (.stl, .obj, .ply: 3-D) or an outline (.csv: rows of x,y, .dat: an
                                 # airfoil, .svg: a drawing's closed paths: 2-D); relative to this file
# scale = 1.0                    # the body is scaled, then turned, then moved, about the origin
# units = "mm"                   # of a file, into a scene in metres, instead of scale: m | cm | mm | um | in | ft | km
# rotate_degrees = 0.0           # 2-D, counter-clockwise
# rotate = { axis = [0.0, 0.0, 1.0], degrees = 0.0 }   # 3-D
# translate = [0.0, 0.0]
# role = "solid"                 # solid | container (its inside is the domain: a tank) | void (no particles inside)
# precedence = 0                 # where bodies overlap, the one with the higher number (a solid, or a void that cuts)
                                 # keeps the room, the other is what is left of it
# density = 1.0                  # mass of a particle = density x volume
# surface = "inset"              # boundary particles half a spacing inside ("inset"), on the surface ("exact"),
                                 # or a number: how far inside, in spacings
# spacing = 0.1                  # with [refinement]: at this body's surface (the scene's)
# curvature = 12                 # with [refinement]: particles per radius of curvature, down to `finest` (no default)
# thin = "mass"                  # parts thinner than a spacing: as many particles as their mass asks for, or one per
                                 # spacing^(D-1) whatever they weigh ("watertight")
# layers = 3                     # wall (dummy) particles in so many layers, with normals and distances: of a solid
                                 # instead of filling it, of a container outside of it (no default)

[fluid]                          # what is between the bodies
# density = 1.0
# fill = true                    # false: write the bodies only
# hydrostatic = { gravity = [0.0, -9.81], level = 1.0, sound_speed = 45.0, exponent = 7.0 }
                                 # columns of pressure and density of the fluid at rest below that level, masses too

[packing]
# method = "balanced"            # `sphpack list methods`; "auto" picks it and its settings by
# accuracy = { linf = 0.002 }    # method = "auto": what to reach (no default); linf: largest |density - 1| | residual: net
                                 # force times h | interpolation, derivative: of a function, part of error beyond a lattice's
# kernel = "quintic"             # `sphpack list kernels`
# h_over_spacing = 1.2           # smoothing length over spacing; also hdx, hdp, or h, a length, or coefh: times sqrt(2 or 3)
# lattice = "auto"               # the start: `sphpack list lattices`; of least density, or the method's own
# frozen = "lattice"             # particles outside the box: the lattice continued, or a "square" ring
# finish = "even"                # even: pairs stay apart | consistent: no net pressure force on any free particle
#                                # | both: density and net force small at once | calm: as consistent, pairs apart, few particles
# balance = 0.5                  # finish = "both": from 0, all for consistency, to 1, all for an even density
# levelling = 10                 # even: how strongly the density is levelled against leftover forces (complex: 1000); 0: no
#                                # (in space 60 to 200 with Wendland's kernels)
# residual_tolerance = 1e-3      # stop where no force times h is larger (methods that minimise; consistent: 1e-5)
# velocity_tolerance = 1e-4      # stop where nothing is faster (methods that damp: hybrid)
# minimiser = "lbfgs"            # lbfgs | fire | damped; hybrid has none unless one is named
# band = "auto"                  # balanced: only particles near a surface settle | full: all of them
# masses = "equal"               # or "corrected": each a little more or less, so that the density is even
# mass_spread = 0.02             # corrected masses: no mass changes by more than this part
# max_iterations = 20000
# seed = 0                       # for methods that draw random numbers
# hybrid.predicted = 0.0         # this part of a surface's particles is put there at the start, such as 0.9
# hybrid.moving = 6.0            # only particles within so many spacings of a surface move (no default: all)
# hybrid.projection_growth = 1.0 # after the capture phase each capture waits longer by this factor, such as 1.5
# hybrid.capture = [0.5, 0.65]   # particles within so many spacings of a surface are put on it: at first, later
# hybrid.time_step = 1.0         # so many times as long a time step as published, 10 at most; see docs/stability.md
# agitated.agitators = "turning" # turning | resting | none
# agitated.steady_revolutions = 1.0                  # without a change on the surface, until agitators become free

[quality]                        # how the result is judged; left out: by the kernel that packed
# kernel = "quintic"
# h_over_spacing = 1.2

[output]
# include = ["free", "boundary", "fixed"]   # kinds of particles in the files; "frozen" adds the rim around the box
# surroundings = { min = [-10.0, -5.0], max = [20.0, 5.0] }
                                 # around the domain the files go on to there, on its lattice
"#;

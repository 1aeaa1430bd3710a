//! What can be asked for on the command line.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};

use super::number::{number, whole};
use crate::scene::LengthUnit;

/// Packs bodies and the fluid around them into evenly spread SPH particles.
#[derive(Debug, Parser)]
#[command(
    name = "sphpack",
    version,
    about,
    after_help = "\
Examples:
  sphpack init cylinder.toml                     a commented scene to start from
  sphpack pack cylinder.toml                     writes cylinder.vtu
  sphpack pack body.stl --spacing 0.02           a body, without a scene
  sphpack check body.stl                         is it closed, which way does it face, does it overlap itself?
  sphpack quality particles.csv --spacing 0.1    how even are anybody's particles?
  sphpack view cylinder.vtu                      writes cylinder.html: the particles, to look at in a browser

Exit status: 0 done and audited; 2 bad input; 3 not settled, not sound or not as accurate as asked (files are written, the summary says what is wrong); 130 interrupted (files are written); 1 anything else."
)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Pack a scene, or a body: geometry in, particles out
    Pack(PackArguments),
    /// Say what is wrong with a body, and mend it
    Check(CheckArguments),
    /// Measure how even anybody's particles are
    Quality(QualityArguments),
    /// Make a page to look at anybody's particles in a browser
    View(ViewArguments),
    /// Write a commented scene with every key
    Init(InitArguments),
    /// List what scenes can name
    List {
        /// Which list
        what: What,
    },
}

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  sphpack pack wing.toml                                       writes wing.vtu
  sphpack pack wing.toml -o wing.npz -o wing.vtu --picture wing.svg --report wing.json
  sphpack pack tank.toml -o tank.bi4                           for DualSPHysics: tank.bi4 and tank.xml
  sphpack pack tank.toml -o 'tank-{body}.csv'                  a file for each body, and tank-fluid.csv
  sphpack pack bunny.stl --scale 10 --spacing 0.02             a mesh: 3-D
  sphpack pack outline.csv --spacing 0.05 --margin 0.5         rows of x,y: 2-D
  sphpack pack naca0012.dat --spacing 0.01                     an airfoil (Selig or Lednicer): 2-D
  sphpack pack drawing.svg --scale 0.001 --spacing 0.002       a drawing's closed paths: 2-D
  sphpack pack part.stl --units mm --spacing 0.001             a body in millimetres, the spacing in metres
  sphpack pack - -o wing.vtu < wing.json                       a scene from another program
  sphpack pack wing.toml -o - | gzip > wing.csv.gz             particles to another program
  sphpack pack wing.toml --dry-run                             how many particles, how much memory and time

A body's format is told from its content, whatever its name. It is: triangles (STL, binary or text); polygons (OBJ; PLY, binary or text); rows of x,y (a blank line ends a loop); an airfoil's coordinates; or the closed paths, polygons, rectangles, circles and ellipses of an SVG drawing, in the units of its viewBox and with y turned up: (x, y) becomes (x, -y).

Formats for solvers hold what these read, and no more: LAMMPS's data file, atom style sph (.data); SPHinXsys's Reload.xml, or for one body NAME_rld.xml, for the fluid fluid_rld.xml (.xml); BGEO version 5 for SPlisHSPlasH and Houdini, in 32 bits (.bgeo); DualSPHysics's CASE.bi4 with CASE.xml beside it, whose gravity, speed of sound and times are to be edited (.bi4). DualSPHysics takes metres, kilograms and seconds: scenes for it are in these units, and a plane is its x and z. LAMMPS has one mass per type of atoms and DualSPHysics one for the fluid: scenes that make masses differ (packing.masses = \"corrected\", [refinement], fluid.hydrostatic) are refused for them.

Progress goes to standard error, the closing summary to standard output. Ctrl-C stops packing and writes what there is; a second Ctrl-C ends at once.

A run that is killed leaves a checkpoint (see --checkpoint), one that is stopped does too: the same command with --resume goes on from it, and ends with the same particles as if nothing had happened; with --force where the stopped run has written its files. A checkpoint goes when its run is done.

Files are written under hidden names, read again and compared, and then get their names all together, or none does. What is complete but cannot get its name is kept beside it as NAME.rescued.ENDING. With --force a file keeps its mode and, as far as allowed, its owner; a symbolic link is replaced itself, what it points to stays.")]
pub(super) struct PackArguments {
    /// The scene (.toml, .json; - reads it from standard input), or a body: a mesh (.stl, .obj, .ply) or an outline (.csv, .dat, .svg)
    pub(super) input: PathBuf,
    /// Write particles here (.vtu, .vtp, .vtk, .npz, .ply, .csv; for solvers .data, .xml, .bgeo, .bi4); may be repeated; {body} in it makes a file for each body and the fluid, {side} one for each side; - is standard output, as CSV [default: NAME.vtu in the working directory]
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Vec<PathBuf>,
    /// Write figures here (JSON)
    #[arg(long, value_name = "FILE")]
    pub(super) report: Option<PathBuf>,
    /// Draw the particles (.png, .svg; 3-D .png)
    #[arg(long, value_name = "FILE")]
    pub(super) picture: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long)]
    pub(super) force: bool,
    /// Particle spacing (needed for a body, part of a scene)
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = number)]
    pub(super) spacing: Option<f64>,
    /// From the body to the sides of the box [default: 8 spacings]
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = number)]
    pub(super) margin: Option<f64>,
    /// Factor on the body's lengths [default: 1]
    #[arg(long, value_name = "FACTOR", allow_negative_numbers = true, value_parser = number)]
    pub(super) scale: Option<f64>,
    /// The unit of the body's lengths (m, cm, mm, um, in, ft, km), for spacings in metres; instead of --scale
    #[arg(long, value_name = "UNIT", conflicts_with = "scale")]
    pub(super) units: Option<LengthUnit>,
    /// The method (`sphpack list methods`), instead of the scene's; "auto" picks it and its settings
    #[arg(long, value_name = "NAME")]
    pub(super) method: Option<String>,
    /// The seed of random numbers, instead of the scene's
    #[arg(long, value_name = "NUMBER", value_parser = whole::<u64>)]
    pub(super) seed: Option<u64>,
    /// Keep the state here every 30 s, to go on from if the run ends too early [default: the first output with the ending .checkpoint, once a run takes over a minute or is stopped]
    #[arg(long, value_name = "FILE")]
    pub(super) checkpoint: Option<PathBuf>,
    /// Go on from the checkpoint of a run that was killed or stopped, to the same particles
    #[arg(long)]
    pub(super) resume: bool,
    /// Seconds from one checkpoint to the next, for tests
    #[arg(long, value_name = "SECONDS", hide = true, value_parser = seconds)]
    pub(super) checkpoint_every: Option<f64>,
    /// Threads [default: one for each core]
    #[arg(long, value_name = "NUMBER", value_parser = whole::<usize>)]
    pub(super) threads: Option<usize>,
    /// Say how many particles and how much memory and time it would take; write nothing
    #[arg(long)]
    pub(super) dry_run: bool,
    /// Print nothing but errors
    #[arg(short, long)]
    pub(super) quiet: bool,
}

/// A time that a clock can wait for.
fn seconds(text: &str) -> Result<f64, String> {
    (text.parse().ok())
        .filter(|seconds| (0.0..1e9).contains(seconds))
        .ok_or_else(|| "it must be a number of seconds, 0 or more".into())
}

#[derive(Debug, Args)]
#[command(after_help = "\
Of a mesh: holes, edges of more than two triangles, triangles that face the wrong way, shells inside out, shells that overlap or touch, triangles that cross, are doubled or have no area; each with a count and a place. What `sphpack pack` mends by itself (it says so): doubled and degenerate triangles, wrong facing, holes too small to matter, shells that overlap, edges where the body touches itself. Larger holes are never closed unasked.

A shell inside a solid one is a cavity if it faces inward; facing outward it adds nothing and is left out.

What cannot be mended can be wrapped: --repair OUT.stl --wrap LENGTH makes a new, closed mesh around what the triangles wind around, on a grid with cells of that length. Holes are closed by smooth sheets; parts and gaps thinner than a cell may be lost; edges are rounded within a cell where shells or holes meet. A quarter of the particle spacing is a good length.

Of an outline: sides that cross or touch, loops that overlap or touch, are doubled or have no area, spikes, points that repeat; and what each loop is to the body (its direction does not matter). What `sphpack pack` mends by itself (it says so): doubled loops, loops without area, spikes; loops that overlap, where they run the same way round and none is within another; loops that touch; a loop that crosses itself, where that matters to less than 1 % of its area. Loops in any other tangle are refused: what they bound would be a guess.

Examples:
  sphpack check body.stl                                     what is wrong, and whether it can be packed
  sphpack check body.stl --spacing 0.02                      also what is thinner than a particle
  sphpack check body.stl --repair mended.stl                 mends it and writes the result
  sphpack check body.stl --repair mended.stl --fill-holes 5  also closes holes up to 5 across, as flat as can be
  sphpack check body.stl --repair mended.stl --wrap 0.1      makes a new mesh around whatever there is
  sphpack check outline.svg --repair mended.csv              mends an outline and writes it as rows of x,y

Exit status: 0 where the body can be packed (after what pack mends by itself, or the repair asked for); 2 where not.")]
pub(super) struct CheckArguments {
    /// The body: a mesh (.stl, .obj, .ply) or an outline (.csv, .dat, .svg)
    pub(super) body: PathBuf,
    /// Write the mended mesh (binary .stl) or outline (.csv) here; nothing where it cannot be mended
    #[arg(long, value_name = "FILE")]
    pub(super) repair: Option<PathBuf>,
    /// With --repair: close holes up to this size across
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = number)]
    pub(super) fill_holes: Option<f64>,
    /// With --repair: wrap the triangles in a new, closed mesh, on a grid with cells of this size
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = number)]
    pub(super) wrap: Option<f64>,
    /// Say what is thinner than this particle spacing
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = number)]
    pub(super) spacing: Option<f64>,
    /// Write the findings here (JSON)
    #[arg(long, value_name = "FILE")]
    pub(super) report: Option<PathBuf>,
    /// Print the findings as JSON
    #[arg(long)]
    pub(super) json: bool,
    /// Replace files that exist
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Particles: text (.csv, .txt, .dat) with columns x,y[,z] and optionally volume and kind, parted by commas, semicolons, tabs or spaces, their names in a header or in a comment as numpy.savetxt writes it (two or three columns need none); a NPZ file with arrays of these names; a NPY file with an array of shape (n, 2) or (n, 3), or of records; a PLY file with properties of these names; or a VTU, VTP or VTK (legacy) file; or what is written for solvers (.data, .xml, .bgeo, .bi4). Without volumes m / rho is taken (or mass / density), without these spacing^dimension. Where the columns spacing or h differ from row to row, each particle is measured by its own. Rows whose kind is \"frozen\" support their neighbours and are not measured themselves; where no row is frozen, particles within a support radius of the edge of their bounding box are left out of the figures.

Examples:
  sphpack quality particles.csv --spacing 0.1
  sphpack quality particles.vtu --spacing 0.1 --kernel wendland-c2 --h-over-spacing 1.3 --json")]
pub(super) struct QualityArguments {
    /// The particles (.csv, .txt, .dat, .npz, .npy, .ply, .vtu, .vtp, .vtk; .data, .xml, .bgeo, .bi4)
    pub(super) particles: PathBuf,
    /// Particle spacing, the root of a particle's volume; the finest where they differ
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true, value_parser = number)]
    pub(super) spacing: f64,
    /// The kernel that measures
    #[arg(long, value_name = "NAME", default_value = "quintic")]
    pub(super) kernel: String,
    /// Its smoothing length over the spacing [default: by the file's column h; else 1.2]
    #[arg(long, value_name = "RATIO", allow_negative_numbers = true, value_parser = number)]
    pub(super) h_over_spacing: Option<f64>,
    /// Print JSON
    #[arg(long)]
    pub(super) json: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
The page is one file, which any current browser opens from the disk, without a network: it holds all particles, every column, and what draws them. Share it as it is. Turn by dragging (in 2-D: move), move by dragging with the right button or two fingers, zoom by wheel or pinching; point at a particle for its row, click to keep that. Particles are coloured by any column, between two numbers that can be changed; what is no number is grey. In 3-D a slice, or a half space, shows the inside. Every kind, side and body can be left out.

Particles are drawn across by the column spacing, else by the root of volume, or of mass / density. Numbers are shown to 7 digits, coordinates to 10⁻⁷ of the box; coordinates are stored relative to its middle. The page has 0.8 MB, and for each particle 16 bytes for its place (11 in 2-D) and mostly 5 for each column whose values differ.

Files: what `sphpack quality` reads, columns x and y at least: text (.csv, .txt, .dat), .npz, .npy, .ply, .vtu, .vtp, .vtk, and what is written for solvers (.data, .xml, .bgeo, .bi4).

Examples:
  sphpack view wing.vtu                    writes wing.html into the working directory
  sphpack view runs/step.csv -o look.html
  sphpack view wing.vtu --force            again, after another packing")]
pub(super) struct ViewArguments {
    /// The particles (.vtu, .vtp, .vtk, .csv, .txt, .dat, .npz, .npy, .ply; .data, .xml, .bgeo, .bi4)
    pub(super) particles: PathBuf,
    /// Write the page here (.html) [default: NAME.html in the working directory]
    #[arg(short, long, value_name = "FILE")]
    pub(super) output: Option<PathBuf>,
    /// Replace the file if it exists
    #[arg(long)]
    pub(super) force: bool,
}

#[derive(Debug, Args)]
#[command(after_help = "\
Examples:
  sphpack init                              prints the scene
  sphpack init cylinder.toml                writes it
  sphpack init --schema scene.schema.json   what editors complete and check scenes by: write
                                            #:schema scene.schema.json
                                            as the first line of a scene")]
pub(super) struct InitArguments {
    /// Where to write it [default: standard output]
    pub(super) file: Option<PathBuf>,
    /// Write the JSON Schema of scenes instead
    #[arg(long)]
    pub(super) schema: bool,
    /// Replace the file if it exists
    #[arg(long)]
    pub(super) force: bool,
}

/// What can be listed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum What {
    /// How particles are settled
    Methods,
    /// Smoothing kernels
    Kernels,
    /// Starting lattices
    Lattices,
    /// Shapes of bodies
    Shapes,
}

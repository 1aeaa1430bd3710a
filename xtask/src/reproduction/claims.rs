//! What every figure of the papers shows, and which rows are known to miss.

use super::row::Figure;

const FLOW: Option<&str> = Some("it shows a flow, which nothing here computes yet");

const fn shown(paper: &'static str, figure: &'static str, claim: &'static str) -> Figure {
    Figure {
        paper,
        figure,
        claim,
        missing: None,
    }
}

const fn missing(
    paper: &'static str,
    figure: &'static str,
    claim: &'static str,
    why: Option<&'static str>,
) -> Figure {
    Figure {
        missing: why,
        ..shown(paper, figure, claim)
    }
}

/// What every figure shows, in our words; those without rows say why.
pub(crate) const FIGURES: [Figure; 37] = [
    shown(
        "000",
        "fig4",
        "the repulsion beside one of Lennard-Jones's kind",
    ),
    shown("000", "fig7", "which lattices stand a perturbation"),
    shown(
        "000",
        "fig7b",
        "which lattices of the plane stand an agitator that becomes a free particle",
    ),
    shown(
        "000",
        "fig14a",
        "which lattices of space stand a perturbation among frozen particles",
    ),
    shown(
        "000",
        "fig14b",
        "which of them stand an agitator that becomes a free particle",
    ),
    shown(
        "000",
        "fig8",
        "a cylinder: a clipped lattice, triangles, and packed particles",
    ),
    shown("000", "fig12", "an airfoil, likewise"),
    shown(
        "000",
        "sec2.7",
        "which particles are inside: by signed angles in the plane, by rays in space",
    ),
    shown(
        "000",
        "fig15",
        "a sphere: a clipped lattice, and packed particles",
    ),
    shown("000", "fig18", "a rabbit: particles on its surface"),
    missing("000", "fig13", "flow past a cylinder", FLOW),
    shown(
        "001",
        "fig5",
        "the repulsion beside one of Lennard-Jones's kind",
    ),
    shown(
        "001",
        "fig7",
        "a displaced particle among lattices, with repulsion and without",
    ),
    shown(
        "001",
        "sec3.1.7",
        "which particles are inside: by a flood from the surface; with it, how long neighbours take by tree and by cells",
    ),
    shown(
        "001",
        "fig8",
        "how often free particles are captured by the surface; ours never leave it, so that is all that the interval is of",
    ),
    shown(
        "001",
        "fig12",
        "density in and around a cylinder by three methods; the hybrid one varies least",
    ),
    shown(
        "001",
        "fig13",
        "how well particles around a cylinder interpolate a function and its derivative",
    ),
    shown(
        "001",
        "sec4.1",
        "how well particles around a cylinder interpolate at one ∆s, by h/∆s",
    ),
    shown("001", "fig15", "density at a zig-zag wall by three methods"),
    shown(
        "001",
        "fig16",
        "how well particles at the zig-zag wall interpolate",
    ),
    shown(
        "001",
        "fig17",
        "density in and around a starfish at three spacings",
    ),
    shown(
        "001",
        "table1",
        "a smaller tolerance brings an evener airfoil, for more iterations",
    ),
    shown("001", "fig19", "an ellipsoid in space"),
    shown(
        "001",
        "fig20",
        "how well particles around the ellipsoid interpolate",
    ),
    shown("001", "fig21", "a rabbit: particles on its surface"),
    missing("001", "fig22", "flow past a cylinder", FLOW),
    shown(
        "002",
        "fig3",
        "fluid in a tank with sloping walls comes to rest",
    ),
    shown("002", "fig9", "fluid in a tank with bends comes to rest"),
    shown("002", "fig11", "a round patch of fluid, before it flows"),
    shown(
        "002",
        "fig13",
        "fluid around the section of a ship's hull, before it floats",
    ),
    shown(
        "003",
        "fig7",
        "a packed airfoil at 5°, its surface found by the divergence of positions",
    ),
    shown("003", "fig24", "an S, before it turns"),
    shown(
        "004",
        "fig8",
        "an airfoil of three elements by separate and complex relaxation, and without a Boolean: gaps and kernel gradients at its edges",
    ),
    shown(
        "004",
        "fig10",
        "a starfish by separate and complex relaxation",
    ),
    shown(
        "004",
        "fig14",
        "a zig-zag wall by separate and complex relaxation",
    ),
    shown(
        "004",
        "fig17",
        "a rabbit: kernel gradients in the fluid's first layer",
    ),
    missing(
        "004",
        "fig20",
        "packing and energy of an airfoil at rest in flow",
        FLOW,
    ),
];

/// Rows that are known not to hold, by `Row::id`, and why.
pub(crate) const KNOWN_MISSES: [(&str, &str); 18] = [
    (
        "000 fig14b: hcp lattice, ND, agitator turning for half a revolution, after 25: farthest from a site at the end / ∆s",
        STIRRED,
    ),
    (
        "000 fig14b: hcp lattice, ND + RF, agitator turning for half a revolution, after 25: farthest from a site at the end / ∆s",
        STIRRED,
    ),
    (
        "000 fig14b: hcp lattice, ND + RF, agitator turning for half a revolution, after 25 under simple-cubic: L∞(Γ − the lattice's) at the end",
        STIRRED,
    ),
    (
        "004 fig8: 30P30N, ∆s = c/250, separate, fluid bounded by the solid's outline: largest hole near the surface / ∆s",
        CLOSE,
    ),
    (
        "001 fig7: hcp lattice, periodic, h/∆s = 1.2, ND, one particle moved by 0.25 ∆s along each axis, 15000 iterations: farthest from a site at the end / ∆s",
        COLLECTIVE,
    ),
    (
        "001 fig7: hcp lattice, periodic, h/∆s = 1.2, ND, one particle moved by 0.5 ∆s along each axis, 15000 iterations: farthest from a site at the end / ∆s",
        COLLECTIVE,
    ),
    (
        "001 fig7: hcp lattice, periodic, h/∆s = 1.2, ND + RF, one particle moved by 0.25 ∆s along each axis, 15000 iterations: farthest from a site at the end / ∆s",
        COLLECTIVE,
    ),
    (
        "001 fig7: hcp lattice, periodic, h/∆s = 1.2, ND + RF, one particle moved by 0.5 ∆s along each axis, 15000 iterations: farthest from a site at the end / ∆s",
        COLLECTIVE,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.1, h/∆s = 1, hybrid under coupled: L2 of the derivative, as printed",
        COARSE,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.1, h/∆s = 1, hybrid under standard: L2 of the function, as printed",
        LAYERS,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.1, h/∆s = 1, hybrid under standard: L2 of the derivative, as printed",
        LAYERS,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.05, h/∆s = 1.3125, hybrid under standard: L2 of the function, as printed",
        LAYERS,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.05, h/∆s = 1.3125, hybrid under standard: L2 of the derivative, as printed",
        LAYERS,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.02, h/∆s = 1.5, hybrid under standard: L2 of the function, as printed",
        LAYERS,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.02, h/∆s = 1.5, hybrid under standard: L2 of the derivative, as printed",
        LAYERS,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.05, h/∆s = 1.3125, balanced consistent: L2 of the derivative off the sites / lattice's",
        SOFT,
    ),
    (
        "001 fig13: cylinder, ∆s = 0.02, h/∆s = 1.5, balanced consistent: L2 of the derivative off the sites / lattice's",
        RESTLESS,
    ),
    (
        "001 fig16: zigzag, ∆s = 0.05, h/∆s = 1.3125, hybrid under standard: L2 of the function, as printed",
        LAYERS,
    ),
];

const STIRRED: &str = "the agitator leaves 64 particles among frozen ones where they are not a lattice, the hexagonal one as the other; it does so too when it \
                       does not turn (docs/methods.md), and the paper shows curves and no number";
const CLOSE: &str = "the gap is between two elements, where the surface of one stays ∆s from the next whatever sits there: at c/250, four times as coarse as \
                     in the paper";
const COLLECTIVE: &str = "at this h/∆s a motion of many particles lowers the energy of a perfect lattice, and one particle sets it off (docs/stability.md; at \
                          1.11 none does), and a periodic box lets it; the paper holds its box by fixed particles and does not say its h/∆s";
const COARSE: &str = "less, but not ten times less; the paper shows curves and no number";
const LAYERS: &str = "our offset layers are sampled evenly, and interpolate about as well as the hybrid method's where the middle of the body, \
                      in which they collide, is left out as in the paper; the paper shows curves and no number";
const RESTLESS: &str =
    "within the bar, but no lattice rests at this h/∆s, so the packing ends before its tolerance";
const SOFT: &str = "within the bar, but between h/∆s = 1.3 and 1.5 the square lattice loses its stability (docs/lattices.md), and the packing ends before \
                    its tolerance";

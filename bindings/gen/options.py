"""The options of jam-pack, which python3 -m jam runs: the one table that the parser, the help, the manual page, the completion
of shells and the guide's page are made from. After a change: python3 -B bindings/gen/generate.py."""
import re
from pathlib import Path

from option import INT32_MAX, INT64_MAX, STAGES, Option, Verb

HEADER = Path(__file__).parents[2] / "include/jam/jam.h"

NO_CRUNCH = ("no-crunch", "packing-fraction", "porosity")  # what leaves the crunch out

READING = "input frame box cell origin columns walls container non-additivity tile quiet json"
STARTING = "wall-time seed model zeta shrink shrink-min output report log plot page checkpoint checkpoint-every resume"
GROWING = (
    "n dim phi0 diameters-ratio sizes least-distance plant nve growth pressure packing-fraction porosity"
)
TABLES = "contacts spectrum modes gaps structure vtk"
PORES = (
    "stl stl-edge stl-shrink stl-bridge stl-bridge-gap stl-walls voxels voxel-size voxel-lines profile profile-bins pores pore-points pore-seed "
    "near-coordination near-gap contact-gap"
)

SHEARING = "to mode stress step resolution until alpha rows"

# Words that files may stand for, what the verb does, and the options that it takes.
VERBS = (
    Verb("pack", (), "start, molecular dynamics with growth, crunch: all of the work; the same without a verb", None),
    Verb("compress", ("input",), "start and molecular dynamics alone", f"{READING} {STARTING} {GROWING}"),
    Verb("crunch", ("input", "output"), "move the packing of a file to the jamming point",
           f"{READING} {STARTING} {TABLES} method strain lp duality-gap threads radii page-steps prove proof strict-proof"),
    Verb("shear", ("input", "output"), "shear the packing of a file quasi-statically",
           f"{READING} wall-time shrink shrink-min output report log page contacts checkpoint checkpoint-every resume {SHEARING}"),
    Verb("check", ("input",), "test whether the packing of a file is jammed, without moving spheres", f"{READING} wall-time prove proof strict-proof strict"),
    Verb("info", ("input",), "print what a file contains: cell, sizes, packing fraction, nearest pair", READING),
    Verb("export", ("input", "output"), "write the packing of a file in other formats, its tables and its pore space", f"{READING} wall-time output scale density plot {TABLES} {PORES}"),
    Verb("page", ("input", "page"), "write a page that shows the packing of a file in a browser", f"{READING} page plot contact-gap"),
    Verb("ensemble", (), "make many packings in one folder: python3 -m jam ensemble --help", ""),
    Verb("search", (), "search the largest sum of radii from many starts: python3 -m jam search --help", ""),
)
ALONE = PORES.split() + SHEARING.split() + ["scale", "density", "strict"]  # options that no job of pack takes

TABLE = {
    "Start": (
        Option("n", "integer", "N", "spheres (1024)", None, 1, INT32_MAX, without=("input",)),
        Option("dim", "integer", "D", "dimension, 2..8 (3)", 3, 2, 8, without=("input",)),
        Option("phi0", "positive", "F", "packing fraction of the random start (0.2; halved for each dimension above 3)",
               without=("input", "plant")),
        Option("diameters-ratio", "positive", "R", "the second half of the spheres is R times as large (1)", 1.0,
               without=("input", "sizes")),
        Option("sizes", "sizes", "LAW", "diameters by a law: equal, list, uniform, normal, lognormal, power, weibull or sieve. Examples: "
               "lognormal:deviation=0.3,draw=random, list:1=0.5,1.4=0.5, sieve:FILE with a cumulative curve. Or a file of diameters. Only "
               "ratios count, unless a density gives the number of spheres", without=("input",)),
        Option("least-distance", "positive", "H",
               "least distance between the surfaces of spheres, and half of it to walls, in the unit of --sizes: spheres grow in "
               "shells of H/2; with a density, and without --n", 0.0, needs=("sizes",),
               without=("n", "non-additivity", "model", "input", "resume", "checkpoint")),
        Option("non-additivity", "delta", "D", "spheres of unequal diameters touch at (1 + D) times their mean diameter, -1 < D <= 1 (0)",
               0.0, needs=("sizes", "diameters-ratio", "input", "resume")),
        Option("model", "choice", "", "distance: Euclidean (default) or Mari-Kurchan", "euclid", words=("euclid", "mk")),
        Option("zeta", "not_negative", "Z", "strength of the Mari-Kurchan shifts (infinite)"),
        Option("plant", "positive", "F", "Mari-Kurchan start, planted in equilibrium at packing fraction F", without=("input",)),
        Option("seed", "integer", "S", "seed of all random numbers (1)", 1, -INT64_MAX, INT64_MAX),
        Option("input", "input", "FILE",
               "start from a file: plain text, extended XYZ, LAMMPS data or dump, or a table x y z radius. It may be "
               "compressed. Molecular dynamics is then off unless --growth or --nve is given"),
        Option("frame", "integer", "K", "which packing of an --input that has several: 0 is the first, -1 the last (-1)", -1, -INT32_MAX,
               INT32_MAX, needs=("input", "resume")),
        Option("box", "positive", "L", "side of the box, for a random start or a file that gives no box (1)", 1.0),
        Option("cell", "cell", "LX,LY,..",
               "sides of the periodic brick of a random start, which keep their axes, or of a file that names no cell; or all components of the cell "
               "vectors, one vector after the other", without=("box",)),
        Option("origin", "text", "X,Y,..", "where the corner of the cell is in a file that does not say it (0)", needs=("input", "resume")),
        Option("columns", "text", "A,B,..",
               "what the columns of a table contain, in order: x, y, z (or x1, x2, ..) and radius or diameter; columns of other names are not read",
               needs=("input", "resume")),
        Option("tile", "copies", "NX,NY,..", "NX x NY x .. copies of the packing of the file, side by side along the cell vectors",
               needs=("input", "resume")),
        Option("walls", "choice", "AXES",
               "flat walls at both ends of these axes, of a random start or of a file that names no walls (none)", "none",
               words=("none", "x", "y", "xy", "z", "xz", "yz", "xyz")),
        Option("container", "choice", "SHAPE",
               "container of a random start or of a file that names none: the brick of the cell (brick), or a shape in it that touches its "
               "faces. --walls z closes the ends of a cylinder", "brick",
               words=tuple(word.lower() for word in re.findall(r"^  JAM_CONTAINER_(\w+)", HEADER.read_text(), re.M))),
        Option("shrink", "switch", "",
               "multiply all diameters of the file by the factor that brings the pair of largest overlap to contact; the summary gives the factor",
               needs=("input", "resume")),
        Option("shrink-min", "not_negative", "F",
               "refuse --shrink where its factor is below F <= 1, a sign of duplicates or wrong units (1e-3)", 1e-3, 0, 1,
               needs=("shrink",)),
    ),
    "Molecular dynamics": (
        Option("nve", "not_negative", "C", "first C collisions per particle without growth (0)", 0.0),
        Option("growth", "stage", "RATE[:P]",
               "one stage: growth rate G = (d sigma/dt)/sqrt(kT/m) up to reduced pressure P. Repeat the option for more stages. "
               "Default: 1e-2:500, then 3e-3 up to --pressure"),
        Option("pressure", "pressure", "P", "target of stages without :P (1e6)", STAGES[-1][1]),
        Option("packing-fraction", "fraction", "F",
               "grow to exactly this packing fraction, without a crunch, which would change it. With --sizes in the unit of --cell or "
               "--box, and without --n, the number of spheres follows from sizes and cell, and the final diameters are those of the law",
               without=("no-md", "porosity", "plant", "zeta")),
        Option("porosity", "fraction", "E", "as --packing-fraction, by the void fraction E = 1 - F", without=("no-md", "plant", "zeta")),
        Option("no-md", "switch", "", "no molecular dynamics"),
    ),
    "Checkpoints": (
        Option("checkpoint", "output", "FILE", "state of the dynamics or of the crunch, every minute and where they stop early", gzip=True),
        Option("checkpoint-every", "positive", "SECONDS", "time between checkpoints (60); during dynamics at least ten times the time of writing one", 60.0, needs=("checkpoint",)),
        Option("resume", "input", "FILE",
               "continue from a checkpoint. Dynamics continue the interrupted stage, to the same bits as without interruption, "
               "then the stages of higher pressure. A crunch starts from the packing of its last step. Options of the killed job are given again; those that the checkpoint contains must be the same"),
    ),
    "Crunch": (
        Option("method", "choice", "",
               "how the crunch finds the jamming point: barrier path (default), or the published sequence of linear programs alone",
               "barrier", words=("barrier", "sequential-lp"), without=NO_CRUNCH),
        Option("strain", "choice", "",
               "let the cell deform too, at fixed volume: its edges, its tilts, or both; free: the packing ends strictly jammed "
               "(none)", "none", words=("none", "edges", "tilts", "free"), without=NO_CRUNCH),
        Option("lp", "choice", "", "linear programs by interior point (default) or Clp's simplex", "ipm", words=("ipm", "clp"),
               without=NO_CRUNCH),
        Option("duality-gap", "not_negative", "GAP",
               "end the barrier path at this duality gap, 1e-12 .. 1e-2, with contacts from an LP there: for packings too large "
               "for the jamming point (0: the jamming point)", 0.0, without=NO_CRUNCH),
        Option("threads", "integer", "T", "1 .. 64 (1); 2 to 64 give the same bits, 1 may give others; more than 4 gain little", 1, 1, 64,
               without=NO_CRUNCH),
        Option("radii", "text", "KIND",
               "change the radii too, in place of the crunch: sum, to the largest sum of radii; moments:Q,.. to the largest factor of "
               "the radii while their power sums of up to four exponents keep their ratios; with --strain the cell deforms too",
               without=(*NO_CRUNCH, "method", "lp", "duality-gap", "page-steps", "prove", "proof", "strict-proof",
                        "model", "non-additivity")),
        Option("no-crunch", "switch", "", "stop after molecular dynamics"),
    ),
    "Shear": (
        Option("to", "text", "G,..", "strain at which a simple shear ends, x moves with y; several strains are reached one after the other: 0.1,-0.1,0"),
        Option("mode", "text", "M,..", "the strain of amplitude 1 in place of simple shear: an upper-triangular matrix, row by row: 0.5,0,0,-0.5"),
        Option("stress", "text", "XX=S,..", "for soft spheres: the cell deforms so that these components of the stress stay at these values, positive in compression: yy=0.01", needs=("alpha",)),
        Option("step", "positive", "G", "strain between two minima (1e-3)", 1e-3),
        Option("resolution", "positive", "G", "uncertainty of the strain of a plastic event (1e-6)", 1e-6),
        Option("until", "choice", "",
               "end before the last strain: after the first plastic event, or at the first minimum that is jammed, or not jammed", "strain",
               words=("strain", "event", "jammed", "unjammed")),
        Option("alpha", "positive", "A", "exponent of the energy of soft spheres; without --alpha the spheres are hard, and a crunch jams them at each strain", without=("shrink",)),
        Option("rows", "output", "FILE.csv", "strain, stress, pressure, energy, contacts and events of each minimum", stdout=True),
    ),
    "Output": (
        Option("output", "output", "FILE",
               "the packing. The ending sets the format: extended XYZ (.xyz, .extxyz), LAMMPS (.data, .lmp), ParaView (.vtp), "
               "plain text (.dat, .txt, none). With .gz appended the file is compressed", gzip=True),
        Option("scale", "positive", "S", "all lengths of --output times S (1)", 1.0, 1e-12, 1e12, needs=("output",)),
        Option("density", "positive", "RHO", "mass density of the spheres in --output, a LAMMPS data file, in the unit of this file (1)", 1.0, needs=("output",)),
        Option("page", "output", "FILE.html",
               "a page that shows the packing in a browser, with forces, certificate and distributions; needs no network", gzip=True),
        Option("page-steps", "integer", "K",
               "--page gets a slider over at most K states of the crunch before its end, each 16 bytes per sphere in d = 3 (0)", 0, 0, 1000,
               without=NO_CRUNCH, needs=("page",)),
        Option("contacts", "output", "FILE",
               "the contact network: i, j, unit vector, gap, force (mean 1), as .csv (also without an ending), .dump "
               "(LAMMPS dump local) or .vtp (ParaView)", after_crunch=True, stdout=True, gzip=True),
        Option("spectrum", "output", "FILE.csv", "lowest modes of the harmonic Hessian: omega^2, omega, inverse participation ratio",
               after_crunch=True),
        Option("modes", "integer", "K", "number of modes that --spectrum writes (100); 0: all, for which 24 (d N)^2 bytes must be at most 2e9", None, 0,
               INT32_MAX, needs=("spectrum",)),
        Option("gaps", "output", "FILE.csv", "gaps h < 1 of pairs that are no contacts, sorted", after_crunch=True),
        Option("structure", "output", "FILE.csv",
               "one line per sphere: coordination, class, sums of contact vectors and forces, Q6, local packing fraction",
               after_crunch=True),
        Option("prove", "switch", "",
               "prove a theorem about the jammed packing, valid despite rounding; the summary and the report say what was proved",
               without=("no-crunch",)),
        Option("proof", "output", "FILE", "the exact numbers of the proof, for the checker jamproof.py", after_crunch=True, gzip=True),
        Option("strict-proof", "output", "FILE",
               "the exact numbers of a proof of strict jamming, for packings that --strain free makes; none is written of others", after_crunch=True,
               gzip=True),
        Option("strict", "switch", "", "check: the exit status is that of strict jamming, for which the cell deforms too"),
        Option("report", "output", "FILE|-", "numbers, protocol and certificate as JSON; - is standard output", stdout=True),
        Option("log", "output", "FILE|-", "messages of the library on each stage and LP, one line each with its time", stdout=True),
        Option("vtk", "text", "PREFIX", "PREFIX.vtp and PREFIX-forces.vtp for ParaView"),
        Option("plot", "output", "PICTURE", "picture of spheres, forces and the course of the crunch, by matplotlib", host=True),
        Option("json", "switch", "", "JSON on standard output in place of the summary", without=("report",)),
        Option("quiet", "switch", "", "no progress, no summary"),
    ),
    "Pore space": (
        Option("stl", "output", "FILE.stl", "the solid as a closed mesh of triangles, spheres cut at the faces of the cell; d = 3", gzip=True),
        Option("stl-edge", "positive", "A", "edge of the triangles over the radius, 0.03..1 (0.2)", 0.2, 0.03, 1, needs=("stl", "stl-walls")),
        Option("stl-shrink", "fraction", "F", "all diameters of the mesh times F, so that no spheres touch", needs=("stl",)),
        Option("stl-bridge", "positive", "B", "a cylinder along each contact, its radius B times that of the smaller sphere, 0.02..0.45",
               None, 0.02, 0.45, without=("stl-shrink",), needs=("stl",)),
        Option("stl-bridge-gap", "fraction", "H",
               "bridges between all pairs within this gap over the contact distance, in place of contacts that balance",
               needs=("stl-bridge",)),
        Option("stl-walls", "output", "FILE.stl", "the walls of the container as a mesh of their own, with --stl-edge; d = 3", gzip=True),
        Option("voxels", "output", "FILE",
               "the solid as an image, .npy, .mha (MetaImage) or .vti (VTK): 0 void, 1 solid, 2 outside a round container", gzip=True),
        Option("voxel-size", "positive", "A", "edge of a voxel, about (a hundredth of the box)", needs=("voxels",)),
        Option("voxel-lines", "integer", "L",
               "solid fraction of each voxel in place of 0 and 1, by exact lengths on L^(d-1) lines (0: 0 or 1 by the centre)", 0, 0, 64,
               needs=("voxels",)),
        Option("profile", "output", "FILE.csv", "solid fraction in slabs along each axis, and in shells of a round container"),
        Option("profile-bins", "integer", "K", "slabs and shells of --profile (100)", 100, 1, 1000000, needs=("profile",)),
        Option("pores", "output", "FILE.csv",
               "pore sizes at random points of the void: distance to the nearest surface, radius of the largest sphere that contains the point"),
        Option("pore-points", "integer", "K", "points of --pores (10000)", 10000, 1, 1000000000, needs=("pores",)),
        Option("pore-seed", "integer", "S", "seed of the points of --pores (1)", 1, -INT64_MAX, INT64_MAX, needs=("pores",)),
        Option("near-coordination", "output", "FILE.csv", "number of spheres within --near-gap of each sphere; needs no contact network"),
        Option("contact-gap", "fraction", "H",
               "contacts are all pairs within this gap over the contact distance, whether forces on them balance or not: for "
               "beds under weight and friction. Tables then have no forces",
               needs=("contacts", "gaps", "structure", "vtk", "page", "stl-bridge")),
        Option("near-gap", "fraction", "H", "gap of --near-coordination over the contact distance (0.01)", 0.01, needs=("near-coordination",)),
    ),
    "Other": (
        Option("wall-time", "positive", "SECONDS", "limit of time for the whole run"),
        Option("help", "help", "", "this help"),
        Option("version", "help", "", "version and commit of the library"),
    ),
}

ABOUT = (
    "Makes a jammed packing of hard spheres: random start, event-driven molecular dynamics with growth, then linear "
    "programs and a barrier path to the jamming point."
)
EXAMPLE = "--n 1024 --seed 1 --output packing.xyz --page packing.html --report -"
NOTES = (
    "Ctrl-C stops the computation, and the requested files are still written. Progress is one changing line on a terminal, "
    "with a bar and the time left where it is known, and one line every ten seconds in a pipe or a file.",
    "Exit status 0: done, and jammed unless --no-crunch. 1: stopped early, a stage stalled, or not jammed; the valid state reached is written. "
    "2: wrong command line. 3: request or input refused, or the computation failed. 4: an output cannot be written.",
    "With --input the verdict is that of the end state, after the crunch. 'check FILE' tests the packing of a file as it "
    "is and moves nothing. One paragraph says whether it is jammed, strictly jammed, not jammed or undecided, and why. Exit status of check 0: jammed (with --strict or --strict-proof: strictly). 1: not. "
    "3: undecided. 2: wrong command line, or the file is refused.",
)
# Exit status of the verbs: those that compute, check, those that write what a file holds.
EXITS = (
    ("0", "done, and jammed where a crunch ran", "jammed", "done; a warning where no contacts were found"),
    ("1", "stopped early, a stage stalled, or not jammed; the valid state reached is written", "not jammed", "a table was not computed in time"),
    ("2", "wrong command line or value", "wrong command line, or the file is refused", "wrong command line or value"),
    ("3", "request or input refused, or the computation failed", "undecided", "the file is refused"),
    ("4", "an output cannot be written", "an output cannot be written", "an output cannot be written"),
)


def verbs_of(o):
    """Names of the verbs that take an option."""
    return [v.name for v in VERBS if (o.name not in ALONE if v.takes is None else o.name in v.takes.split())]


def options(host=False):
    """Sections with their options; with host also those of python3 -m jam alone."""
    for section, rows in TABLE.items():
        yield section, [o for o in rows if host or not o.host]

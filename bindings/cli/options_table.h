/* The options of jam-pack: made by bindings/gen/generate.py from bindings/gen/options.py; do not edit. */
/* clang-format off */
#ifndef JAM_PACK_OPTIONS_TABLE_H
#define JAM_PACK_OPTIONS_TABLE_H

/* Numbers that were not given are INFINITY, integers NOT_GIVEN. */
typedef struct options {
  int64_t n;
  int64_t dim;
  double phi0;
  double diameters_ratio;
  double non_additivity;
  int64_t model;
  double zeta;
  double plant;
  int64_t seed;
  const char *input;
  int64_t frame;
  double box;
  int64_t walls;
  int64_t container;
  int shrink;
  double shrink_min;
  double nve;
  double pressure;
  double packing_fraction;
  double porosity;
  int no_md;
  const char *checkpoint;
  double checkpoint_every;
  const char *resume;
  int64_t method;
  int64_t strain;
  int64_t lp;
  double duality_gap;
  int64_t threads;
  int no_crunch;
  const char *output;
  const char *page;
  int64_t page_steps;
  const char *contacts;
  const char *spectrum;
  int64_t modes;
  const char *gaps;
  const char *structure;
  int prove;
  const char *proof;
  const char *report;
  const char *log;
  const char *vtk;
  const char *plot;
  int quiet;
  double wall_time;
  given given; /* what has a form of its own */
} options;

/* Packing fraction of a random start by default. */
#define START_FRACTION(dim) ldexp(0.2, (dim) > 3 ? 3 - (int)(dim) : 0)

#ifdef JAM_PACK_OPTIONS_TABLE
enum {
  TAKE_INTEGER,
  TAKE_POSITIVE,
  TAKE_SIZES,
  TAKE_DELTA,
  TAKE_CHOICE,
  TAKE_NOT_NEGATIVE,
  TAKE_INPUT,
  TAKE_CELL,
  TAKE_SWITCH,
  TAKE_STAGE,
  TAKE_PRESSURE,
  TAKE_FRACTION,
  TAKE_OUTPUT,
  TAKE_TEXT
};
enum { AFTER_CRUNCH = 1, TAKES_STDOUT = 2, NEEDS_HOST = 4 };
enum { HELP_HEAD = 7 }; /* lines of the help before the options */

typedef struct option_row {
  const char *name;
  int kind;
  size_t place; /* in options */
  int64_t low, high;
  const char *words;
  int flags;
  const char *without, *needs; /* names of options, with which and without which it has no effect */
} option_row;

static const option_row table[] = {
    {"--n", TAKE_INTEGER, offsetof(options, n), 1, 2147483647, NULL, 0,
     "--input", ""},
    {"--dim", TAKE_INTEGER, offsetof(options, dim), 2, 8, NULL, 0,
     "--input", ""},
    {"--phi0", TAKE_POSITIVE, offsetof(options, phi0), 0, 0, NULL, 0,
     "--input --plant", ""},
    {"--diameters-ratio", TAKE_POSITIVE, offsetof(options, diameters_ratio), 0, 0, NULL, 0,
     "--input --sizes", ""},
    {"--sizes", TAKE_SIZES, 0, 0, 0, NULL, 0,
     "--input", ""},
    {"--non-additivity", TAKE_DELTA, offsetof(options, non_additivity), 0, 0, NULL, 0,
     "", "--sizes --diameters-ratio --input --resume"},
    {"--model", TAKE_CHOICE, offsetof(options, model), 0, 0, "euclid mk", 0,
     "", ""},
    {"--zeta", TAKE_NOT_NEGATIVE, offsetof(options, zeta), 0, 0, NULL, 0,
     "", ""},
    {"--plant", TAKE_POSITIVE, offsetof(options, plant), 0, 0, NULL, 0,
     "--input", ""},
    {"--seed", TAKE_INTEGER, offsetof(options, seed), -9223372036854775807, 9223372036854775807, NULL, 0,
     "", ""},
    {"--input", TAKE_INPUT, offsetof(options, input), 0, 0, NULL, 0,
     "", ""},
    {"--frame", TAKE_INTEGER, offsetof(options, frame), -2147483647, 2147483647, NULL, 0,
     "", "--input --resume"},
    {"--box", TAKE_POSITIVE, offsetof(options, box), 0, 0, NULL, 0,
     "", ""},
    {"--cell", TAKE_CELL, 0, 0, 0, NULL, 0,
     "--input --resume --box", ""},
    {"--walls", TAKE_CHOICE, offsetof(options, walls), 0, 0, "none x y xy z xz yz xyz", 0,
     "--input --resume", ""},
    {"--container", TAKE_CHOICE, offsetof(options, container), 0, 0, "brick cylinder ball", 0,
     "--input --resume", ""},
    {"--shrink", TAKE_SWITCH, offsetof(options, shrink), 0, 0, NULL, 0,
     "", "--input --resume"},
    {"--shrink-min", TAKE_NOT_NEGATIVE, offsetof(options, shrink_min), 0, 0, NULL, 0,
     "", "--shrink"},
    {"--nve", TAKE_NOT_NEGATIVE, offsetof(options, nve), 0, 0, NULL, 0,
     "", ""},
    {"--growth", TAKE_STAGE, 0, 0, 0, NULL, 0,
     "", ""},
    {"--pressure", TAKE_PRESSURE, offsetof(options, pressure), 0, 0, NULL, 0,
     "", ""},
    {"--packing-fraction", TAKE_FRACTION, offsetof(options, packing_fraction), 0, 0, NULL, 0,
     "--no-md --porosity --plant --zeta", ""},
    {"--porosity", TAKE_FRACTION, offsetof(options, porosity), 0, 0, NULL, 0,
     "--no-md --plant --zeta", ""},
    {"--no-md", TAKE_SWITCH, offsetof(options, no_md), 0, 0, NULL, 0,
     "", ""},
    {"--checkpoint", TAKE_OUTPUT, offsetof(options, checkpoint), 0, 0, NULL, 0,
     "", ""},
    {"--checkpoint-every", TAKE_POSITIVE, offsetof(options, checkpoint_every), 0, 0, NULL, 0,
     "", "--checkpoint"},
    {"--resume", TAKE_INPUT, offsetof(options, resume), 0, 0, NULL, 0,
     "", ""},
    {"--method", TAKE_CHOICE, offsetof(options, method), 0, 0, "barrier sequential-lp", 0,
     "--no-crunch --packing-fraction --porosity", ""},
    {"--strain", TAKE_CHOICE, offsetof(options, strain), 0, 0, "none edges tilts free", 0,
     "--no-crunch --packing-fraction --porosity", ""},
    {"--lp", TAKE_CHOICE, offsetof(options, lp), 0, 0, "ipm clp", 0,
     "--no-crunch --packing-fraction --porosity", ""},
    {"--duality-gap", TAKE_NOT_NEGATIVE, offsetof(options, duality_gap), 0, 0, NULL, 0,
     "--no-crunch --packing-fraction --porosity", ""},
    {"--threads", TAKE_INTEGER, offsetof(options, threads), 1, 2, NULL, 0,
     "--no-crunch --packing-fraction --porosity", ""},
    {"--no-crunch", TAKE_SWITCH, offsetof(options, no_crunch), 0, 0, NULL, 0,
     "", ""},
    {"--output", TAKE_OUTPUT, offsetof(options, output), 0, 0, NULL, 0,
     "", ""},
    {"--page", TAKE_OUTPUT, offsetof(options, page), 0, 0, NULL, 0,
     "", ""},
    {"--page-steps", TAKE_INTEGER, offsetof(options, page_steps), 0, 1000, NULL, 0,
     "--no-crunch --packing-fraction --porosity", "--page"},
    {"--contacts", TAKE_OUTPUT, offsetof(options, contacts), 0, 0, NULL, AFTER_CRUNCH | TAKES_STDOUT,
     "", ""},
    {"--spectrum", TAKE_OUTPUT, offsetof(options, spectrum), 0, 0, NULL, AFTER_CRUNCH,
     "", ""},
    {"--modes", TAKE_INTEGER, offsetof(options, modes), 0, 2147483647, NULL, 0,
     "", "--spectrum"},
    {"--gaps", TAKE_OUTPUT, offsetof(options, gaps), 0, 0, NULL, AFTER_CRUNCH,
     "", ""},
    {"--structure", TAKE_OUTPUT, offsetof(options, structure), 0, 0, NULL, AFTER_CRUNCH,
     "", ""},
    {"--prove", TAKE_SWITCH, offsetof(options, prove), 0, 0, NULL, 0,
     "--no-crunch", ""},
    {"--proof", TAKE_OUTPUT, offsetof(options, proof), 0, 0, NULL, AFTER_CRUNCH,
     "", ""},
    {"--report", TAKE_OUTPUT, offsetof(options, report), 0, 0, NULL, TAKES_STDOUT,
     "", ""},
    {"--log", TAKE_OUTPUT, offsetof(options, log), 0, 0, NULL, TAKES_STDOUT,
     "", ""},
    {"--vtk", TAKE_TEXT, offsetof(options, vtk), 0, 0, NULL, 0,
     "", ""},
    {"--plot", TAKE_OUTPUT, offsetof(options, plot), 0, 0, NULL, NEEDS_HOST,
     "", ""},
    {"--quiet", TAKE_SWITCH, offsetof(options, quiet), 0, 0, NULL, 0,
     "", ""},
    {"--wall-time", TAKE_POSITIVE, offsetof(options, wall_time), 0, 0, NULL, 0,
     "", ""},
};

static const options defaults = {
    .n = NOT_GIVEN,
    .dim = 3,
    .phi0 = INFINITY,
    .diameters_ratio = 1.0,
    .non_additivity = 0.0,
    .model = 0,
    .zeta = INFINITY,
    .plant = INFINITY,
    .seed = 1,
    .frame = -1,
    .box = 1.0,
    .walls = 0,
    .container = 0,
    .shrink_min = 0.001,
    .nve = 0.0,
    .pressure = 10000000.0,
    .packing_fraction = INFINITY,
    .porosity = INFINITY,
    .checkpoint_every = 60.0,
    .method = 0,
    .strain = 0,
    .lp = 0,
    .duality_gap = 0.0,
    .threads = 1,
    .page_steps = 0,
    .modes = NOT_GIVEN,
    .wall_time = INFINITY,
};

/* Stages of growth where --growth is not given; the last one goes to --pressure. */
static const stage default_stages[] = {{0.01, 500.0}, {0.003, 10000000.0}};

static const char *const help[] = {
    "Usage: jam-pack [options]",
    "Makes a jammed packing of hard spheres: random start, event-driven molecular",
    "dynamics with growth, then iterated linear programming down to the jamming",
    "point.",
    "",
    "Example: jam-pack --n 1024 --seed 1 --output packing.xyz --page packing.html --report -",
    "",
    "Start",
    "  --n N                  spheres (1024)",
    "  --dim D                dimension, 2..8 (3)",
    "  --phi0 F               packing fraction of the random start (0.2; halved for each",
    "                         dimension above 3)",
    "  --diameters-ratio R    half of the spheres are R times as large (1)",
    "  --sizes LAW            diameters by a law: equal, list, uniform, normal, lognormal, power,",
    "                         weibull or sieve. Examples: lognormal:deviation=0.3,draw=random,",
    "                         list:1=0.5,1.4=0.5, sieve:FILE with a cumulative curve. Or a file",
    "                         of diameters. Only ratios count, unless a density gives the number",
    "                         of spheres",
    "  --non-additivity D     spheres of unequal diameters touch at (1 + D) times their mean",
    "                         diameter, -1 < D <= 1 (0)",
    "  --model euclid|mk      distance: Euclidean (default) or Mari-Kurchan",
    "  --zeta Z               strength of the Mari-Kurchan shifts (infinite)",
    "  --plant F              Mari-Kurchan start, planted in equilibrium at packing fraction F",
    "  --seed S               of all random numbers (1)",
    "  --input FILE           start from a file: plain text, extended XYZ, LAMMPS data or dump,",
    "                         or a table x y z radius. It may be compressed. Molecular dynamics",
    "                         is then off unless --growth or --nve is given",
    "  --frame K              which packing of an --input with several: 0 is the first, -1 the",
    "                         last (-1)",
    "  --box L                side of the box, for a random start or a file that gives no box (1)",
    "  --cell LX,LY,..        sides of a periodic brick for a random start, or all components of",
    "                         its cell vectors, one vector after the other",
    "  --walls none|x|y|xy|z|xz|yz|xyz",
    "                         flat walls at both ends of these axes of a random start: none, x,",
    "                         y, xy, z, xz, yz or xyz (none). A scene with walls needs",
    "                         --no-crunch, --packing-fraction or --porosity",
    "  --container brick|cylinder|ball",
    "                         of a random start: brick, the cell; cylinder, about z, which",
    "                         --walls z closes; ball, in d = 2 a circle (brick). The diameter is",
    "                         the edge of the cell",
    "  --shrink               multiply all diameters of the file by the factor that brings the",
    "                         pair of largest overlap to contact; the summary gives the factor",
    "  --shrink-min F         refuse --shrink where its factor is below F <= 1, a sign of",
    "                         duplicates or wrong units (1e-3)",
    "Molecular dynamics",
    "  --nve C                first C collisions per particle without growth (0)",
    "  --growth RATE[:P]      one stage: growth rate G = (d sigma/dt)/sqrt(kT/m) up to reduced",
    "                         pressure P. Repeat the option for more stages. Default: 1e-2:500,",
    "                         then 3e-3 up to --pressure",
    "  --pressure P           target of stages without :P (1e7)",
    "  --packing-fraction F   grow to exactly this packing fraction, without a crunch, which",
    "                         would change it. With --sizes in the unit of --cell or --box, and",
    "                         without --n, the number of spheres follows from them, and the final",
    "                         diameters are those of the law",
    "  --porosity E           the same by the void fraction, 1 - F",
    "  --no-md                no molecular dynamics",
    "Checkpoints",
    "  --checkpoint FILE      state of the dynamics or of the crunch, every minute and where they",
    "                         stop early",
    "  --checkpoint-every SECONDS",
    "                         between checkpoints (60)",
    "  --resume FILE          continue from a checkpoint. Dynamics: to the same bits, the stage",
    "                         that was interrupted, then the stages of higher pressure. A crunch:",
    "                         from the packing of its last step",
    "Crunch",
    "  --method barrier|sequential-lp",
    "                         the quench: barrier path (default), or the published sequence of",
    "                         linear programs alone",
    "  --strain none|edges|tilts|free",
    "                         let the cell deform too, at fixed volume: its edges, its tilts, or",
    "                         both; free: the packing ends strictly jammed (none)",
    "  --lp ipm|clp           linear programs by interior point (default) or Clp's simplex",
    "  --duality-gap GAP      end the barrier path at this duality gap, 1e-12 .. 1e-2, with",
    "                         contacts from an LP there: for packings too large for the jamming",
    "                         point (0: the jamming point)",
    "  --threads T            1 or 2 (1; the same bits each time on 1)",
    "  --no-crunch            stop after molecular dynamics",
    "Output",
    "  --output FILE          the packing. The ending sets the format: extended XYZ (.xyz,",
    "                         .extxyz), LAMMPS (.data, .lmp), ParaView (.vtp), plain text (.dat,",
    "                         .txt, none). With .gz appended the file is compressed",
    "  --page FILE.html       a page that shows the packing in a browser, with forces,",
    "                         certificate and distributions; needs no network",
    "  --page-steps K         --page gets a slider over at most K states of the crunch before its",
    "                         end, each 16 bytes per sphere in d = 3 (0)",
    "  --contacts FILE        the contact network: i, j, unit vector, gap, force (mean 1), as",
    "                         .csv (also without an ending), .dump (LAMMPS dump local) or .vtp",
    "                         (ParaView)",
    "  --spectrum FILE.csv    lowest modes of the harmonic Hessian: omega^2, omega, participation",
    "  --modes K              how many --spectrum writes (100); 0: all, which needs 24 (d N)^2",
    "                         bytes, at most 2e9",
    "  --gaps FILE.csv        gaps h < 1 of pairs that are no contacts, sorted",
    "  --structure FILE.csv   one line per sphere: coordination, class, sums of contact vectors",
    "                         and forces, Q6, local packing fraction",
    "  --prove                a theorem about the jammed packing, valid despite rounding; the",
    "                         summary and the report say what was proved",
    "  --proof FILE           the exact numbers of the proof, for the checker jamproof.py",
    "  --report FILE|-        figures, protocol and certificate as JSON; - is standard output",
    "  --log FILE|-           messages of the library on each stage and LP, one line each with",
    "                         its time",
    "  --vtk PREFIX           PREFIX.vtp and PREFIX-forces.vtp for ParaView",
    "\t  --plot PICTURE         spheres, forces and the way there, by matplotlib",
    "  --quiet                no progress, no summary",
    "Other",
    "  --wall-time SECONDS    limit for the whole run",
    "  --help                 these lines",
    "  --version              the version of the library",
    "",
    "Ctrl-C stops the computation, and the requested files are still written. Progress is one",
    "changing line on a terminal, and one line every ten seconds in a pipe or a file.",
    "",
    "Exit status 0: done, and jammed unless --no-crunch. 1: stopped early, a stage stalled, or",
    "not jammed; the valid state reached is written. 2: wrong command line. 3: request or input",
    "refused, or the computation failed. 4: an output cannot be written.",
    "",
    "With --input the verdict is that of the end state, after the crunch. 'check FILE' tests the",
    "packing of a file as it is and moves nothing. It takes --box, --frame, --non-additivity,",
    "--prove, --proof, --wall-time and --quiet. One paragraph says whether it is jammed, strictly",
    "jammed, not jammed or undecided, and why. Exit status of check 0: jammed. 1: not. 3:",
    "undecided. 2: wrong command line, or the file is refused.",
    NULL};
#endif
#endif

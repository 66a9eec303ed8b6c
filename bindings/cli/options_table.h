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
  double least_distance;
  double non_additivity;
  int64_t model;
  double zeta;
  double plant;
  int64_t seed;
  const char *input;
  int64_t frame;
  double box;
  const char *origin;
  const char *columns;
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
  const char *to;
  double step;
  double resolution;
  int64_t until;
  double alpha;
  const char *rows;
  const char *output;
  double scale;
  double density;
  const char *page;
  int64_t page_steps;
  const char *contacts;
  const char *spectrum;
  int64_t modes;
  const char *gaps;
  const char *structure;
  int prove;
  const char *proof;
  const char *strict_proof;
  int strict;
  const char *report;
  const char *log;
  const char *vtk;
  const char *plot;
  int json;
  int quiet;
  const char *stl;
  double stl_edge;
  double stl_shrink;
  double stl_bridge;
  double stl_bridge_gap;
  const char *stl_walls;
  const char *voxels;
  double voxel_size;
  int64_t voxel_lines;
  const char *profile;
  int64_t profile_bins;
  const char *pores;
  int64_t pore_points;
  int64_t pore_seed;
  const char *near_coordination;
  double contact_gap;
  double near_gap;
  double wall_time;
  given given; /* what has a form of its own */
  unsigned char named[81]; /* of each row of the table, whether it is on the command line */
} options;

/* First words of a command line. */
enum {
  VERB_PACK, VERB_COMPRESS, VERB_CRUNCH, VERB_SHEAR, VERB_CHECK, VERB_INFO, VERB_EXPORT, VERB_PAGE, VERB_ENSEMBLE,
  VERB_NONE
};

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
  TAKE_TEXT,
  TAKE_COPIES,
  TAKE_SWITCH,
  TAKE_STAGE,
  TAKE_PRESSURE,
  TAKE_FRACTION,
  TAKE_OUTPUT
};
enum { AFTER_CRUNCH = 1, TAKES_STDOUT = 2, NEEDS_HOST = 4, TAKES_GZIP = 8 };
typedef struct option_row {
  const char *name;
  int kind;
  size_t place; /* in options */
  int64_t low, high;   /* of an integer */
  double least, most;  /* of another number; 0, 0: no limits of its own */
  const char *words;
  int flags;
  const char *without, *needs; /* names of options, with which and without which it has no effect; or NULL */
  unsigned verbs;              /* bits of those that take it */
} option_row;

static const option_row table[] = {
    {"--n", TAKE_INTEGER, offsetof(options, n), .verbs = 3, .without = "--input", .low = 1, .high = 2147483647},
    {"--dim", TAKE_INTEGER, offsetof(options, dim), .verbs = 3, .without = "--input", .low = 2, .high = 8},
    {"--phi0", TAKE_POSITIVE, offsetof(options, phi0), .verbs = 3, .without = "--input --plant"},
    {"--diameters-ratio", TAKE_POSITIVE, offsetof(options, diameters_ratio), .verbs = 3, .without = "--input --sizes"},
    {"--sizes", TAKE_SIZES, 0, .verbs = 3, .without = "--input"},
    {"--least-distance", TAKE_POSITIVE, offsetof(options, least_distance), .verbs = 3,
     .without = "--n --non-additivity --model --input --resume --checkpoint", .needs = "--sizes"},
    {"--non-additivity", TAKE_DELTA, offsetof(options, non_additivity), .verbs = 255,
     .needs = "--sizes --diameters-ratio --input --resume"},
    {"--model", TAKE_CHOICE, offsetof(options, model), .verbs = 7, .words = "euclid mk"},
    {"--zeta", TAKE_NOT_NEGATIVE, offsetof(options, zeta), .verbs = 7},
    {"--plant", TAKE_POSITIVE, offsetof(options, plant), .verbs = 3, .without = "--input"},
    {"--seed", TAKE_INTEGER, offsetof(options, seed), .verbs = 7,
     .low = -9223372036854775807, .high = 9223372036854775807},
    {"--input", TAKE_INPUT, offsetof(options, input), .verbs = 255},
    {"--frame", TAKE_INTEGER, offsetof(options, frame), .verbs = 255,
     .needs = "--input --resume", .low = -2147483647, .high = 2147483647},
    {"--box", TAKE_POSITIVE, offsetof(options, box), .verbs = 255},
    {"--cell", TAKE_CELL, 0, .verbs = 255, .without = "--resume --box"},
    {"--origin", TAKE_TEXT, offsetof(options, origin), .verbs = 255, .needs = "--input"},
    {"--columns", TAKE_TEXT, offsetof(options, columns), .verbs = 255, .needs = "--input"},
    {"--tile", TAKE_COPIES, 0, .verbs = 255, .without = "--resume", .needs = "--input"},
    {"--walls", TAKE_CHOICE, offsetof(options, walls), .verbs = 255,
     .words = "none x y xy z xz yz xyz", .without = "--resume"},
    {"--container", TAKE_CHOICE, offsetof(options, container), .verbs = 255,
     .words = "brick cylinder ball", .without = "--resume"},
    {"--shrink", TAKE_SWITCH, offsetof(options, shrink), .verbs = 15, .needs = "--input --resume"},
    {"--shrink-min", TAKE_NOT_NEGATIVE, offsetof(options, shrink_min), .verbs = 15, .needs = "--shrink", .most = 1},
    {"--nve", TAKE_NOT_NEGATIVE, offsetof(options, nve), .verbs = 3},
    {"--growth", TAKE_STAGE, 0, .verbs = 3},
    {"--pressure", TAKE_PRESSURE, offsetof(options, pressure), .verbs = 3},
    {"--packing-fraction", TAKE_FRACTION, offsetof(options, packing_fraction), .verbs = 3,
     .without = "--no-md --porosity --plant --zeta"},
    {"--porosity", TAKE_FRACTION, offsetof(options, porosity), .verbs = 3, .without = "--no-md --plant --zeta"},
    {"--no-md", TAKE_SWITCH, offsetof(options, no_md), .verbs = 1},
    {"--checkpoint", TAKE_OUTPUT, offsetof(options, checkpoint), .verbs = 15, .flags = TAKES_GZIP},
    {"--checkpoint-every", TAKE_POSITIVE, offsetof(options, checkpoint_every), .verbs = 15, .needs = "--checkpoint"},
    {"--resume", TAKE_INPUT, offsetof(options, resume), .verbs = 15},
    {"--method", TAKE_CHOICE, offsetof(options, method), .verbs = 5,
     .words = "barrier sequential-lp", .without = "--no-crunch --packing-fraction --porosity"},
    {"--strain", TAKE_CHOICE, offsetof(options, strain), .verbs = 5,
     .words = "none edges tilts free", .without = "--no-crunch --packing-fraction --porosity"},
    {"--lp", TAKE_CHOICE, offsetof(options, lp), .verbs = 5,
     .words = "ipm clp", .without = "--no-crunch --packing-fraction --porosity"},
    {"--duality-gap", TAKE_NOT_NEGATIVE, offsetof(options, duality_gap), .verbs = 5,
     .without = "--no-crunch --packing-fraction --porosity"},
    {"--threads", TAKE_INTEGER, offsetof(options, threads), .verbs = 5,
     .without = "--no-crunch --packing-fraction --porosity", .low = 1, .high = 64},
    {"--no-crunch", TAKE_SWITCH, offsetof(options, no_crunch), .verbs = 1},
    {"--to", TAKE_TEXT, offsetof(options, to), .verbs = 8},
    {"--step", TAKE_POSITIVE, offsetof(options, step), .verbs = 8},
    {"--resolution", TAKE_POSITIVE, offsetof(options, resolution), .verbs = 8},
    {"--until", TAKE_CHOICE, offsetof(options, until), .verbs = 8, .words = "strain event jammed unjammed"},
    {"--alpha", TAKE_POSITIVE, offsetof(options, alpha), .verbs = 8, .without = "--shrink"},
    {"--rows", TAKE_OUTPUT, offsetof(options, rows), .verbs = 8, .flags = TAKES_STDOUT},
    {"--output", TAKE_OUTPUT, offsetof(options, output), .verbs = 79, .flags = TAKES_GZIP},
    {"--scale", TAKE_POSITIVE, offsetof(options, scale), .verbs = 64,
     .needs = "--output", .least = 1e-12, .most = 1000000000000.0},
    {"--density", TAKE_POSITIVE, offsetof(options, density), .verbs = 64, .needs = "--output"},
    {"--page", TAKE_OUTPUT, offsetof(options, page), .verbs = 143, .flags = TAKES_GZIP},
    {"--page-steps", TAKE_INTEGER, offsetof(options, page_steps), .verbs = 5,
     .without = "--no-crunch --packing-fraction --porosity", .needs = "--page", .high = 1000},
    {"--contacts", TAKE_OUTPUT, offsetof(options, contacts), .verbs = 77,
     .flags = AFTER_CRUNCH | TAKES_STDOUT | TAKES_GZIP},
    {"--spectrum", TAKE_OUTPUT, offsetof(options, spectrum), .verbs = 69, .flags = AFTER_CRUNCH},
    {"--modes", TAKE_INTEGER, offsetof(options, modes), .verbs = 69, .needs = "--spectrum", .high = 2147483647},
    {"--gaps", TAKE_OUTPUT, offsetof(options, gaps), .verbs = 69, .flags = AFTER_CRUNCH},
    {"--structure", TAKE_OUTPUT, offsetof(options, structure), .verbs = 69, .flags = AFTER_CRUNCH},
    {"--prove", TAKE_SWITCH, offsetof(options, prove), .verbs = 21, .without = "--no-crunch"},
    {"--proof", TAKE_OUTPUT, offsetof(options, proof), .verbs = 21, .flags = AFTER_CRUNCH | TAKES_GZIP},
    {"--strict-proof", TAKE_OUTPUT, offsetof(options, strict_proof), .verbs = 21, .flags = AFTER_CRUNCH | TAKES_GZIP},
    {"--strict", TAKE_SWITCH, offsetof(options, strict), .verbs = 16},
    {"--report", TAKE_OUTPUT, offsetof(options, report), .verbs = 15, .flags = TAKES_STDOUT},
    {"--log", TAKE_OUTPUT, offsetof(options, log), .verbs = 15, .flags = TAKES_STDOUT},
    {"--vtk", TAKE_TEXT, offsetof(options, vtk), .verbs = 69},
    {"--plot", TAKE_OUTPUT, offsetof(options, plot), .verbs = 199, .flags = NEEDS_HOST},
    {"--json", TAKE_SWITCH, offsetof(options, json), .verbs = 255, .without = "--report"},
    {"--quiet", TAKE_SWITCH, offsetof(options, quiet), .verbs = 255},
    {"--stl", TAKE_OUTPUT, offsetof(options, stl), .verbs = 64, .flags = TAKES_GZIP},
    {"--stl-edge", TAKE_POSITIVE, offsetof(options, stl_edge), .verbs = 64,
     .needs = "--stl --stl-walls", .least = 0.03, .most = 1},
    {"--stl-shrink", TAKE_FRACTION, offsetof(options, stl_shrink), .verbs = 64, .needs = "--stl"},
    {"--stl-bridge", TAKE_POSITIVE, offsetof(options, stl_bridge), .verbs = 64,
     .without = "--stl-shrink", .needs = "--stl", .least = 0.02, .most = 0.45},
    {"--stl-bridge-gap", TAKE_FRACTION, offsetof(options, stl_bridge_gap), .verbs = 64, .needs = "--stl-bridge"},
    {"--stl-walls", TAKE_OUTPUT, offsetof(options, stl_walls), .verbs = 64, .flags = TAKES_GZIP},
    {"--voxels", TAKE_OUTPUT, offsetof(options, voxels), .verbs = 64, .flags = TAKES_GZIP},
    {"--voxel-size", TAKE_POSITIVE, offsetof(options, voxel_size), .verbs = 64, .needs = "--voxels"},
    {"--voxel-lines", TAKE_INTEGER, offsetof(options, voxel_lines), .verbs = 64, .needs = "--voxels", .high = 64},
    {"--profile", TAKE_OUTPUT, offsetof(options, profile), .verbs = 64},
    {"--profile-bins", TAKE_INTEGER, offsetof(options, profile_bins), .verbs = 64,
     .needs = "--profile", .low = 1, .high = 1000000},
    {"--pores", TAKE_OUTPUT, offsetof(options, pores), .verbs = 64},
    {"--pore-points", TAKE_INTEGER, offsetof(options, pore_points), .verbs = 64,
     .needs = "--pores", .low = 1, .high = 1000000000},
    {"--pore-seed", TAKE_INTEGER, offsetof(options, pore_seed), .verbs = 64,
     .needs = "--pores", .low = -9223372036854775807, .high = 9223372036854775807},
    {"--near-coordination", TAKE_OUTPUT, offsetof(options, near_coordination), .verbs = 64},
    {"--contact-gap", TAKE_FRACTION, offsetof(options, contact_gap), .verbs = 192,
     .needs = "--contacts --gaps --structure --vtk --page --stl-bridge"},
    {"--near-gap", TAKE_FRACTION, offsetof(options, near_gap), .verbs = 64, .needs = "--near-coordination"},
    {"--wall-time", TAKE_POSITIVE, offsetof(options, wall_time), .verbs = 255},
};

static const options defaults = {
    .n = NOT_GIVEN,
    .dim = 3,
    .phi0 = INFINITY,
    .diameters_ratio = 1.0,
    .least_distance = 0.0,
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
    .pressure = 1000000.0,
    .packing_fraction = INFINITY,
    .porosity = INFINITY,
    .checkpoint_every = 60.0,
    .method = 0,
    .strain = 0,
    .lp = 0,
    .duality_gap = 0.0,
    .threads = 1,
    .step = 0.001,
    .resolution = 1e-06,
    .until = 0,
    .alpha = INFINITY,
    .scale = 1.0,
    .density = 1.0,
    .page_steps = 0,
    .modes = NOT_GIVEN,
    .stl_edge = 0.2,
    .stl_shrink = INFINITY,
    .stl_bridge = INFINITY,
    .stl_bridge_gap = INFINITY,
    .voxel_size = INFINITY,
    .voxel_lines = 0,
    .profile_bins = 100,
    .pore_points = 10000,
    .pore_seed = 1,
    .contact_gap = INFINITY,
    .near_gap = 0.01,
    .wall_time = INFINITY,
};

/* Stages of growth where --growth is not given; the last one goes to --pressure. */
static const stage default_stages[] = {{0.01, 500.0}, {0.003, 1000000.0}};

typedef struct help_line {
  unsigned verbs; /* bits of those that show it; VERB_NONE: the help of the whole program */
  const char *text;
} help_line;

static const help_line help[] = {
    {512, "Usage: jam-pack [VERB] [FILE] [options]"},
    {512, "Makes a jammed packing of hard spheres: random start, event-driven molecular"},
    {512, "dynamics with growth, then linear programs and a barrier path to the jamming"},
    {512, "point."},
    {512, ""},
    {512, "Example: jam-pack --n 1024 --seed 1 --output packing.xyz --page packing.html --report -"},
    {512, ""},
    {512, "Verbs"},
    {512, "  pack                   start, molecular dynamics with growth, crunch: all of the work; the"},
    {512, "                         same without a verb"},
    {1, "Usage: jam-pack pack [options]"},
    {1, "pack: start, molecular dynamics with growth, crunch: all of the work; the same"},
    {1, "without a verb."},
    {1, ""},
    {512, "  compress [FILE]        start and molecular dynamics alone"},
    {2, "Usage: jam-pack compress [FILE] [options]"},
    {2, "compress: start and molecular dynamics alone."},
    {2, ""},
    {512, "  crunch FILE [OUTPUT]   the packing of a file to its jamming point"},
    {4, "Usage: jam-pack crunch FILE [OUTPUT] [options]"},
    {4, "crunch: the packing of a file to its jamming point."},
    {4, ""},
    {512, "  shear FILE [OUTPUT]    the packing of a file along a quasi-static shear"},
    {8, "Usage: jam-pack shear FILE [OUTPUT] [options]"},
    {8, "shear: the packing of a file along a quasi-static shear."},
    {8, ""},
    {512, "  check FILE             is the packing of a file jammed as it is? Nothing moves"},
    {16, "Usage: jam-pack check FILE [options]"},
    {16, "check: is the packing of a file jammed as it is? Nothing moves."},
    {16, ""},
    {512, "  info FILE              what a file contains: cell, sizes, packing fraction, nearest pair"},
    {32, "Usage: jam-pack info FILE [options]"},
    {32, "info: what a file contains: cell, sizes, packing fraction, nearest pair."},
    {32, ""},
    {512, "  export FILE [OUTPUT]   the packing of a file in other formats, its tables and its pore"},
    {512, "                         space"},
    {64, "Usage: jam-pack export FILE [OUTPUT] [options]"},
    {64, "export: the packing of a file in other formats, its tables and its pore space."},
    {64, ""},
    {512, "  page FILE OUTPUT.html  a page that shows the packing of a file in a browser"},
    {128, "Usage: jam-pack page FILE OUTPUT.html [options]"},
    {128, "page: a page that shows the packing of a file in a browser."},
    {128, ""},
    {512, "  ensemble               many packings in one folder: python3 -m jam ensemble --help"},
    {256, "Usage: jam-pack ensemble [options]"},
    {256, "ensemble: many packings in one folder: python3 -m jam ensemble --help."},
    {256, ""},
    {512, "jam-pack VERB --help shows the options of one verb."},
    {512, ""},
    {767, "Start"},
    {515, "  --n N                  spheres (1024)"},
    {515, "  --dim D                dimension, 2..8 (3)"},
    {515, "  --phi0 F               packing fraction of the random start (0.2; halved for each"},
    {515, "                         dimension above 3)"},
    {515, "  --diameters-ratio R    the second half of the spheres is R times as large (1)"},
    {515, "  --sizes LAW            diameters by a law: equal, list, uniform, normal, lognormal, power,"},
    {515, "                         weibull or sieve. Examples: lognormal:deviation=0.3,draw=random,"},
    {515, "                         list:1=0.5,1.4=0.5, sieve:FILE with a cumulative curve. Or a file"},
    {515, "                         of diameters. Only ratios count, unless a density gives the number"},
    {515, "                         of spheres"},
    {515, "  --least-distance H     the surfaces of all spheres of --sizes stay this far apart, in the"},
    {515, "                         unit of the sizes, and half of it from walls: they grow in shells"},
    {515, "                         of H/2; with a density, and without --n"},
    {767, "  --non-additivity D     spheres of unequal diameters touch at (1 + D) times their mean"},
    {767, "                         diameter, -1 < D <= 1 (0)"},
    {519, "  --model euclid|mk      distance: Euclidean (default) or Mari-Kurchan"},
    {519, "  --zeta Z               strength of the Mari-Kurchan shifts (infinite)"},
    {515, "  --plant F              Mari-Kurchan start, planted in equilibrium at packing fraction F"},
    {519, "  --seed S               of all random numbers (1)"},
    {767, "  --input FILE           start from a file: plain text, extended XYZ, LAMMPS data or dump,"},
    {767, "                         or a table x y z radius. It may be compressed. Molecular dynamics"},
    {767, "                         is then off unless --growth or --nve is given"},
    {767, "  --frame K              which packing of an --input with several: 0 is the first, -1 the"},
    {767, "                         last (-1)"},
    {767, "  --box L                side of the box, for a random start or a file that gives no box (1)"},
    {767, "  --cell LX,LY,..        sides of the periodic brick of a random start, which keep their"},
    {767, "                         axes, or of a file that names no cell; or all components of the"},
    {767, "                         cell vectors, one vector after the other"},
    {767, "  --origin X,Y,..        where the corner of the cell is in a file that does not say it (0)"},
    {767, "  --columns A,B,..       what the columns of a table contain, in order: x, y, z (or x1, x2,"},
    {767, "                         ..) and radius or diameter; others are not read"},
    {767, "  --tile NX,NY,..        NX x NY x .. copies of the packing of the file, side by side along"},
    {767, "                         the cell vectors"},
    {767, "  --walls none|x|y|xy|z|xz|yz|xyz"},
    {767, "                         flat walls at both ends of these axes, of a random start or of a"},
    {767, "                         file that names no walls (none)"},
    {767, "  --container brick|cylinder|ball"},
    {767, "                         container of a random start or of a file that names none: the brick"},
    {767, "                         of the cell (brick), or a shape in it that touches its faces."},
    {767, "                         --walls z closes the ends of a cylinder"},
    {527, "  --shrink               multiply all diameters of the file by the factor that brings the"},
    {527, "                         pair of largest overlap to contact; the summary gives the factor"},
    {527, "  --shrink-min F         refuse --shrink where its factor is below F <= 1, a sign of"},
    {527, "                         duplicates or wrong units (1e-3)"},
    {515, "Molecular dynamics"},
    {515, "  --nve C                first C collisions per particle without growth (0)"},
    {515, "  --growth RATE[:P]      one stage: growth rate G = (d sigma/dt)/sqrt(kT/m) up to reduced"},
    {515, "                         pressure P. Repeat the option for more stages. Default: 1e-2:500,"},
    {515, "                         then 3e-3 up to --pressure"},
    {515, "  --pressure P           target of stages without :P (1e6)"},
    {515, "  --packing-fraction F   grow to exactly this packing fraction, without a crunch, which"},
    {515, "                         would change it. With --sizes in the unit of --cell or --box, and"},
    {515, "                         without --n, the number of spheres follows from them, and the final"},
    {515, "                         diameters are those of the law"},
    {515, "  --porosity E           the same by the void fraction, 1 - F"},
    {513, "  --no-md                no molecular dynamics"},
    {527, "Checkpoints"},
    {527, "  --checkpoint FILE      state of the dynamics or of the crunch, every minute and where they"},
    {527, "                         stop early"},
    {527, "  --checkpoint-every SECONDS"},
    {527, "                         between checkpoints (60)"},
    {527, "  --resume FILE          continue from a checkpoint. Dynamics: to the same bits, the stage"},
    {527, "                         that was interrupted, then the stages of higher pressure. A crunch:"},
    {527, "                         from the packing of its last step"},
    {517, "Crunch"},
    {517, "  --method barrier|sequential-lp"},
    {517, "                         how the crunch finds the jamming point: barrier path (default), or"},
    {517, "                         the published sequence of linear programs alone"},
    {517, "  --strain none|edges|tilts|free"},
    {517, "                         let the cell deform too, at fixed volume: its edges, its tilts, or"},
    {517, "                         both; free: the packing ends strictly jammed (none)"},
    {517, "  --lp ipm|clp           linear programs by interior point (default) or Clp's simplex"},
    {517, "  --duality-gap GAP      end the barrier path at this duality gap, 1e-12 .. 1e-2, with"},
    {517, "                         contacts from an LP there: for packings too large for the jamming"},
    {517, "                         point (0: the jamming point)"},
    {517, "  --threads T            1 .. 64 (1); 2 to 64 give the same bits, 1 may give others; more"},
    {517, "                         than 4 gain little"},
    {513, "  --no-crunch            stop after molecular dynamics"},
    {520, "Shear"},
    {520, "  --to G,..              the last strain of a simple shear, x moves with y; of several the"},
    {520, "                         shear turns at the first ones: 0.1,-0.1,0"},
    {520, "  --step G               strain between two minima (1e-3)"},
    {520, "  --resolution G         uncertainty of the strain of a plastic event (1e-6)"},
    {520, "  --until strain|event|jammed|unjammed"},
    {520, "                         end before the last strain: after the first plastic event, or at"},
    {520, "                         the first minimum that is jammed, or not jammed"},
    {520, "  --alpha A              exponent of the energy of soft spheres; without, the spheres are"},
    {520, "                         hard, and a crunch jams them at each strain"},
    {520, "  --rows FILE.csv        strain, stress, pressure, energy, contacts and events of each"},
    {520, "                         minimum"},
    {767, "Output"},
    {591, "  --output FILE          the packing. The ending sets the format: extended XYZ (.xyz,"},
    {591, "                         .extxyz), LAMMPS (.data, .lmp), ParaView (.vtp), plain text (.dat,"},
    {591, "                         .txt, none). With .gz appended the file is compressed"},
    {576, "  --scale S              all lengths of --output times S (1)"},
    {576, "  --density RHO          of the spheres, in the unit of --output, which is LAMMPS data (1)"},
    {655, "  --page FILE.html       a page that shows the packing in a browser, with forces,"},
    {655, "                         certificate and distributions; needs no network"},
    {517, "  --page-steps K         --page gets a slider over at most K states of the crunch before its"},
    {517, "                         end, each 16 bytes per sphere in d = 3 (0)"},
    {589, "  --contacts FILE        the contact network: i, j, unit vector, gap, force (mean 1), as"},
    {589, "                         .csv (also without an ending), .dump (LAMMPS dump local) or .vtp"},
    {589, "                         (ParaView)"},
    {581, "  --spectrum FILE.csv    lowest modes of the harmonic Hessian: omega^2, omega, inverse"},
    {581, "                         participation ratio"},
    {581, "  --modes K              how many --spectrum writes (100); 0: all, which needs 24 (d N)^2"},
    {581, "                         bytes, at most 2e9"},
    {581, "  --gaps FILE.csv        gaps h < 1 of pairs that are no contacts, sorted"},
    {581, "  --structure FILE.csv   one line per sphere: coordination, class, sums of contact vectors"},
    {581, "                         and forces, Q6, local packing fraction"},
    {533, "  --prove                a theorem about the jammed packing, valid despite rounding; the"},
    {533, "                         summary and the report say what was proved"},
    {533, "  --proof FILE           the exact numbers of the proof, for the checker jamproof.py"},
    {533, "  --strict-proof FILE    the same of strict jamming, where the cell deforms too: of packings"},
    {533, "                         that --strain free makes"},
    {528, "  --strict               check: the exit status is that of strict jamming, where the cell"},
    {528, "                         deforms too"},
    {527, "  --report FILE|-        numbers, protocol and certificate as JSON; - is standard output"},
    {527, "  --log FILE|-           messages of the library on each stage and LP, one line each with"},
    {527, "                         its time"},
    {581, "  --vtk PREFIX           PREFIX.vtp and PREFIX-forces.vtp for ParaView"},
    {711, "\t  --plot PICTURE         spheres, forces and the way there, by matplotlib"},
    {767, "  --json                 JSON on standard output in place of the summary"},
    {767, "  --quiet                no progress, no summary"},
    {704, "Pore space"},
    {576, "  --stl FILE.stl         the solid as a closed mesh of triangles, spheres cut at the faces"},
    {576, "                         of the cell; d = 3"},
    {576, "  --stl-edge A           edge of the triangles over the radius, 0.03..1 (0.2)"},
    {576, "  --stl-shrink F         all diameters of the mesh times F, so that no spheres touch"},
    {576, "  --stl-bridge B         a cylinder along each contact, its radius B times that of the"},
    {576, "                         smaller sphere, 0.02..0.45"},
    {576, "  --stl-bridge-gap H     bridges between all pairs within this gap over the contact"},
    {576, "                         distance, in place of contacts that balance"},
    {576, "  --stl-walls FILE.stl   the walls of the container as a mesh of their own, with --stl-edge;"},
    {576, "                         d = 3"},
    {576, "  --voxels FILE          the solid as an image, .npy, .mha (MetaImage) or .vti (VTK): 0"},
    {576, "                         void, 1 solid, 2 outside a round container"},
    {576, "  --voxel-size A         edge of a voxel, about (a hundredth of the box)"},
    {576, "  --voxel-lines L        shares of the voxels in place of 0 and 1, by exact lengths on"},
    {576, "                         L^(d-1) lines each (0: the centre decides)"},
    {576, "  --profile FILE.csv     solid fraction in slabs along each axis, and in shells of a round"},
    {576, "                         container"},
    {576, "  --profile-bins K       slabs and shells of --profile (100)"},
    {576, "  --pores FILE.csv       pore sizes at random points of the void: distance to the nearest"},
    {576, "                         surface, radius of the largest sphere with the point"},
    {576, "  --pore-points K        points of --pores (10000)"},
    {576, "  --pore-seed S          of these points (1)"},
    {576, "  --near-coordination FILE.csv"},
    {576, "                         spheres within a gap of each sphere; needs no contact network"},
    {704, "  --contact-gap H        contacts are all pairs within this gap over the contact distance,"},
    {704, "                         whether forces on them balance or not: for beds under weight and"},
    {704, "                         friction. Tables then have no forces"},
    {576, "  --near-gap H           this gap over the contact distance (0.01)"},
    {1023, "Other"},
    {767, "  --wall-time SECONDS    limit for the whole run"},
    {1023, "  --help                 these lines"},
    {1023, "  --version              version and commit of the library"},
    {512, ""},
    {512, "Ctrl-C stops the computation, and the requested files are still written. Progress is one"},
    {512, "changing line on a terminal, with a bar and the time left where it is known, and one line"},
    {512, "every ten seconds in a pipe or a file."},
    {512, ""},
    {512, "Exit status 0: done, and jammed unless --no-crunch. 1: stopped early, a stage stalled, or"},
    {512, "not jammed; the valid state reached is written. 2: wrong command line. 3: request or input"},
    {512, "refused, or the computation failed. 4: an output cannot be written."},
    {512, ""},
    {512, "With --input the verdict is that of the end state, after the crunch. 'check FILE' tests the"},
    {512, "packing of a file as it is and moves nothing. One paragraph says whether it is jammed,"},
    {512, "strictly jammed, not jammed or undecided, and why. Exit status of check 0: jammed (with"},
    {512, "--strict: strictly). 1: not. 3: undecided. 2: wrong command line, or the file is refused."},
    {0, NULL}};

typedef struct verb_row {
  const char *name, *first, *second; /* options that its words without dashes stand for, or NULL */
} verb_row;

static const verb_row verb_table[] = {
    {"pack", NULL, NULL},
    {"compress", "--input", NULL},
    {"crunch", "--input", "--output"},
    {"shear", "--input", "--output"},
    {"check", "--input", NULL},
    {"info", "--input", NULL},
    {"export", "--input", "--output"},
    {"page", "--input", "--page"},
    {"ensemble", NULL, NULL},
};
#endif
#endif

"""The options of python3 -m jam: made by bindings/gen/generate.py from bindings/gen/options.py; do not edit."""
# fmt: off

ABOUT = (
    'Makes a jammed packing of hard spheres: random start, event-driven molecular dynamics with '
    'growth, then iterated linear programming down to the jamming point. '
)
STAGES = ((0.01, 500.0), (0.003, 10000000.0))  # rate and pressure of the stages of growth by default
EXAMPLE = '--n 1024 --seed 1 --output packing.xyz --page packing.html --report -'
NOTES = (
    'Ctrl-C stops the computation, and what was asked for is still written. Into a pipe or a file '
    'progress goes as a line every ten seconds, on a terminal as one line that changes. '
    'Exit status 0: done, and jammed unless --no-crunch. 1: stopped early, a stage stalled, or not '
    'jammed; the valid state reached is written. 2: wrong command line. 3: request or input refused, '
    'or the computation failed. 4: an output cannot be written. '
    "With --input the verdict is that of the end state, after the crunch. 'check FILE' judges the "
    'packing of a file as it is and moves nothing. It takes --box, --frame, --non-additivity, '
    '--prove, --proof, --wall-time and --quiet. One paragraph says whether it is jammed, strictly '
    'jammed, not jammed or undecided, and why. Exit status of check 0: jammed. 1: not. 3: undecided. '
    '2: wrong command line, or the file is refused. '
)
# name, kind, metavar, default, (low, high), words, needs the crunch, no effect beside, no effect without, help
OPTIONS = (
    # Start
    ('n', 'integer', 'N', None, (1, 2147483647), (), False, ('input',), (),
        'spheres (1024)'),
    ('dim', 'integer', 'D', 3, (2, 8), (), False, ('input',), (),
        'dimension, 2..8 (3)'),
    ('phi0', 'positive', 'F', None, (0, 0), (), False, ('input', 'plant'), (),
        'packing fraction of the random start (0.2; halved for each dimension above 3)'),
    ('diameters-ratio', 'positive', 'R', 1.0, (0, 0), (), False, ('input', 'sizes'), (),
        'half of the spheres are R times as large (1)'),
    ('sizes', 'sizes', 'LAW', None, (0, 0), (), False, ('input',), (),
        'diameters by a law: equal, list, uniform, normal, lognormal, power, weibull or sieve. Examples: '
        'lognormal:deviation=0.3,draw=random, list:1=0.5,1.4=0.5, sieve:FILE with a cumulative curve. Or '
        'a file of diameters. Only ratios count, unless a density gives the number of spheres'),
    ('non-additivity', 'delta', 'D', 0.0, (0, 0), (), False, (), ('sizes', 'diameters-ratio', 'input', 'resume'),
        'spheres of unequal diameters touch at (1 + D) times their mean diameter, -1 < D <= 1 (0)'),
    ('model', 'choice', '', 'euclid', (0, 0), ('euclid', 'mk'), False, (), (),
        'distance: Euclidean (default) or Mari-Kurchan'),
    ('zeta', 'not_negative', 'Z', None, (0, 0), (), False, (), (),
        'strength of the Mari-Kurchan shifts (infinite)'),
    ('plant', 'positive', 'F', None, (0, 0), (), False, ('input',), (),
        'Mari-Kurchan start, planted in equilibrium at packing fraction F'),
    ('seed', 'integer', 'S', 1, (-9223372036854775807, 9223372036854775807), (), False, (), (),
        'of all random numbers (1)'),
    ('input', 'input', 'FILE', None, (0, 0), (), False, (), (),
        'start from a file: plain text, extended XYZ, LAMMPS data or dump, or a table x y z radius. It '
        'may be compressed. Molecular dynamics is then off unless --growth or --nve is given'),
    ('frame', 'integer', 'K', -1, (-2147483647, 2147483647), (), False, (), ('input', 'resume'),
        'which packing of an --input that holds several: 0 is the first, -1 the last (-1)'),
    ('box', 'positive', 'L', 1.0, (0, 0), (), False, (), (),
        'side of the box, for a random start or a file that gives no box (1)'),
    ('cell', 'cell', 'LX,LY,..', None, (0, 0), (), False, ('input', 'resume', 'box'), (),
        'sides of a periodic brick for a random start, or all components of its cell vectors, one vector '
        'after the other'),
    ('shrink', 'switch', '', None, (0, 0), (), False, (), ('input', 'resume'),
        'multiply all diameters of the file by the factor that brings the worst pair to contact; the '
        'summary gives it'),
    ('shrink-min', 'not_negative', 'F', 0.001, (0, 0), (), False, (), ('shrink',),
        'refuse --shrink where its factor is below F <= 1, a sign of duplicates or wrong units (1e-3)'),
    # Molecular dynamics
    ('nve', 'not_negative', 'C', 0.0, (0, 0), (), False, (), (),
        'first C collisions per particle without growth (0)'),
    ('growth', 'stage', 'RATE[:P]', None, (0, 0), (), False, (), (),
        'one stage: growth rate G = (d sigma/dt)/sqrt(kT/m) up to reduced pressure P. Give it again for '
        'more stages. Default: 1e-2:500, then 3e-3 up to --pressure'),
    ('pressure', 'pressure', 'P', 10000000.0, (0, 0), (), False, (), (),
        'target of stages without :P (1e7)'),
    ('packing-fraction', 'fraction', 'F', None, (0, 0), (), False, ('no-md', 'porosity', 'plant', 'zeta'), (),
        'grow to exactly this packing fraction, without a crunch, which would change it. With --sizes in '
        'the unit of --cell or --box, and without --n, the number of spheres follows and the diameters '
        'end as the law says'),
    ('porosity', 'fraction', 'E', None, (0, 0), (), False, ('no-md', 'plant', 'zeta'), (),
        'the same by the void fraction, 1 - F'),
    ('no-md', 'switch', '', None, (0, 0), (), False, (), (),
        'none'),
    # A job that may be killed
    ('checkpoint', 'output', 'FILE', None, (0, 0), (), False, (), (),
        'state of the dynamics or of the crunch, every minute and where they stop early'),
    ('checkpoint-every', 'positive', 'SECONDS', 60.0, (0, 0), (), False, (), ('checkpoint',),
        'between checkpoints (60)'),
    ('resume', 'input', 'FILE', None, (0, 0), (), False, (), (),
        'go on from a checkpoint. Dynamics: to the same bits, the stage that was cut off, then those '
        'stages whose pressure lies beyond. A crunch: from the packing of its last step'),
    # Crunch
    ('method', 'choice', '', 'barrier', (0, 0), ('barrier', 'sequential-lp'), False, ('no-crunch', 'packing-fraction', 'porosity'), (),
        'the quench: barrier path (default), or the published sequence of linear programs alone'),
    ('strain', 'choice', '', 'none', (0, 0), ('none', 'edges', 'tilts', 'free'), False, ('no-crunch', 'packing-fraction', 'porosity'), (),
        'let the cell deform too, at fixed volume: its edges, its tilts, or both; free: the packing ends '
        'strictly jammed (none)'),
    ('lp', 'choice', '', 'ipm', (0, 0), ('ipm', 'clp'), False, ('no-crunch', 'packing-fraction', 'porosity'), (),
        "linear programs by interior point (default) or Clp's simplex"),
    ('duality-gap', 'not_negative', 'GAP', 0.0, (0, 0), (), False, ('no-crunch', 'packing-fraction', 'porosity'), (),
        'end the barrier path at this duality gap, 1e-12 .. 1e-2, with contacts from an LP there: for '
        'packings too large for the jamming point (0: the jamming point)'),
    ('threads', 'integer', 'T', 1, (1, 2), (), False, ('no-crunch', 'packing-fraction', 'porosity'), (),
        '1 or 2 (1; the same bits each time on 1)'),
    ('no-crunch', 'switch', '', None, (0, 0), (), False, (), (),
        'stop after molecular dynamics'),
    # Output
    ('output', 'output', 'FILE', None, (0, 0), (), False, (), (),
        'the packing. The ending sets the format: extended XYZ (.xyz, .extxyz), LAMMPS (.data, .lmp), '
        'ParaView (.vtp), plain text (.dat, .txt, none). With .gz behind it the file is compressed'),
    ('page', 'output', 'FILE.html', None, (0, 0), (), False, (), (),
        'the packing to look at in a browser, with forces, certificate and distributions; needs no '
        'network'),
    ('page-steps', 'integer', 'K', 0, (0, 1000), (), False, ('no-crunch', 'packing-fraction', 'porosity'), ('page',),
        '--page gets a slider over at most K states of the crunch before its end, each 16 bytes a sphere '
        'in d = 3 (0)'),
    ('contacts', 'output', 'FILE', None, (0, 0), (), True, (), (),
        'the contact network: i, j, unit vector, gap, force (mean 1), as .csv (also without an ending), '
        '.dump (LAMMPS dump local) or .vtp (ParaView)'),
    ('spectrum', 'output', 'FILE.csv', None, (0, 0), (), True, (), (),
        'lowest modes of the harmonic Hessian: omega^2, omega, participation'),
    ('modes', 'integer', 'K', None, (0, 2147483647), (), False, (), ('spectrum',),
        'how many --spectrum writes (100); 0: all, which needs 24 (d N)^2 bytes, at most 2e9'),
    ('gaps', 'output', 'FILE.csv', None, (0, 0), (), True, (), (),
        'gaps h < 1 of pairs that are no contacts, sorted'),
    ('structure', 'output', 'FILE.csv', None, (0, 0), (), True, (), (),
        'a line a sphere: coordination, class, sums of contact vectors and forces, Q6, local packing '
        'fraction'),
    ('prove', 'switch', '', None, (0, 0), (), False, ('no-crunch',), (),
        'a theorem about the jammed packing, in spite of rounding; the summary and the report say what '
        'was proved'),
    ('proof', 'output', 'FILE', None, (0, 0), (), True, (), (),
        'the exact numbers of the proof, for the checker jamproof.py'),
    ('report', 'output', 'FILE|-', None, (0, 0), (), False, (), (),
        'figures, protocol and certificate as JSON; - is standard output'),
    ('log', 'output', 'FILE|-', None, (0, 0), (), False, (), (),
        'what the library says of each stage and LP, a line each with its time'),
    ('vtk', 'text', 'PREFIX', None, (0, 0), (), False, (), (),
        'PREFIX.vtp and PREFIX-forces.vtp for ParaView'),
    ('plot', 'output', 'PICTURE', None, (0, 0), (), False, (), (),
        'spheres, forces and the way there, by matplotlib'),
    ('quiet', 'switch', '', None, (0, 0), (), False, (), (),
        'no progress, no summary'),
    # Other
    ('wall-time', 'positive', 'SECONDS', None, (0, 0), (), False, (), (),
        'limit for the whole run'),
)

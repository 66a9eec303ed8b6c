// All texts of the page, in English. Another language is another file like this one.
export const TEXT = {
  tabs: { learn: 'Learn', make: 'Make', check: 'Check', prove: 'Prove', look: 'View', save: 'Save' },
  starting: 'The library starts.',
  ready: (version) => `libjam ${version} is ready. It runs in this page; nothing is sent anywhere.`,
  kept: 'This browser keeps your choices, your results of a class and the last packing in its storage, so that they are ' +
    'there after a reload. Nothing leaves this machine.',
  notKept: 'This browser refuses storage to this page: after a reload everything is gone. Save files before.',
  forget: 'Forget all', forgotten: 'Everything that this page kept is gone from the storage of the browser.',
  back: (n, dim) => `The last packing is back: ${n} spheres in d = ${dim}.`,
  stop: 'Stop', busy: 'Something runs: stop it first.',
  half: (n, dim) => `A packing that was not finished is back: ${n} spheres in d = ${dim}. Continue, in Make, finishes it.`,
  stopped: 'Stopped. The packing is as it was about a second before.',
  left: (s) => (Number.isFinite(s) ? `about ${s < 90 ? `${Math.max(1, Math.round(s))} s` : `${Math.round(s / 60)} min`} left` : ''),
  noPacking: 'There is no packing yet: make one, or choose a file.',
  view: 'Picture of the packing, with its numbers',
  noView: 'This browser has no WebGL2, so pictures stay empty. All numbers are there.',
  noMemory: 'Close other pages, or use fewer spheres, or use the program jam-pack.',
  tooLarge: (mb) => `The file has ${mb} MB; this page takes up to 64 MB. Use jam-pack check FILE on a computer.`,
  empty: (name) => `${name} is empty.`,
  make: {
    title: 'Make a packing', n: 'Spheres', dim: 'Dimension', seed: 'Seed', go: 'Make it', goOn: 'Continue', density: 'Packing fraction',
    densityHint: 'Empty: up to the jamming point. Or a number such as 0.57, at which growth ends.',
    porosity: 'or porosity', law: 'Sizes', items: 'Parameters', curve: 'Rows', walls: 'Walls', protocol: 'Protocol',
    laws: { equal: 'all equal', two: 'two sizes, half each', lognormal: 'lognormal', uniform: 'uniform', normal: 'normal',
      power: 'power law', weibull: 'Weibull', list: 'list of sizes', sieve: 'sieve curve' },
    hints: { two: 'ratio of the sizes', lognormal: 'deviation=0.3,draw=random', uniform: 'low=0.7,high=1.3',
      normal: 'mean=1,deviation=0.1', power: 'exponent=-3,low=1,high=3', weibull: 'scale=1,shape=4' },
    curveHint: 'One row a line: a size and its share (list), or a size and the share that passes (sieve, from 0 to 1).',
    enclosures: { none: 'none: periodic', x: 'flat, across x', z: 'flat, across z', xy: 'flat, across x and y',
      xyz: 'flat, on all sides', ball: 'ball (a circle in d = 2)', cylinder: 'cylinder along z' },
    protocols: { usual: 'usual: 1e-2, then 3e-3', fast: 'fast: growth rate 3e-2', slow: 'slow: growth rate 1e-3' },
    example: '500 spheres at 57 %',
    growing: (phi) => `Spheres grow: packing fraction ${phi.toFixed(4)}`,
    crunching: (phi) => `To the jamming point: packing fraction ${phi.toFixed(6)}`,
    made: (phi, contacts, excess, rattlers) => `Jammed: phi_J = ${phi}, ${contacts} contacts, ${excess} above ` +
      `isostatic, ${rattlers} rattlers`,
    unjammed: (phi, why) => `Packing fraction ${phi}; not shown to be jammed (${why})`,
    grown: (phi) => `Grown to the packing fraction ${phi}`,
    memory: (mb, limit) => `The crunch would take about ${mb} MB, and a page has ${limit} MB: use fewer spheres, or jam-pack.`,
  },
  check: {
    title: 'Is it jammed?', drop: 'Drop a file here, or choose one:', choose: 'Choose a file', own: 'Check this packing',
    formats: 'Any file that libjam reads: extended XYZ, LAMMPS data and dumps, tables and more, also with gzip.',
    reading: (name) => `Reading ${name}`, running: 'The check runs.', assumed: 'What was assumed in reading',
    nothing: 'Nothing was assumed.', weakest: (i, j, f) => `Weakest contact: ${i} and ${j}, ${f} of the mean force`,
    wall: (w) => `wall ${w}`, contacts: 'Strongest contacts', rattlers: (list, more) => `Rattlers: ${list}${more}`,
    andMore: (k) => ` and ${k} more`, noRattlers: 'There are no rattlers.', pair: 'spheres', force: 'force over mean', gap: 'gap',
    flex: 'It is not held: the picture shows the motion that keeps all its contacts closed.',
    flexName: 'motion that is left',
  },
  prove: {
    title: 'Prove it', go: 'Prove this packing', running: 'The proof runs.', save: 'Save the proof file',
    radius: (r, digits) => `Centres are within ${r} of exact ones: about ${digits} digits.`,
    other: 'Check a proof file', hint: 'The checker is a program of its own. It knows nothing of libjam and uses whole numbers alone.',
    running2: 'The checker runs.', words: ['proved', 'not proved', 'cannot be read', 'trapped'],
  },
  look: {
    title: 'View, and count together', page: 'Open the page of this packing', add: 'Add this packing to the table',
    table: 'Results of the class', csv: 'Save as CSV', load: 'Add a CSV of somebody else', clear: 'Empty the table',
    which: 'Histogram of', quantities: { phi: 'packing fraction', rattlers: 'rattlers', contacts: 'contacts' },
    few: 'Add at least two packings, each with a seed of its own.', rows: (k) => `${k} packings`,
    badCsv: 'This is not a table of this page: its first line is not n,dim,seed,phi,contacts,rattlers.',
    mean: (m, s) => `mean ${m}, standard deviation ${s}`,
  },
  save: {
    title: 'Save', xyz: 'Extended XYZ', lammps: 'LAMMPS data', csv: 'Contacts as CSV', stl: 'Surfaces (STL)',
    html: 'Page of this packing', again: 'The same packing, bit for bit',
    program: 'On the command line', python: 'In Python', fromFile: 'No seed makes this packing: save it, and these lines check the file.',
  },
  learn: 'Six steps to jamming',
  done: 'Do it',
};

// The steps of the theory page, each with something to do: a form that is filled in, a tab, or a look.
export const STEPS = [
  { title: '1. Jamming', text: 'Put hard disks at random into a box and let them grow while they move and collide. The ' +
    'share of the area that they cover, the packing fraction, rises. At some point no disk can grow any more: the packing ' +
    'is jammed. The box is periodic: what leaves on the right enters on the left.',
    task: 'Make 100 disks of two sizes and watch them grow. Write down their packing fraction.',
    form: { n: 100, dim: 2, seed: 4, law: 'two', items: '1.4' } },
  { title: '2. No single density', text: 'Two seeds give two packings with two densities. Many small packings scatter; ' +
    'large ones lie closer together. Slow growth gives denser packings. So a density belongs to a protocol and a size.',
    task: 'Make the same packing with seed 5 and with seed 6. Add each to the table of View.',
    form: { n: 100, dim: 2, seed: 5, law: 'two', items: '1.4' } },
  { title: '3. Rattlers', text: 'A few disks have no contact that carries force. Such a rattler lies in a cage of others ' +
    'and can move in it. Without rattlers the packing would stay jammed.',
    task: 'Find the grey disks in the picture. Click one: it has no contacts. Count them for three seeds.', tab: 'look' },
  { title: '4. Count the contacts', text: 'N disks that are not rattlers have d N coordinates. Moving all of them together ' +
    'changes nothing, so d (N - 1) are left, and the common size of all disks is one unknown more. Each contact is one ' +
    'equation. A disordered jammed packing has as many contacts as unknowns: d (N - 1) + 1.',
    task: 'Make 256 spheres in d = 3 and compute 3 (256 - rattlers - 1) + 1. Compare with the number of contacts.',
    form: { n: 256, dim: 3, seed: 1, law: 'equal', items: '' } },
  { title: '5. Forces without a load', text: 'The contacts carry forces, and on each sphere they add up to zero. There is ' +
    'one force more than there are equations of balance: geometry alone decides all forces, up to a common factor.',
    task: 'Tick Forces in the picture. Then Check: which is the weakest contact? Does it touch a buckler (orange)?', tab: 'check' },
  { title: '6. How sure is it?', text: 'A computer rounds. A proof shows that an exactly jammed packing lies within a tiny ' +
    'distance of the computed one. Whoever doubts it can check the proof with whole numbers alone.',
    task: 'Prove your packing, save the proof file, and let the checker read it.', tab: 'prove' },
];

% The module for Octave: packings from words and options to reports, arrays as (n, d), indices from 1, errors with text.
% usage: octave octave.m FOLDER     where files may be written
jam;
folder = argv(){end};
function fails(id, text, f)
  try
    f();
  catch problem
    assert(problem.identifier, id);
    assert(! isempty(strfind(problem.message, text)), problem.message);
    return;
  end
  error("no error %s", id);
end

% starts, words and options, in both forms
p = jam.random(64, "dim", 2, "seed", 7);
q = jam.random(64, struct("dim", 2, "seed", 7));
assert(p.positions(), q.positions());
assert(size(p.positions()), [64, 2]);
assert(size(p.diameters()), [64, 1]);
assert(p.info().dim, 2);
made = jam.create("n", 64, "dim", 2, "positions", p.positions(), "diameters", p.diameters(), "cell", p.cell());
assert(made.positions(), p.positions());  % rows are spheres, on the way in and out
other = p.copy();
md = p.compress();
assert(other.positions(), q.positions());  % copies are apart
r = p.crunch("method", "sequential_lp", "polish", true);
assert(r.status, "ok");
assert(r.jammed && islogical(r.jammed));
assert(r.stop_reason, "converged");

% numbers are numbers, flags are true or false: no text and no fraction is one
fails("jam:argument", "polish must be true or false", @() p.crunch("polish", "no"));
fails("jam:argument", "whole number", @() p.crunch("max_lps", 2.5));
fails("jam:argument", "whole number", @() jam.random(16, "overlap", 0.7));
assert(p.crunch("polish", 1).jammed);
for bad = {uint64(2 ^ 32 + 2), int64(-2 ^ 40), 2 ^ 40, [2, 3], 2 + 1i, "2", [], {2}}
  fails("jam:argument", "dim must be a whole number", @() jam.random(16, "dim", bad{1}));
end
for bad = {intmax("uint64"), [5, 2], 3 + 1i, "7", NaN}
  fails("jam:argument", "seed must be a whole number", @() jam.random(16, "seed", bad{1}));
  fails("jam:argument", "count must be a whole number", @() p.modes("count", bad{1}));
end
for bad = {[0.1, 0.3], 0.1 + 1i, "x", []}
  fails("jam:argument", "packing_fraction must be a number", @() jam.random(16, "packing_fraction", bad{1}));
  fails("jam:argument", "h_max must be a number", @() p.gaps(bad{1}));
end
assert(jam.random(16, "dim", int8(2), "packing_fraction", single(0.25)).info().dim, 2);

% arrays are (n, d) also where a packing is made, and are there or left out, not empty
for bad = {q.positions()', zeros(64, 3), [], zeros(0, 2), "12", q.positions() + 1i, {1, 2}}
  fails("jam:argument", "positions", @() jam.create("dim", 2, "positions", bad{1}, "diameters", q.diameters()));
end
fails("jam:argument", "positions cannot have the size 3x20", @() jam.create("positions", rand(3, 20), "diameters", 1e-3));
fails("jam:argument", "diameters cannot have the size 2x2", @() jam.random(4, "diameters", ones(2, 2)));
fails("jam:argument", "cell cannot have the size 2x3", @() jam.random(4, "dim", 2, "cell", ones(2, 3)));
fails("jam:argument", "diameters", @() jam.random(4, "diameters", "1234"));

% contacts: indices from 1, rows in the order of forces
pairs = p.contacts();
force = p.forces();
assert(size(pairs), [numel(force), 2]);
assert(min(pairs(:)) >= 1 && max(pairs(:)) <= 64 && all(pairs(:, 1) != pairs(:, 2)));
v = p.contact_vectors();
x = p.positions();
for k = [1, numel(force)]
  box = p.cell();
  apart = x(pairs(k, 1), :) - x(pairs(k, 2), :);
  apart -= round(apart / box) * box;
  assert(apart / norm(apart), v(k, :), 1e-6);
end

% tables, several outputs, ranks above two, other packings, texts
history = p.crunch_history();
assert(numel(history.phi), numel(history.gain));
[gap, pair] = p.gaps(1.0, true);
assert(size(pair), [numel(gap), 2]);
[modes, vectors] = p.modes("count", 3);
assert(size(vectors), [3, numel(p.hessian_map()), 2]);
[row, column, value] = p.hessian();  % compressed rows, from 1
assert(row([1, end]), [1; numel(value) + 1]);
assert([min(column), max(column)], [1, numel(row) - 1]);
check = p.check("prove", true);
assert(! isempty(check.text));
assert(ischar(jam.version()) && ischar(p.notes()) && jam.abi_version() == 1);
tiled = p.tile([2, 1]);
assert(tiled.info().n, 128);

% files and checkpoints
file = fullfile(folder, "octave.xyz");
p.write(file, "xyz");
assert(max(abs(jam.read(file).positions() - p.positions())(:)) < 1e-12);
p.write_checkpoint(fullfile(folder, "octave.jam"));
assert(jam.read_checkpoint(fullfile(folder, "octave.jam")).positions(), p.positions());

% a function that watches, stops and fails
global calls = 0;
function stop = watch(now)
  global calls;
  calls++;
  assert(ischar(now.phase));
  stop = true;
end
assert(q.crunch("progress", @watch).status, "cancelled");
assert(calls >= 1);
fails("mine:own", "of mine", @() q.crunch("progress", @(now) error("mine:own", "of mine")));

% errors: the library's sentence, and what this layer refuses before a call
fails("jam:argument", "n is -3", @() jam.random(-3));
fails("jam:state", "crunch", @() q.forces());
fails("jam:argument", "no option speed", @() q.crunch("speed", 1));
fails("jam:argument", "sequential_lp", @() q.crunch("method", "newton"));
fails("jam:argument", "cannot have the size", @() q.set_positions(q.positions()'));
fails("jam:null", "count", @() p.tile());
fails("jam:io", "no_such_file", @() jam.read("no_such_file.xyz"));
disp("Octave's module works");

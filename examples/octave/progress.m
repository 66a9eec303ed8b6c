% Watching and stopping a long call by a function. The state stays valid each time; Ctrl-C stops a call too.
% usage: octave progress.m
1;
function stop = watch(p)
  printf("  %s: phi %.6f after %.1f s\n", p.phase, p.packing_fraction, p.seconds);
  stop = p.packing_fraction > 0.3 || p.steps >= 3;
end
jam;
packing = jam.random(500, "seed", 1);
report = packing.crunch("progress", @watch);
printf("stopped by the function: %s\n", report.status);
try
  packing.crunch("progress", @(p) error("mine:own", "from the function"));
catch problem
  printf("an error in the function comes out of the call: %s\n", problem.message);
end
report = packing.crunch("max_lps", 1);  % limits are no errors either
printf("stopped by a limit: %s, and going on from there is another call\n", report.status);

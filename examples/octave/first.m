% From nothing to a jammed packing in two dimensions.  usage: octave first.m
jam;
% 200 disks, half of them 1.4 times as large so that they do not crystallise
packing = jam.random(200, "dim", 2, "seed", 1, "diameters", [ones(100, 1); 1.4 * ones(100, 1)]);
md = packing.compress();
printf("molecular dynamics: %d collisions, p = %.3g, phi = %.6f\n", md.collisions, md.pressure, md.packing_fraction);
report = packing.crunch();
printf("phi_J = %.12f, %d contacts, %d rattlers: %s\n", report.packing_fraction, report.contacts, report.rattlers, report.stop_reason);
assert(report.jammed);
packing.write("packing.xyz", "xyz");  % for OVITO and ASE

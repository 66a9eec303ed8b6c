% Brings the packing of a file to its jamming point.  usage: octave crunch_file.m IN OUT
jam;
files = argv();
packing = jam.read(files{end-1});
before = packing.info().packing_fraction;
report = packing.crunch("wall_time", 600);  % seconds; what was reached by then is kept
printf("phi %.6f -> %.12f (%s), %d contacts\n", before, report.packing_fraction, report.stop_reason, report.contacts);
printf("certificate: overlap %.1e, force imbalance %.1e\n", report.max_overlap, report.force_residual);
steps = packing.crunch_history();  % a struct with a column for each name
printf("%d steps; the density gained by the last: %.1e\n", numel(steps.gain), steps.gain(end));
packing.write(files{end}, "xyz");
exit(! report.jammed);

% Reads the contact network of a packing and checks the balance of forces.  usage: octave forces.m
jam;
packing = jam.random(128, "seed", 1);
packing.compress();
packing.crunch();
pairs = packing.contacts();            % (m, 2): spheres from 1; row k is contact k
vectors = packing.contact_vectors();  % (m, 3), from the second sphere to the first
forces = packing.forces();
net = zeros(size(packing.positions()));
for axis = 1:3
  along = forces .* vectors(:, axis);
  net(:, axis) = accumarray(pairs(:), [along; -along], [rows(net), 1]);
end
printf("%d forces, mean %.6f, worst imbalance %.1e\n", numel(forces), mean(forces), max(abs(net(:))));
assert(max(abs(net(:))) < 1e-8);
[gap, pair] = packing.gaps(1.0, true);  % h_max, stable spheres only
printf("%d gaps below 1, the smallest %.2e between %d and %d\n", numel(gap), gap(1), pair(1, :));

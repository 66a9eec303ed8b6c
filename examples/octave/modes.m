% Hessian, lowest vibrational modes and moduli of a packing.  usage: octave modes.m
jam;
packing = jam.random(200, "dim", 2, "seed", 1, "diameters", [ones(100, 1); 1.4 * ones(100, 1)]);
packing.crunch();
[start, column, value] = packing.hessian();  % compressed rows; indices from 1
row = repelems(1:numel(start) - 1, [1:numel(start) - 1; diff(start)'])';
hessian = sparse(row, column, value);
printf("Hessian %d x %d, %d entries, trace %.6g\n", size(hessian), nnz(hessian), full(trace(hessian)));
[modes, vectors] = packing.modes("count", 8);
for k = 1:8
  printf("omega %.5f  participation %.4f\n", sqrt(modes.lambda(k)), modes.participation(k));
end
u = squeeze(vectors(1, :, :))'(:);  % (N', d): displacements of the stable spheres
assert(abs(u' * hessian * u / (u' * u) / modes.lambda(1) - 1) < 1e-6);
moduli = packing.moduli();
printf("bulk modulus %.4f, shear modulus %.4f\n", moduli.bulk, moduli.shear);

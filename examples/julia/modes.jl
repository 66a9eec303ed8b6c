# Hessian and lowest vibrational modes of a packing.
using Jam, SparseArrays, LinearAlgebra

s = System(n = 200, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 100))
crunch!(s)
start, column, value = hessian_rows(s)  # compressed rows from 1; symmetric, so they are columns too
m = length(start) - 1
h = SparseMatrixCSC(m, m, Int.(start), Int.(column), value)
println("Hessian ", m, " by ", m, ", ", nnz(h), " entries, trace ", tr(h))

values, vectors = modes(s, 8)
println("lowest frequencies ", sqrt.(values))
u = vectors[:, 1]
@assert abs(dot(u, h * u) / values[1] - 1) < 1e-6

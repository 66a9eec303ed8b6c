# Hessian, vibrational modes, density of states and moduli of a packing.
using Jam, LinearAlgebra, SparseArrays

s = System(n = 200, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 100))
crunch!(s)

h = hessian(s)  # a SparseMatrixCSC; stiffness = :hard and :power are other stiffnesses
println("Hessian ", size(h, 1), " by ", size(h, 2), ", ", nnz(h), " entries, trace ", tr(h))

m = modes(s, 8)  # the lowest; which = :all gives every one
for (omega, spread) in zip(m.frequencies, m.participation)
    println("omega ", omega, "  participation ", spread)
end
u = m.vectors[:, 1]  # reshape(u, 2, :): displacements of the stable spheres m.spheres
@assert abs(dot(u, h * u) / m.values[1] - 1) < 1e-6

k = moduli(s)
println("bulk modulus ", k.bulk, " (", k.bulk_affine, " were all displacements affine), shear modulus ", k.shear)

dos = density_of_states(s; moments = 80)  # without computing modes: for large packings
println("density of states: ", length(dos), " rows, ", join(propertynames(dos), ", "))
@assert abs(dos.cumulative[end] - 1) < 0.05

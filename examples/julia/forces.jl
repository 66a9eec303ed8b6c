# Reads the contact network of a packing, checks the balance of forces, and compares forces at bucklers with the others.
using Jam, Statistics

s = System(n = 128, dim = 3, seed = 1)
compress!(s)
crunch!(s)
f, n, pairs = forces(s), contact_vectors(s), contacts(s)  # mean 1; d-by-m, from j to i; 2-by-m
net = zeros(3, 128)
for k in eachindex(f)
    net[:, pairs[1, k]] .+= f[k] .* n[:, k]
    net[:, pairs[2, k]] .-= f[k] .* n[:, k]
end
println(length(f), " forces, mean ", mean(f), ", worst imbalance ", maximum(abs, net))
@assert maximum(abs, net) < 1e-8

buckler = bucklers(s)
at_buckler = [buckler[i] || buckler[j] for (i, j) in eachcol(pairs)]  # these forces follow another power law
println("median force ", median(f), "; at bucklers ", median(f[at_buckler]))

gap, pair = gaps(s)  # below 1, of stable spheres
println(length(gap), " gaps below 1, the smallest ", gap[1], " between ", pair[1, 1], " and ", pair[2, 1])

contact_table(s)  # i, j, force, gap, x, y, z: a table for DataFrames and CSV

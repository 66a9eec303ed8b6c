# Reads the contact network of a packing and checks that the forces balance on every sphere.
using Jam

s = System(n = 128, dim = 3, seed = 1)
compress!(s)
crunch!(s)
f, n, pairs = forces(s), contact_vectors(s), contacts(s)  # mean 1; d-by-m; 2-by-m with indices from 1
net = zeros(3, 128)
for k in eachindex(f)
    net[:, pairs[1, k]] .+= f[k] .* n[:, k]
    net[:, pairs[2, k]] .-= f[k] .* n[:, k]
end
strongest = argmax(f)
println(length(f), " forces, the strongest ", f[strongest], " between spheres ", pairs[1, strongest], " and ",
        pairs[2, strongest], ", worst imbalance ", maximum(abs, net))
@assert maximum(abs, net) < 1e-8

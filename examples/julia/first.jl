# Makes a packing in two dimensions, crunches it, reads forces and modes, and stops a call from its progress function.
# Run: JAM_LIBRARY=build/libjam.so julia --project=bindings/julia/Jam examples/julia/first.jl
using Jam

s = System(n = 200, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 100))
compress!(s; growth_rate = 1e-2, pressure = 1e3)
r = crunch!(s)
println(s)
println("phi_J = ", r.packing_fraction, ", contacts = ", r.contacts, ", rattlers = ", r.rattlers,
        ", excess = ", r.excess_contacts)

f, n, pairs = forces(s), contact_vectors(s), contacts(s)  # indices from 1
strongest = argmax(f)
println("strongest force ", f[strongest], " between spheres ", pairs[1, strongest], " and ", pairs[2, strongest])

values, vectors = modes(s, 5)
println("lowest frequencies ", sqrt.(values))

write("packing.xyz", s)
again = System("packing.xyz")  # the same bits
@assert positions(again) == positions(s)

big = System(n = 500, dim = 3, seed = 1)
steps = Ref(0)
crunch!(big; progress = p -> (steps[] += 1) >= 3)  # true stops
println("stopped with status ", big.status, " (", Jam.JAM_CANCELLED, " is cancelled), phi = ", info(big).packing_fraction)

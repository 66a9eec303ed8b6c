# From nothing to a jammed packing of disks.
# Run: JAM_LIBRARY=build/libjam.so julia --project=bindings/julia/Jam examples/julia/first.jl
using Jam

s = System(n = 200, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 100))
md = compress!(s; growth_rate = 1e-2, pressure = 1e3)
println("collisions ", md.collisions, ", phi ", md.packing_fraction)
r = crunch!(s)
println(s)
println("phi_J = ", r.packing_fraction, ", contacts = ", r.contacts, ", rattlers = ", r.rattlers,
        ", excess = ", r.excess_contacts)

write("packing.xyz", s)
again = System("packing.xyz")  # the same bits
@assert positions(again) == positions(s)

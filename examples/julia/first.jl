# From nothing to a jammed packing of disks, and its picture.  usage: first.jl [PICTURE.svg]
# Run: JAM_LIBRARY=build/libjam.so julia --project=build/julia/Jam examples/julia/first.jl
using Jam

# 200 disks, half of them 1.4 times as large so that they do not crystallise
s = System(n = 200, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 100))
md = compress!(s; stages = [(3e-2, 500), (1e-2, 1e5)], progress = true)  # (growth rate, reduced pressure)
println("molecular dynamics: ", md.collisions, " collisions, p = ", md.pressure, ", phi = ", md.packing_fraction)

r = crunch!(s; progress = true)
show(stdout, MIME"text/plain"(), r)  # what the REPL prints: the report with its certificate
println()
r.jammed || error("not jammed: $(r.stop_reason)")

write("packing.xyz", s)  # for OVITO and ASE
write_contacts("forces.vtp", s)  # for ParaView
picture(isempty(ARGS) ? "packing.svg" : ARGS[1], s)
again = Jam.read("packing.xyz")  # the same bits
@assert positions(again) == positions(s)

# Brings a packing from a file to its jamming point and writes it again.  usage: crunch_file.jl IN OUT
using Jam

length(ARGS) == 2 || error("usage: crunch_file.jl IN OUT")
s = System(ARGS[1])  # plain text or extended XYZ
before = info(s).packing_fraction
r = crunch!(s; wall_time = 600.0)  # seconds; what was reached by then is kept
println("phi ", before, " -> ", r.packing_fraction, ", ", r.contacts, " contacts, ", r.excess_contacts, " more than isostatic")
println("overlap ", r.max_overlap, ", force imbalance ", r.force_residual)
write(ARGS[2], s)
r.jammed == 1 || exit(1)

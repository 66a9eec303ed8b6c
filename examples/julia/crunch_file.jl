# Brings the packing of a file to its jamming point.  usage: crunch_file.jl IN OUT [PICTURE.svg]
using Jam

length(ARGS) in (2, 3) || error("usage: crunch_file.jl IN OUT [PICTURE.svg]")
s = System(ARGS[1])  # plain text, extended XYZ, LAMMPS, a table
before = packing_fraction(s)
r = crunch!(s; wall_time = 600, progress = true)  # seconds; what was reached by then is kept
println("phi ", before, " -> ", r.packing_fraction, " (", r.stop_reason, "), ", r.contacts, " contacts (", r.excess_contacts,
        " more than one state of self-stress needs), ", r.rattlers, " rattlers")
println("certificate: overlap ", r.max_overlap, ", force imbalance ", r.force_residual)

steps = history(s)  # a table, one row a step of the crunch
println(length(steps), " steps; the density gained by the last: ", steps[end].gain)

write(ARGS[2], s)
length(ARGS) > 2 && picture(ARGS[3], s)  # d = 2
r.jammed || exit(1)

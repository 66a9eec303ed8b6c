# Many seeds, one after the other.  (With `using Distributed`, pmap(pack, seeds) takes several processes.)  usage: ensemble.jl [SEEDS]
using Jam, Statistics

function pack(seed)
    s = System(n = 128, dim = 2, seed = seed, diameters = [fill(1.0, 64); fill(1.4, 64)])
    compress!(s; growth_rate = 3e-2, pressure = 1e4)
    r = crunch!(s)
    row = (seed = seed, jammed = r.jammed, phi = r.packing_fraction, contacts = r.contacts, force = forces(s))
    close(s)  # or let the garbage collector do it
    return row
end

seeds = 1:(isempty(ARGS) ? 6 : parse(Int, ARGS[1]))
rows = filter(row -> row.jammed, map(pack, seeds))  # a table: DataFrame(rows), CSV.write("phi.csv", rows)
phi = [row.phi for row in rows]
println(length(phi), " of ", length(seeds), " jammed, phi_J = ", mean(phi), " +- ", std(phi) / sqrt(length(phi)))
f = reduce(vcat, [row.force for row in rows])
println(length(f), " forces, mean ", mean(f), ", smallest ", minimum(f))

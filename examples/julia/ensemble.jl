# Many seeds, one after the other; mean and standard error of phi_J.  (With `using Distributed`, pmap(pack, seeds) takes
# several processes.)
using Jam, Statistics

function pack(seed)
    s = System(n = 128, dim = 2, seed = seed, diameters = [fill(1.0, 64); fill(1.4, 64)])
    compress!(s; growth_rate = 3e-2, pressure = 1e4)
    r = crunch!(s)
    close(s)  # or let the garbage collector do it
    return r.jammed == 1 ? r.packing_fraction : NaN
end

seeds = 1:6
phi = filter(!isnan, map(pack, seeds))
println(length(phi), " of ", length(seeds), " jammed, phi_J = ", mean(phi), " +- ", std(phi) / sqrt(length(phi)))

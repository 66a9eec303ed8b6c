# A picture of a two-dimensional packing and its forces as SVG, which every browser shows.
using Jam

s = System(n = 200, dim = 2, seed = 1, diameters = [fill(1.0, 100); fill(1.4, 100)])
crunch!(s)
x, sigma, z = positions(s), diameters(s), coordination(s)
f, n, pairs = forces(s), contact_vectors(s), contacts(s)

open("picture.svg", "w") do io
    println(io, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\" width=\"800\" height=\"800\">")
    for side in -1:1, up in -1:1  # the box is periodic: copies on all sides, cut at its edge
        println(io, "<g transform=\"translate($side $up)\" stroke=\"black\" stroke-linecap=\"round\">")
        for i in eachindex(sigma)  # orange: bucklers, grey: rattlers
            colour = z[i] == 0 ? "#c8c8c8" : z[i] == 3 ? "#f2a541" : "#4c78a8"
            println(io, "<circle cx=\"$(x[1, i])\" cy=\"$(x[2, i])\" r=\"$(sigma[i] / 2)\" fill=\"$colour\" stroke=\"none\"/>")
        end
        for k in eachindex(f)
            i, j = pairs[1, k], pairs[2, k]
            r = -(sigma[i] + sigma[j]) / 2 .* n[:, k]  # from the first centre to the second
            println(io, "<path d=\"M$(x[1, i]) $(x[2, i]) l$(r[1]) $(r[2])\" stroke-width=\"$(0.004 * f[k])\"/>")
        end
        println(io, "</g>")
    end
    println(io, "</svg>")
end
println(length(sigma), " disks, ", length(f), " forces")

# What the recipe for Plots draws (ext/JamRecipesBaseExt.jl), as coordinates with NaN between the pieces.

"Pairs of a colour and the spheres of that class: stable ones, bucklers, rattlers; without a network all in one."
function by_class(s::System)
    network = network_of(s)
    n, d = Int(info(s).n), Int(info(s).dim)
    network === nothing && return [COLOURS.other => collect(1:n)]
    z = network[1]
    return [COLOURS.other => findall(k -> k != 0 && k != d + 1, z), COLOURS.buckler => findall(==(d + 1), z),
            COLOURS.rattler => findall(==(0), z)]
end

"Outlines of disks as polygons of so many corners: x and y."
function outlines(s::System, spheres = 1:Int(info(s).n); corners = 24)
    info(s).dim == 2 || throw(ArgumentError("outlines are of d = 2"))
    x, sigma, turns = positions(s), diameters(s), (0:corners) .* (2pi / corners)
    path(c, wave) = reduce(vcat, ([x[c, i] .+ sigma[i] / 2 .* wave.(turns); NaN] for i in spheres); init = Float64[])
    return path(1, cos), path(2, sin)
end

"Contacts as lines from the first centre to the second, which may lie beyond the cell, or to a wall: a vector for each axis."
function bonds(s::System)
    x, sigma, pairs, n, h = positions(s), diameters(s), contacts(s), contact_vectors(s), contact_table(s).gap
    non_additivity = info(s).non_additivity
    function length_of(k)
        i, j = pairs[1, k], pairs[2, k]
        j < 0 && return sigma[i] / 2 * (1 + h[k])
        return (sigma[i] + sigma[j]) / 2 * (sigma[i] == sigma[j] ? 1 : 1 + non_additivity) * (1 + h[k])
    end
    ends(c, k) = (a = x[c, pairs[1, k]]; [a, a - length_of(k) * n[c, k], NaN])
    return Tuple(reduce(vcat, (ends(c, k) for k in axes(pairs, 2)); init = Float64[]) for c in axes(x, 1))
end

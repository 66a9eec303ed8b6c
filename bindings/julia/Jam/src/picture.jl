# A packing of disks as SVG: what notebooks show, and what picture() writes.

const COLOURS = (rattler = "#c8c8c8", buckler = "#f2a541", other = "#4c78a8")

"Contacts of each sphere and the network, or nothing before a crunch. Contacts by distance, without forces, get lines of one width."
function network_of(s)
    try
        return (coordination(s), contacts(s), contact_vectors(s), replace(forces(s), NaN => 1.0))
    catch e
        e isa JamError && e.status in (:state, :not_jammed) || rethrow()
        return nothing
    end
end

"Corners of the cell a (columns), and of the picture around it: x, y, width, height with y downwards."
function frame(a)
    corners = [[0.0, 0.0] a[:, 1] a[:, 1] + a[:, 2] a[:, 2]]
    low, high = minimum(corners; dims = 2), maximum(corners; dims = 2)
    return corners, (low[1], -high[2], high[1] - low[1], high[2] - low[2])
end

shown(v) = @sprintf("%.6g", v)
move(r) = "$(shown(r[1])) $(shown(-r[2]))"  # y points downwards in SVG

function disks(io, x, sigma, z)
    for i in eachindex(sigma)
        colour = z === nothing ? COLOURS.other : z[i] == 0 ? COLOURS.rattler : z[i] == 3 ? COLOURS.buckler : COLOURS.other
        println(io, "<circle cx=\"$(shown(x[1, i]))\" cy=\"$(shown(-x[2, i]))\" r=\"$(shown(sigma[i] / 2))\" fill=\"$colour\"/>")
    end
end

function lines(io, x, sigma, pairs, n, f)
    unit = 0.12 * sum(sigma) / length(sigma)  # width of the mean force
    for k in eachindex(f)
        i, j = pairs[1, k], pairs[2, k]
        r = -(j < 0 ? sigma[i] : sigma[i] + sigma[j]) / 2 .* n[:, k]  # from the first centre to the second, or to a wall
        println(io, "<path d=\"M$(move(x[:, i])) l$(move(r))\" stroke=\"#222\" stroke-width=\"$(shown(unit * f[k]))\"/>")
    end
end

"Whether each axis is closed by walls, across which nothing repeats."
closed(now) = now.container === :ball ? (true, true) : Tuple((now.walls >> c) & 1 == 1 for c in 0:1)

"What draw() writes, and its copies on all sides of the cell a that are open."
function periodic(draw, io, name, a, walls)
    println(io, "<g id=\"$name\" stroke-linecap=\"round\">")
    draw()
    println(io, "</g>")
    for p in -1:1, q in -1:1
        (p == q == 0 || (walls[1] && p != 0) || (walls[2] && q != 0)) && continue
        shift = p .* a[:, 1] .+ q .* a[:, 2]
        println(io, "<use href=\"#$name\" x=\"$(shown(shift[1]))\" y=\"$(shown(-shift[2]))\"/>")
    end
end

function svg(io::IO, s::System; forces::Bool = true, width::Integer = 800)
    info(s).dim == 2 || throw(ArgumentError("pictures are of d = 2; page(path, s) shows d = 3"))
    x, sigma, a, network, walls = positions(s), diameters(s), cell(s), network_of(s), closed(info(s))
    corners, (left, top, wide, high) = frame(a)
    outline = "M" * join((move(corners[:, k]) for k in 1:4), " L") * " Z"
    println(io, "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"$width\" height=\"$(round(Int, width * high / wide))\" ",
            "viewBox=\"$(join(shown.((left, top, wide, high)), " "))\">")
    println(io, "<clipPath id=\"cell\"><path d=\"$outline\"/></clipPath><g clip-path=\"url(#cell)\">")
    periodic(() -> disks(io, x, sigma, network === nothing ? nothing : network[1]), io, "disks", a, walls)
    forces && network !== nothing && periodic(() -> lines(io, x, sigma, network[2:4]...), io, "forces", a, walls)
    frame_line = "fill=\"none\" stroke=\"#000\" stroke-width=\"$(shown(wide / 400))\""
    println(io, "</g>", info(s).container !== :ball ? "<path d=\"$outline\" $frame_line/></svg>" :
            "<circle cx=\"$(shown(wide / 2))\" cy=\"$(shown(-high / 2))\" r=\"$(shown(wide / 2))\" $frame_line/></svg>")
end

"""
    picture(path, s; forces = true, width = 800)

Writes disks (d = 2) as SVG: rattlers grey, bucklers orange, forces as lines of their width. Notebooks show `s` like this by
themselves. `page(path, s)` shows three dimensions.
"""
picture(path::AbstractString, s::System; given...) = (write(path, sprint(io -> svg(io, s; given...))); nothing)  # drawn before it opens

Base.showable(::MIME"image/svg+xml", s::System) = s.handle != C_NULL && info(s).dim == 2 && info(s).n <= 20000
Base.show(io::IO, ::MIME"image/svg+xml", s::System) = svg(io, s)

# The periodic cell. Its vectors are the columns of a d-by-d matrix: the rows of C.

function check_square(s::System, x, name)
    d = Int(info(s).dim)
    x isa AbstractVector && length(x) == d && name == "cell" && return Cdouble[i == j ? x[i] : 0 for i in 1:d, j in 1:d]
    size(x) == (d, d) || throw(ArgumentError("$name must be a $d-by-$d matrix, not $(join(size(x), "-by-"))"))
    return dense(x)
end

"""
    set_cell!(s, vectors) -> (transform, rotation)

Replaces the cell by the columns of `vectors`, or by d sides. Positions keep their Cartesian values and diameters stay; results
of a crunch are dropped. The vectors stay, but are rotated to an upper triangle where they are none: a point `x` has gone to
`rotation * x`. `notes(s)` tells where extreme vectors were replaced: they are `rotation * vectors * transform` now.
"""
function set_cell!(s::System, vectors)
    made = call(s, :jam_set_cell, (check_square(s, vectors, "cell"),))
    return (transform = made.transform, rotation = permutedims(made.rotation))
end

"""
    strain!(s, strain)

Deforms cell and positions by r -> (1 + strain) r; diameters stay, results of a crunch are dropped.

```jldoctest
julia> s = System([0.1 0.6; 0.2 0.7], 0.1);

julia> strain!(s, [0 0.1; 0 0]); cell(s)
2×2 Matrix{Float64}:
 1.0  0.1
 0.0  1.0
```
"""
strain!(s::System, strain) = (call(s, :jam_strain, (permutedims(check_square(s, strain, "strain")),)); s)

# Diameters by a law.

"""
    sizes(law; n, curve, packing_fraction, porosity, cell_volume, dim, seed, draw, mean, deviation, ...)

Diameters of a law given by its name, or by text with what it takes, as in `"lognormal:deviation=0.3"` or
`"sieve:grading.csv"`. Keywords give fields instead, and `curve` the rows of a list or a sieve curve, a 2-by-rows matrix.
Without `n` it follows from `cell_volume` and `packing_fraction`, or `porosity`, the void fraction.

```jldoctest
julia> sizes(:list; n = 4, curve = [1.0 1.4; 0.5 0.5])
4-element Vector{Float64}:
 1.0
 1.0
 1.4
 1.4

julia> size_report(sizes(:lognormal; n = 1000, deviation = 0.3)).polydispersity > 0.29
true
```
"""
function sizes(law; curve = nothing, porosity = nothing, given...)
    parsed, needed, text = options(jam_diameters_options, (;)), Ref{Csize_t}(0), string(law)
    check(jam_parse_diameters(text, parsed, nothing, 0, needed))
    rows = Vector{Cdouble}(undef, needed[])
    isempty(rows) || check(jam_parse_diameters(text, parsed, rows, length(rows), needed))
    if curve !== nothing
        isempty(rows) || throw(ArgumentError("the law's text and curve both give rows"))
        size(curve, 1) == 2 || throw(ArgumentError("curve must be a 2-by-rows matrix, not $(join(size(curve), "-by-"))"))
        rows = vec(dense(curve))
    end
    given = with_density((; given...), porosity)
    named = options(jam_diameters_options, given)
    for name in keys(given)
        setfield!(parsed, name, getfield(named, name))
    end
    x = isempty(rows) ? nothing : rows
    check(jam_diameters(parsed, x, length(rows), nothing, 0, needed))
    out = Vector{Cdouble}(undef, needed[])
    check(jam_diameters(parsed, x, length(rows), out, length(out), needed))
    return out
end

"""
    size_report(diameters; dim = 3)

What diameters are: moments, d10, d50, d90 by volume, and the densities in reach; a Report.
"""
size_report(diameters; dim = 3) = call(nothing, :jam_get_size_report, (dim, diameters))

# Soft spheres: energy minima, and down to jamming.

"""
    shear!(s, to, mode = nothing; stress = nothing, step, resolution, until, strain, pressure, components, alpha, ..., progress)

Athermal quasi-static shear of soft spheres, or of hard ones by a crunch at each strain. `to`: the last strain, or those at
which the shear turns. `mode`: strain of amplitude 1, upper-triangular; simple shear without. `stress`: what the components
that `strain` frees are to hold, in place of one pressure. Returns a Report.

```jldoctest
julia> s = System(n = 60, dim = 2, packing_fraction = 0.95, overlap = :allow, diameters = repeat([1.0, 1.4], 30));

julia> shear!(s, 0.003).strain ≈ 0.003, length(shear_history(s)) >= 4
(true, true)

julia> abs(shear!(s, [0.002, 0], [0.5 0; 0 -0.5]).strain) < 1e-12
true
```
"""
function shear!(s::System, to, mode = nothing; stress = nothing, progress = nothing, given...)
    o, made = options(s, jam_shear_options, given), jam_shear_report()
    turns = to isa Number ? [Float64(to)] : collect(Float64, to)
    if mode === nothing && stress !== nothing
        mode = zeros(Int(info(s).dim), Int(info(s).dim))
        mode[1, 2] = 1
    end
    m = Float64[]
    for (x, name) in ((mode, "mode"), (stress, "stress"))
        x === nothing || append!(m, permutedims(check_square(s, x, name)))
    end
    strain = isempty(m) ? nothing : m
    return verb(h -> jam_shear(h, o, turns, length(turns), strain, length(m), made), s, made, progress)
end

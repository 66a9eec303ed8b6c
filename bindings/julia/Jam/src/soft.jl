# Soft spheres: energy minima, and down to jamming.

"""
    relax!(s; alpha, minimiser, scale, strain, pressure, force_tolerance, max_evaluations, wall_time, progress)

Minimises the energy of overlapping spheres; the system must have been made with `overlap = :allow`. Returns a Report. The
network stays with `s`: `hessian(s; stiffness = :soft, prestress = 1)` is that of the energy.

```jldoctest
julia> s = System(n = 60, dim = 2, packing_fraction = 0.95, overlap = :allow, diameters = repeat([1.0, 1.4], 30));

julia> relax!(s).converged
true

julia> r = decompress!(s); r.same_network == 1, report(s).jammed
(true, true)
```
"""
function relax!(s::System; progress = nothing, given...)
    o, made = options(jam_relax_options, given), jam_relax_report()
    return verb(h -> jam_relax(h, o, made), s, made, progress)
end

"""
    decompress!(s; energy_factor, pressure, distance, isostatic, crunch, max_steps, wall_time, alpha, ..., progress)

From overlapping spheres down to jamming, step by step; ends as the jammed packing that a crunch confirms. Returns a Report.
"""
function decompress!(s::System; progress = nothing, given...)
    o, made = options(jam_decompress_options, given), jam_decompress_report()
    return verb(h -> jam_decompress(h, o, made), s, made, progress)
end

"Minima of the last `decompress!` as a table: phi, pressure, energy, coordination, distance, ..."
soft_history(s::System) = call(s, :jam_decompress_history, ())

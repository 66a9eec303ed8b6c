# The linear programs of CALiPPSO.jl (Artiaco et al., Phys. Rev. E 106, 055310 (2022)) one by one.

"""
    calippso!(s; l0, sqrΓ0, thresholds_bounds, sbound, tol_Γ_convergence, tol_S_convergence, max_iters, on_lp, options...)

Solves the linear programs of CALiPPSO.jl stage by stage, with its parameters, in its units and with its defaults: `l0` (or
`ℓ0`) in the unit of the box, `sbound` in radii, `tol_S_convergence` in the unit of the box. Radius of influence and bound on
displacements follow its three stages. Each LP is solved to its optimum. `on_lp`: a function of the row that was just made;
`true` stops. Other keywords are options of `crunch!`, such as `lp_solver`.

Returns a table with a row for each LP: gain (√Γ - 1), phi, step_max (largest displacement of a stable sphere, unit of the box),
contacts, excess, rattlers, pairs (rows of the LP), radius and bound (unit of the box), seconds. R of mixtures is the largest
radius, as in CALiPPSO 0.2.2. A row for each pair whose gap is below radius - 2 R; theirs has one for each pair at a distance
below the radius. The bound keeps the others apart, so that the optimum is the same. Call `crunch!(s)` after it for contacts, forces and
certificate.

```jldoctest
julia> s = System(n = 64, dim = 3, seed = 1); compress!(s; growth_rate = 0.1, pressure = 1000);

julia> lps = calippso!(s; max_iters = 3); length(lps)
3

julia> issorted(lps.phi)
true
```
"""
function calippso!(s::System; l0 = nothing, ℓ0 = l0, sqrGamma0 = 1.01, sqrΓ0 = sqrGamma0, thresholds_bounds = (5e-4, 1e-5), sbound = 0.01,
                   tol_Gamma_convergence = 1e-12, tol_Γ_convergence = tol_Gamma_convergence, tol_S_convergence = 1e-9,
                   max_iters = 1000, on_lp = nothing, given...)
    refuse(given, (:method, :max_lps, :full_lps, :polish, :neighbour_radius, :step_bound), "calippso! sets it")
    ours = (STAGED..., :on_lp, :progress, :on_step, members(jam_crunch_options)...)
    for name in keys(given)
        name in ours || haskey(CALIPPSO, name) || throw(ArgumentError("unknown option $name" * suggestion(string(name), string.(ours))))
    end
    gain, d = sqrΓ0 - 1, Int(info(s).dim)
    widest() = maximum(diameters(s))
    cutoff = ℓ0 === nothing ? 2 * widest() : Float64(ℓ0)  # 4 R
    rows = NamedTuple[]
    for _ in 1:max_iters
        sigma = info(s).diameter_mean
        R = widest() / 2
        radius, bound = stage(gain, cutoff, R, d, thresholds_bounds, sbound)
        bound > 0 || throw(ArgumentError("l0 = $cutoff is too small for spheres of radius R = $R: displacements in the first stage are " *
                                         "bounded by (l0 - $(2 * max(1.5, 1 + gain)) R) / (2 sqrt(d)); the default is 4 R"))
        r = crunch!(s; method = :sequential_lp, max_lps = 1, full_lps = true, polish = false, neighbour_radius = radius / sigma,
                step_bound = bound / sigma, given...)
        last = history(s)[end]
        now = info(s).diameter_mean
        push!(rows, (gain = last.gain, phi = last.phi, step_max = r.max_step * now, contacts = whole(last.contacts), excess = whole(last.excess),
                     rattlers = whole(last.rattlers), pairs = whole(last.pairs), radius = radius, bound = bound, seconds = last.seconds))
        on_lp !== nothing && on_lp(rows[end]) === true && break
        gain = last.gain
        gain <= tol_Γ_convergence && r.max_step * now <= tol_S_convergence && break
    end
    names = (:gain, :phi, :step_max, :contacts, :excess, :rattlers, :pairs, :radius, :bound, :seconds)
    return Table(NamedTuple{names}(Tuple([row[name] for row in rows] for name in names)))
end

"A number of the history; -1 where the step has none."
whole(x) = isnan(x) ? -1 : Int(x)

"Radius of influence and bound of the displacements of one of the three stages, by the gain of the LP before (their bounds_and_cutoff)."
function stage(gain, l0, R, d, thresholds, sbound)
    gain > thresholds[1] && return l0, (l0 - max(1.5, 1 + gain) * 2R) / (2 * sqrt(d))
    gain > thresholds[2] && return min(4R, l0), 0.1R
    return min(2.7R, l0), sbound * R
end

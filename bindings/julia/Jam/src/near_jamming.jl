# Dynamics near jamming: isoconfigurational runs, predictors from the contact network, and how well they predict. Formulas: R.
# Diaz Hernandez Rojas, thesis (Sapienza 2021), chapter 3.

"""
    isoconf(s, instants; runs, density_ratio, kept, monte_carlo, first_run, block, clock, threads, ..., progress)

Runs from the packing as it is, each with velocities of its own; `s` does not change. `instants` ascend. `monte_carlo`: a
NamedTuple of options of `monte_carlo!`, instead of molecular dynamics. `kept`: numbers of the instants whose displacements
`isoconf_kept(s, k)` gives of every run.

Returns `Results`, means over the runs: `displacement` (d, n, instants), `propensity` = mean of |dr|^2 (n, instants), and a value
an instant of `time`, `msd`, `scattering`, `overlap`, ... `report` is the Report.
"""
function isoconf(s::System, instants; kept = nothing, monte_carlo = nothing, progress = nothing, given...)
    o = options(s, jam_isoconf_options, given)
    m = monte_carlo === nothing ? nothing : options(s, jam_monte_carlo_options, (; monte_carlo...))
    made, t = jam_isoconf_report(), vec(dense(instants))
    k = kept === nothing ? nothing : Int32.(collect(kept)) .- Int32(1)
    r = verb(h -> jam_isoconf(h, o, m, t, length(t), k, length(something(k, ())), made), s, made, progress)
    return Results(merge((report = r, instants = t), isoconf_means(s)))
end

"Means over all runs of the handle."
function isoconf_means(s)
    sums, moved = columns(call(s, :jam_isoconf_series, (-1,))), call(s, :jam_isoconf_displacements, (-1,))
    runs = isempty(sums.runs) ? 1.0 : max(maximum(sums.runs), 1.0)  # a block without runs has sums of 0
    names = Tuple(n for n in keys(sums) if n !== :runs && !endswith(string(n), "2"))
    series = NamedTuple{names}(Tuple(sums[n] ./ runs for n in names))
    distance = call(s, :jam_isoconf_distances, (-1,))
    return merge((displacement = moved.displacement ./ runs, propensity = distance.distance2 ./ runs), series)
end

"""
    predictors(s)

Structure of a jammed packing, a value a sphere: `c` (d, n) = sum_j n_ij, `s` = sum_{j<k} n_ij.n_ik, `force_sum`, `force_pairs`,
`rattlers`, whose values are 0.
"""
function predictors(s::System)
    plain, weighted, pairs, f = sphere_structure(s, false), sphere_structure(s, true), contacts(s), forces(s)
    isempty(f) && throw(ArgumentError("the packing has rattlers only: there is no contact network to predict from"))
    total = zeros(Int(info(s).n))
    for k in eachindex(f), side in 1:2
        pairs[side, k] > 0 && (total[pairs[side, k]] += f[k])  # below 0: a wall
    end
    return Results(c = plain.c, s = plain.s, force_sum = total, force_pairs = weighted.s, rattlers = rattlers(s))
end

"Ranks from 1; equal values share their mean rank."
function ranks(x)
    order, r = sortperm(x), zeros(length(x))
    k = 1
    while k <= length(x)
        last = k
        while last < length(x) && x[order[last+1]] == x[order[k]]
            last += 1
        end
        r[order[k:last]] .= (k + last) / 2
        k = last + 1
    end
    return r
end

"""
    spearman(x, y)

Spearman's rank correlation.

```jldoctest
julia> spearman([1, 2, 3, 4], [10, 20, 30, 25])
0.8
```
"""
function spearman(x, y)
    length(x) == length(y) || throw(ArgumentError("x has $(length(x)) values, y $(length(y))"))
    a, b = ranks(vec(collect(x))), ranks(vec(collect(y)))
    a, b = a .- sum(a) / length(a), b .- sum(b) / length(b)
    return sum(a .* b) / sqrt(sum(abs2, a) * sum(abs2, b))
end

"""
    correlations(runs, structure; rattlers = true)

Spearman's K at each instant of what `isoconf` returned: `c` = K[C, <dr>], mean of components; `s`, `force_sum` and
`force_pairs` with the propensity.
"""
function correlations(runs, structure; rattlers::Bool = true)
    use = rattlers ? trues(length(structure.s)) : .!structure.rattlers
    d, m = size(structure.c, 1), size(runs.propensity, 2)
    c = [sum(spearman(structure.c[k, use], runs.displacement[k, use, t]) for k in 1:d) / d for t in 1:m]
    with(x) = [spearman(x[use], runs.propensity[use, t]) for t in 1:m]
    return Results(c = c, s = with(structure.s), force_sum = with(structure.force_sum), force_pairs = with(structure.force_pairs))
end

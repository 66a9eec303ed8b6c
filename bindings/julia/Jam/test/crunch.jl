# The way to the jamming point, its words, what it reports, and the stages of CALiPPSO.
s = System(n = 60, dim = 2, seed = 3, diameters = repeat([1.4, 1.0], 30))
r = crunch!(s; method = :sequential_lp, lp_solver = "ipm")
@test r.jammed === true && r.status === :ok && s.status === :ok && r.method === :sequential_lp && r.stop_reason === :converged
@test report(s).packing_fraction == r.packing_fraction == packing_fraction(s)
@test occursin("sequential_lp", failure(() -> crunch!(s; method = :sequential)))
@test occursin("did you mean gain_tolerance", failure(() -> crunch!(s; gain_tolerence = 1e-9)))
@test occursin("did you mean growth_rate", failure(() -> compress!(System(n = 8, dim = 2); rate = 1e-2)))
@test occursin("did you mean dim", failure(() -> System(n = 8, d = 2)))
@test occursin("neighbour_radius", failure(() -> crunch!(s; l0 = 0.4))) && occursin("calippso!(s; l0 = 0.4)", failure(() -> crunch!(s; l0 = 0.4)))
@test all(name -> occursin("CALiPPSO", failure(() -> crunch!(s; (name => 1,)...))), keys(Jam.CALIPPSO))
@test occursin("true or false", failure(() -> crunch!(s; polish = 7.5)))
rows = history(s)
@test rows isa AbstractVector && rows[end].phase === :polish && rows.phi[end] ≈ r.packing_fraction
@test count(==(:lp), rows.phase) == r.lp_solves
@test occursin("packing_fraction", sprint(show, MIME"text/plain"(), r)) && occursin("phi", sprint(show, MIME"text/plain"(), rows))
@test NamedTuple(r).contacts == r.contacts && :contacts in propertynames(r)
@test occursin("did you mean contacts", failure(() -> r.contact))

# Displacements of the steps lead from the start to the end.
t = System(n = 40, dim = 2, seed = 5, diameters = repeat([1.4, 1.0], 20))
x, lps = positions(t), Ref(0)
crunch!(t; method = :sequential_lp, on_step = step -> (x .+= step.displacements; lps[] += length(step.duals) > 0; false))
@test lps[] > 1
@test maximum(abs, mod.(x .- positions(t) .+ 0.5, 1) .- 0.5) < 1e-12
@test crunch!(System(n = 40, dim = 2); on_step = step -> true).status === :cancelled

# Their stages: the density never falls, and the same packing is jammed for crunch!, which then moves nothing.
u = System(n = 64, dim = 3, seed = 1, packing_fraction = 0.3)
lps = calippso!(u; l0 = 0.5)
@test all(diff(lps.phi) .> -1e-15) && length(lps) < 100 && lps.gain[end] <= 1e-12 && lps.step_max[end] <= 1e-9
@test lps.radius[1] == 0.5
@test lps.bound[end] ≈ 0.005 * info(u).diameter_mean rtol = 1e-3
@test all(lps.step_max[2:end] .<= sqrt(3) .* 2 .* lps.bound[2:end])  # without the mean of all spheres
certificate = crunch!(u)
@test certificate.jammed && certificate.displacement_max_stable < 1e-6
@test occursin("calippso! sets it", failure(() -> calippso!(u; step_bound = 0.1)))
@test occursin("l0 = 0.1 is too small", failure(() -> calippso!(u; l0 = 0.1, max_iters = 1)))
@test occursin("tol_Γ_convergence", failure(() -> calippso!(u; tol_Γ = 1e-9)))

# R of a mixture is the largest radius. Pairs beyond the rows stay apart: more of them leave the optimum as it is.
m = System(n = 64, dim = 2, seed = 2, packing_fraction = 0.5, diameters = repeat([1.0, 1.4], 32))
widest, unit, more = maximum(diameters(m)), info(m).diameter_mean, copy(m)
lps = calippso!(m; max_iters = 1)
@test lps.radius[1] ≈ 2 * widest && lps.bound[1] ≈ (lps.radius[1] - 1.5 * widest) / (2 * sqrt(2))
@test eltype(lps.contacts) == eltype(lps.pairs) == Int
crunch!(more; method = :sequential_lp, max_lps = 1, full_lps = true, polish = false, neighbour_radius = 1.5 * lps.radius[1] / unit,
        step_bound = lps.bound[1] / unit)
@test history(more)[end].pairs > lps.pairs[1]
@test history(more)[end].gain ≈ lps.gain[1] rtol = 1e-8
lps = calippso!(m)
@test lps.bound[end] ≈ 0.01 * maximum(diameters(m)) / 2 rtol = 1e-3
@test crunch!(m).jammed

# The packing as it is.
@test judge(s).status === :ok && startswith(judge(s).text, "Collectively jammed")
@test sprint(show, MIME"text/plain"(), judge(s)) == judge(s).text
scale_diameters!(s, 0.9)
@test judge(s).status === :not_jammed && judge(s).jammed === :no

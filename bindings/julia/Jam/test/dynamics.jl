# Molecular dynamics, records of it, progress and stops.
s = System(n = 64, dim = 2, seed = 1, diameters = repeat([1.0, 1.4], 32))
@test compress!(s; porosity = 0.4).packing_fraction ≈ 0.6
@test occursin("packing_fraction or porosity", failure(() -> compress!(s; porosity = 0.4, packing_fraction = 0.6)))
@test compress!(s; stages = [(3e-2, 50), (1e-2, 100)]).growth_rate ≈ 1e-2
@test occursin("stages give it", failure(() -> compress!(s; stages = [(3e-2, 50)], pressure = 3)))
seen = observing(s; sample_every = 5, gap_bins = 10, r_bins = 20, collisions = true) do
    run!(s; collisions_per_particle = 50)
end
@test length(seen.series) >= 9 && issorted(seen.series.time)
@test sum(seen.pairs.collisions) * 2 == sum(seen.spheres.collisions)
@test minimum(seen.pairs.pair) >= 1 && maximum(seen.pairs.pair) == 64
@test seen.gaps.low[2:end] == seen.gaps.high[1:end-1]
@test size(seen.spheres.displacement) == (2, 64) && length(seen.correlation.g) == 20
@test run!(s; wall_time = 1e-9, collisions_per_particle = 1e6).status === :limit
@test monte_carlo!(s; sweeps = 20).sweeps == 20

t = System(n = 300, dim = 3, packing_fraction = 0.3)
phases = Symbol[]
@test crunch!(t; progress = p -> (push!(phases, p.phase); true)).status === :cancelled
@test t.status === :cancelled && !isempty(t.why) && phases[1] === :crunch
t.status, t.why = :ok, ""
@test_throws ErrorException crunch!(t; progress = p -> error("from the callback"))
@test t.status === :cancelled && !isempty(t.why)  # of the call that threw
@test_throws JamError forces(t)
@test t.status === :state && occursin("contacts", t.why)
@test_throws ArgumentError modes(t, 3; colour = 1)
@test t.status === :argument && occursin("colour", t.why)
for wrong in (() -> crunch!(t; colour = 2), () -> run!(t; time = "long"), () -> compress!(t; stages = [], pressure = 1), () -> judge(t; prove = 0.5))
    t.status, t.why = :ok, ""
    @test_throws ArgumentError wrong()
    @test t.status === :argument && !isempty(t.why)
end
@test occursin("progress must be", failure(() -> crunch!(t; progress = 3)))
cancel(t)
@test crunch!(t).status === :cancelled
@test_throws JamError crunch!(t; lp_tolerance = -1.0)  # a C++ exception inside
logger = Test.TestLogger(min_level = Logging.LogLevel(-1))
with_logger(() -> crunch!(t; progress = :log), logger)
@test logger.logs[end].kwargs[:progress] == "done" && length(unique(l.id for l in logger.logs)) == 1
@test all(l -> l.level == Logging.LogLevel(-1), logger.logs)
line = mktemp() do path, io
    redirect_stderr(() -> crunch!(System(n = 100, dim = 3); progress = true), io)
    flush(io)
    read(path, String)
end
@test occursin("phi 0.", line) && endswith(line, "\n")

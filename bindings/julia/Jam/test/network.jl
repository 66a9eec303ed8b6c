# Matrices act as they should, tables have their columns.
s = disks()
f, n, c = forces(s), contact_vectors(s), contacts(s)
@test rattlers(s) == (coordination(s) .== 0) && count(rattlers(s)) == report(s).rattlers
@test count(bucklers(s)) == report(s).bucklers
@test all(m -> m == 0 || m >= 3, coordination(s))

# The Hessian of unit springs along the contacts, made here from pairs and vectors.
place = Dict(sphere => k for (k, sphere) in enumerate(hessian_map(s)))
m = 2 * length(place)
h = zeros(m, m)
for k in eachindex(f)
    local u = zeros(m)
    i, j = place[c[1, k]], place[c[2, k]]
    u[2i-1:2i] .+= n[:, k]
    u[2j-1:2j] .-= n[:, k]
    h .+= u * u'
end
@test hessian(s) isa SparseMatrixCSC && maximum(abs, hessian(s) - h) < 1e-12
values_, vectors = modes(s, 4)
@test values_ ≈ sort(eigvals(Symmetric(h)))[3:6] rtol = 1e-6  # two translations are left out
@test norm(vectors[:, 1]) ≈ 1 && vectors[:, 1]' * h * vectors[:, 1] ≈ values_[1]
@test modes(s; which = :all).frequencies[end] ≈ sqrt(eigmax(Symmetric(h)))
@test length(modes(s).values) == 10
@test vectors[:, 2]' * h * vectors[:, 2] ≈ values_[2] rtol = 1e-6

# Copies: their spectrum and their flexes from one cell.
t = tile(s, (2, 1))
@test length(forces(t)) == 2 * length(f) && size(positions(t), 2) == 120
both = vcat(bloch_modes(s, (0, 0)).values, bloch_modes(s, (0.5, 0)).values)
@test sort(both) ≈ eigvals(Symmetric(Matrix(hessian(t)))) atol = 1e-10
b = bloch_modes(s, (0.3, 0.1)).vectors
@test b' * b ≈ I atol = 1e-10
found = bloch_rigidity(s, (2, 1))
@test found.wave == [0 0.5; 0 0] && sum(found.flexes) == rigidity(t).flexes

# Pairs of gaps count from 1.
g = gaps(s, 0.5, false)
x, sigma = positions(s), diameters(s)
for k in (1, length(g.gap))
    i, j = g.pair[:, k]
    local r = mod.(x[:, i] .- x[:, j] .+ 0.5, 1) .- 0.5
    @test norm(r) / ((sigma[i] + sigma[j]) / 2) - 1 ≈ g.gap[k] atol = 1e-12
end
@test all(gaps(s).gap .<= 1)
# What the REPL shows of several results is their sizes.
gap, pair = g
text = sprint(show, MIME"text/plain"(), g)
@test gap == g.gap && pair == g[2] && keys(g) == (:gap, :pair) && length(text) < 200 && occursin("$(length(gap))-element", text)
@test length(sprint(show, MIME"text/plain"(), compare(s, copy(s)))) < 300
@test occursin("dim = 2", string(info(s)))

t = contact_table(s)
@test t isa AbstractVector && t[1] isa NamedTuple && t.force == f && columns(t).i == c[1, :]
@test eltype(t) == typeof(t[1]) && length(collect(t)) == length(f)
@test occursin("did you mean force", failure(() -> t.forces))
@test sphere_table(s).contacts == coordination(s) && propertynames(sphere_table(System(n = 5, dim = 4)))[1:2] == (:x1, :x2)

@test rigidity(s).jammed === :yes && rigidity(s, :strict).kind === :strict
@test size(stress_states(s).basis, 1) == length(f) && stress_states(s).force ≈ f
@test compare(s, copy(s)).comparison.common_contacts == length(f)
@test maximum(compare(s, copy(s)).out) == 0
@test moduli(s).bulk > 0 && size(elastic_tensor(s).affine) == (2, 2, 2, 2)
@test prove(s).theorem === :exact
# Opening a contact by a small amount moves spheres so that it alone opens: numbers of contacts count from 1.
floppy = reshape(floppy_mode(s, 7), 2, :)
@test occursin("must have the size (2, ", failure(() -> mk_shifts(s, ones(Int, 3, 2))))
opening = [dot(n[:, k], floppy[:, place[c[1, k]]] - floppy[:, place[c[2, k]]]) for k in eachindex(f)]
@test argmax(abs.(opening)) == 7
@test length(floppy_modes(s)) == length(f)
@test length(density_of_states(s; moments = 40, points = 50)) == 50
@test contacts_from_geometry!(copy(s)).contacts == length(f)
@test local_values(s, :coordination, :all) == filter(>(0), coordination(s))
@test all(local_values(s, :force, :all) .≈ forces(s))
@test sum(pair_correlation(s, 3, 60).g) > 0
loose = System(n = 8, dim = 2)
@test occursin("call crunch! or contacts_from_geometry! first", failure(() -> forces(loose)))
moved = flex(loose)
@test size(moved.out) == (2, 8)

# Run with: JAM_LIBRARY=/path/libjam.so julia --project=bindings/julia/Jam -e 'using Pkg; Pkg.test()'
using Jam, Test, LinearAlgebra

@testset "layout" begin
    @test sizeof(Jam.jam_crunch_report) == Jam.jam_crunch_report().struct_size
    @test unsafe_string(Jam.jam_version()) != ""
    @test Jam.jam_abi_version() == Jam.JAM_ABI
end

@testset "state" begin
    s = System(n = 60, dim = 2, seed = 3, diameters = repeat([1.4, 1.0], 30))
    x = positions(s)
    @test size(x) == (2, 60)
    set_positions!(s, mod.(x .+ 0.25, 1.0))
    @test positions(s) ≈ mod.(x .+ 0.25, 1.0)
    t = copy(s)
    file = tempname()
    checkpoint(s, file)
    @test positions(from_checkpoint(file)) == positions(s)
    close(s)
    @test_throws ArgumentError positions(s)
    @test positions(t) ≈ mod.(x .+ 0.25, 1.0)
    err = try System(dim = 9) catch e e end
    @test err isa JamError && err.status == Jam.JAM_E_DIMENSION && occursin("9", err.text)
    @test_throws ArgumentError System(dimension = 3)
end

@testset "arguments that look valid" begin
    text(f) = try f(); "" catch e; sprint(showerror, e) end
    x = [0.1 0.6 0.35; 0.2 0.7 0.9; 0.3 0.8 0.15]
    @test occursin("transposed", text(() -> System(rand(10, 3), 0.01)))
    @test occursin("transposed", text(() -> System(rand(5, 3), fill(0.01, 5))))
    @test occursin("last row", text(() -> System([x; 0.1 0.1 0.1], 0.2)))
    @test info(System([x; 0.1 0.1 0.1], 0.2; dim = 4)).dim == 4
    @test occursin("pass box", text(() -> System(4x, 0.2)))
    @test info(System(4x, 0.2; box = 4)).box == 4
    @test occursin("seed must be a whole number", text(() -> System(x, 0.2; seed = big(2)^64)))
    @test occursin("box must be a number", text(() -> System(x, 0.2; box = [1, 1, 2])))
    @test occursin("without effect", text(() -> System(x, 0.2; packing_fraction = 0.1)))
    s = System(x, 0.2)
    @test occursin("velocities", text(() -> set_velocities!(s, rand(3, 4))))
    t = System(n = 4, dim = 2)
    @test occursin("positions", text(() -> set_positions!(t, rand(4, 2))))
    file = tempname() * ".dat"
    write(file, System(x, 0.2; box = 2))
    @test occursin("without effect", text(() -> System(file; packing_fraction = 0.3)))
end

@testset "crunch and forces" begin
    s = System(n = 60, dim = 2, seed = 3, diameters = repeat([1.4, 1.0], 30))
    r = crunch!(s)
    @test r.jammed == 1 && s.status == Jam.JAM_OK
    f, n, c = forces(s), contact_vectors(s), contacts(s)
    net = zeros(2, 60)
    for k in eachindex(f)
        net[:, c[1, k]] .+= f[k] .* n[:, k]
        net[:, c[2, k]] .-= f[k] .* n[:, k]
    end
    @test maximum(abs, net) < 1e-8
    start, column, value = hessian_rows(s)
    @test length(value) == start[end] - 1
    values, vectors = modes(s, 4)
    @test length(values) == 4 && norm(vectors[:, 1]) ≈ 1
end

@testset "callbacks" begin
    s = System(n = 300, dim = 3, packing_fraction = 0.3)
    crunch!(s; progress = p -> true)
    @test s.status == Jam.JAM_CANCELLED
    @test_throws ErrorException crunch!(s; progress = p -> error("from the callback"))
    cancel(s)
    crunch!(s)
    @test s.status == Jam.JAM_CANCELLED
    @test_throws Jam.JamError crunch!(s; lp_tolerance = -1.0)  # a C++ exception inside
end

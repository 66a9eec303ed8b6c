# Ways to make a system, and mistakes that look like valid input.
x = [0.1 0.6 0.35; 0.2 0.7 0.9; 0.3 0.8 0.15]
@test occursin("transposed", failure(() -> System(rand(10, 3), 0.01)))
@test occursin("transposed", failure(() -> System(rand(5, 3), fill(0.01, 5))))
@test occursin("dimension 10", failure(() -> System(rand(10, 20), 0.01)))
@test occursin("last row", failure(() -> System([x; 0.1 0.1 0.1], 0.2)))
@test info(System([x; 0.1 0.1 0.1], 0.2; dim = 4)).dim == 4
@test occursin("pass box", failure(() -> System(4x, 0.2)))
@test info(System(4x, 0.2; box = 4)).box == 4
@test occursin("seed must be a whole number", failure(() -> System(x, 0.2; seed = big(2)^64)))
@test occursin("box must be one side or 3 sides", failure(() -> System(x, 0.2; box = [1, 1])))
@test occursin("without effect", failure(() -> System(x, 0.2; packing_fraction = 0.1)))
@test occursin("either diameters or radii", failure(() -> System(x)))
@test occursin("either diameters or radii", failure(() -> System(x, 0.1; radii = 0.1)))
@test occursin("not 2", failure(() -> System(x, [0.1, 0.2])))
@test occursin("spheres 1 and 2 overlap", failure(() -> System([0.5 0.55; 0.5 0.5], 0.1)))
@test occursin("overlap = :shrink", failure(() -> System([0.5 0.55; 0.5 0.5], 0.1)))
@test occursin("dimension = 3", failure(() -> System(dim = 9))) || occursin("9", failure(() -> System(dim = 9)))

@test diameters(System(x; radii = [0.1, 0.05, 0.1])) == [0.2, 0.1, 0.2]
@test radii(System(x, 0.2)) == fill(0.1, 3)
@test positions(System([x[:, k] for k in 1:3], 0.2)) == x
@test positions(System(big.(x), 0.2f0)) == x
@test cell(System(x, 0.2; box = [1, 2, 3])) == Diagonal([1.0, 2, 3])
a = [1.0 0.3; 0.0 1.0]  # vectors in columns: the second is tilted
tilted = System([0.1 0.6; 0.2 0.7], 0.2; cell = a)
@test cell(tilted) == a
@test info(System(n = 30, dim = 2, porosity = 0.9)).packing_fraction ≈ 0.1
steps = Ref(0)
@test System(n = 200, dim = 3, progress = p -> (steps[] += 1; false)) isa System
@test_throws ErrorException System(n = 20000, dim = 3, packing_fraction = 0.3, progress = p -> error("from the callback"))
s = System(n = 60, dim = 2, packing_fraction = 0.9, overlap = :allow)
@test info(s).packing_fraction ≈ 0.9

# Containers: spheres keep inside, and only open axes repeat.
ball = System(n = 20, dim = 2, packing_fraction = 0.2, container = :ball)
@test info(ball).container === :ball
@test all(sqrt.(sum(abs2, positions(ball) .- 0.5; dims = 1))[1, :] .<= 0.5 .- radii(ball) .+ 1e-12)
slab = System(n = 20, dim = 3, packing_fraction = 0.1, walls = "z")
@test info(slab).walls == 4 && info(System(n = 20, dim = 3, packing_fraction = 0.1, walls = (false, false, true))).walls == 4
@test all(radii(slab) .- 1e-12 .<= positions(slab)[3, :] .<= 1 .- radii(slab) .+ 1e-12)
@test occursin("once each", failure(() -> System(n = 8, dim = 2, walls = "z")))
@test count("<use", sprint(show, MIME"image/svg+xml"(), ball)) == 0 && count("<use", sprint(show, MIME"image/svg+xml"(), System(n = 8, dim = 2, walls = "x"))) == 2

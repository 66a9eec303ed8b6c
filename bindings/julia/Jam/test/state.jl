# Copies, checkpoints, setters, the cell.
s = System(n = 60, dim = 2, seed = 3, diameters = repeat([1.4, 1.0], 30))
x = positions(s)
@test size(x) == (2, 60)
set_positions!(s, mod.(x .+ 0.25, 1.0))
@test positions(s) ≈ mod.(x .+ 0.25, 1.0)
@test occursin("2-by-60", failure(() -> set_positions!(s, rand(60, 2)))) && occursin("transposed", failure(() -> set_positions!(s, rand(60, 2))))
@test occursin("velocities", failure(() -> set_velocities!(s, rand(3, 4))))
t = copy(s)
file = tempname()
checkpoint(s, file)
for read_it in (() -> System(file), () -> Jam.read(file), () -> read(file, System))
    @test occursin("is a checkpoint of libjam: from_checkpoint reads it", failure(read_it))
end
@test positions(from_checkpoint(file)) == positions(s)
close(s)
@test_throws ArgumentError positions(s)
@test sprint(show, s) == "System(closed)"
@test positions(t) ≈ mod.(x .+ 0.25, 1.0)

# a sheared cell has its second vector tilted
scale_diameters!(t, 0.8)
strain!(t, [0 0.05; 0 0])
@test cell(t) ≈ [1 0.05; 0 1]
turned = set_cell!(t, [1 1; 0 1])  # another basis of a lattice
@test turned.rotation * [1 1; 0 1] * turned.transform ≈ cell(t)
@test det(turned.rotation) ≈ 1

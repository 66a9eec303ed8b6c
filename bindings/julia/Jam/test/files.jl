# Files come back with the bits that were written; Julia's own read stays what it is.
s = disks()
folder = mktempdir()
file = joinpath(folder, "packing.xyz")
write(file, s)
@test positions(System(file)) == positions(Jam.read(file)) == positions(Base.read(file, System)) == positions(s)
@test Base.read(file, String)[1:2] == "60" && read(file, String)[1:2] == "60"
@test occursin("without effect", failure(() -> System(file; packing_fraction = 0.3)))
write(joinpath(folder, "plain.gz"), s; format = :plain)
@test diameters(System(joinpath(folder, "plain.gz"))) == diameters(s)
@test occursin(":lammps", failure(() -> write(file, s; format = :lamps)))
@test occursin("no/such", failure(() -> System("no/such/file.xyz"))) && occursin("JamError (:io)", failure(() -> System("no/such/file.xyz")))
plain = joinpath(folder, "walled.txt")
write(plain, "2\n2\n0.1\n0.3 0.3\n0.7 0.7\n")
@test info(System(plain; walls = "y")).walls == info(System(plain; walls = (false, true))).walls == 2
@test info(System(plain; container = :ball)).container === :ball && info(System(plain)).walls == 0
@test occursin("2 truth values", failure(() -> System(plain; walls = (false, true, false))))
write_contacts(joinpath(folder, "contacts.csv"), s)
@test countlines(joinpath(folder, "contacts.csv")) == report(s).contacts + 1
page(joinpath(folder, "page.html"), s; title = "Sixty disks", values = (z = coordination(s), size = diameters(s)))
@test occursin("Sixty disks", read(joinpath(folder, "page.html"), String))
@test occursin("3, and there are 60", failure(() -> page(joinpath(folder, "page.html"), s; values = (z = [1, 2, 3],))))
moving = modes(s, 2)
page(joinpath(folder, "moving.html"), s; modes = moving, values = (drift = ones(2, 60),))
shown_page = read(joinpath(folder, "moving.html"), String)
@test occursin("mode 1, omega ", shown_page) && occursin("mode 2, omega ", shown_page) && occursin("\"drift\"", shown_page)
@test occursin("and there are 60", failure(() -> page(joinpath(folder, "page.html"), s; values = (u = ones(60, 2),))))
# what a plot draws: a polygon a disk, a line a contact whose ends are its two centres
x, y = Jam.outlines(s)
@test count(isnan, x) == count(isnan, y) == 60 && maximum(filter(!isnan, x)) <= 1 + maximum(diameters(s)) / 2
@test sum(length(last(c)) for c in Jam.by_class(s)) == 60
lines = hcat(Jam.bonds(s)...)
@test size(lines, 1) == 3 * report(s).contacts
let a = cell(s), far = lines[2:3:end, :] - positions(s)'[contacts(s)[2, :], :]
    shift = far / a'
    @test maximum(abs.(shift - round.(shift))) < 1e-10
end
# A picture that is refused leaves the file of its name alone.
kept = joinpath(folder, "keep.svg")
picture(kept, s)
before = read(kept, String)
@test startswith(before, "<svg") && occursin("d = 2", failure(() -> picture(kept, System(n = 8, dim = 3)))) && read(kept, String) == before
# Each session loads the library that JAM_LIBRARY names in it, however the package was precompiled.
other = joinpath(folder, "libjam-other.so")
cp(realpath(Libdl.dlpath(Jam.library[])), other)
loads(path) = withenv(() -> read(`$(Base.julia_cmd()) -O0 -e "using Jam, Libdl; print(dlpath(Jam.library[]))"`, String), "JAM_LIBRARY" => path)
@test realpath(loads(other)) == realpath(other) && realpath(loads(Libdl.dlpath(Jam.library[]))) != realpath(other)
# RecipesBase is no part of the standard library: the recipe is parsed alone
recipe = Base.parse_input_line(read(joinpath(dirname(pathof(Jam)), "..", "ext", "JamRecipesBaseExt.jl"), String))
@test recipe.args[end].head == :module
picture(joinpath(folder, "disks.svg"), s)
drawn = read(joinpath(folder, "disks.svg"), String)
@test count("<circle", drawn) == 60 && count("stroke=\"#222\"", drawn) == report(s).contacts
@test showable("image/svg+xml", s) && !showable("image/svg+xml", System(n = 8, dim = 3))
@test occursin("d = 2", failure(() -> picture(joinpath(folder, "x.svg"), System(n = 8, dim = 3))))
write_proof(s, joinpath(folder, "proof.txt"))
@test filesize(joinpath(folder, "proof.txt")) > 0

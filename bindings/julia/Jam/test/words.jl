# Everything that is exported has a docstring that opens with its name, and names in it are not mangled.
for name in names(Jam)
    name === :Jam && continue
    text = string(Base.Docs.doc(Base.Docs.Binding(Jam, name)))
    @test !occursin("No documentation found", text)
end
for name in names(Jam; all = true)
    startswith(string(name), "jam_") && getfield(Jam, name) isa Function || continue
    shown = sprint(show, MIME"text/plain"(), Base.Docs.doc(Base.Docs.Binding(Jam, name)))
    @test occursin(string(name) * "(", shown)
end
shown = sprint(show, MIME"text/plain"(), @doc Jam.jam_gaps)
@test occursin("h_max", shown) && occursin("*rows = gaps", replace(shown, r"\s+" => " ")) && occursin("Without stable_only", replace(shown, r"\s+" => " "))
shown = sprint(show, MIME"text/plain"(), @doc Jam.jam_crunch_options)
@test occursin("neighbour_radius:", shown) && occursin(":barrier_path, :sequential_lp", shown)

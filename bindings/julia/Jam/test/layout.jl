# What the generated layer rests on.
for name in names(Jam; all = true)  # of each struct Julia's layout has the size of C's, which layout.c asserts
    startswith(string(name), "jam_") && getfield(Jam, name) isa DataType || continue
    made = getfield(Jam, name)()
    @test sizeof(made) == made.struct_size
end
@test unsafe_string(Jam.jam_version()) != ""
@test Jam.jam_abi_version() == Jam.JAM_ABI
@test Jam.WORDS.crunch_method.sequential_lp == Jam.JAM_CRUNCH_SEQUENTIAL_LP
@test all(c -> all(a -> a.role in (:scalar, :string, :array_in, :handle, :struct_in, :struct_out, :array_out, :columns, :len, :scalar_out, :start),
                   c.arguments), values(Jam.CALLS))

# What the generated layer rests on.
@test sizeof(Jam.jam_crunch_report) == Jam.jam_crunch_report().struct_size
@test unsafe_string(Jam.jam_version()) != ""
@test Jam.jam_abi_version() == Jam.JAM_ABI
@test Jam.WORDS.crunch_method.sequential_lp == Jam.JAM_CRUNCH_SEQUENTIAL_LP
@test all(c -> all(a -> a.role in (:scalar, :string, :array_in, :handle, :struct_in, :struct_out, :array_out, :columns, :len, :scalar_out, :start),
                   c.arguments), values(Jam.CALLS))

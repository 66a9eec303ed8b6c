# The examples in the docstrings run and show what stands there (Documenter's jldoctest blocks, without Documenter).

"The examples of a text: (code, expected) of each prompt; continuation lines are indented by seven blanks."
function prompts(block)
    made, code, expected = Tuple{String, String}[], "", ""
    for line in split(block, "\n")
        if startswith(line, "julia> ")
            isempty(code) || push!(made, (code, expected))
            code, expected = line[8:end], ""
        elseif startswith(line, "       ") && isempty(expected)
            code *= "\n" * line
        else
            expected *= line * "\n"
        end
    end
    isempty(code) || push!(made, (code, expected))
    return made
end

"What the REPL shows of a value."
function seen(code, sandbox)
    value = include_string(sandbox, code)
    (value === nothing || endswith(rstrip(code), ";")) && return ""
    return sprint(io -> show(IOContext(io, :limit => true), MIME"text/plain"(), value))
end
# 1.5 prints Array{Float64,2} where later versions print Matrix{Float64}
plain(text) = replace(strip(text), r"(Array\{(\w+),\s?([12])\}|(Matrix|Vector)\{(\w+)\})" => "array")

function examples()
    count = 0
    for (binding, docs) in Base.Docs.meta(Jam), signature in docs.order
        text = join(docs.docs[signature].text)
        for block in eachmatch(r"```jldoctest\n(.*?)```"s, text)
            sandbox = Module(:Sandbox)
            Core.eval(sandbox, :(using Jam, LinearAlgebra))
            for (code, expected) in prompts(block.captures[1])
                count += 1
                @test plain(seen(code, sandbox)) == plain(expected)
            end
        end
    end
    return count
end
cd(examples, mktempdir()) >= 20 || error("the docstrings have lost their examples")

# Failures, and what a status says.

"""
    JamError(status, text)

A call failed; the system is as it was before. `status` is a word, such as `:overlap`; `text` names value and reason.
"""
struct JamError <: Exception
    status::Symbol
    text::String
end
Base.showerror(io::IO, e::JamError) = print(io, "JamError (:", e.status, "): ", e.text)

"The word of a value of an enum; a value that a newer library has added stays a number."
function word(enum::Symbol, value::Integer)
    for (name, known) in pairs(WORDS[enum])
        known == value && return name
    end
    return Int(value)
end

"The library's text as Julia says it: its functions and words, and spheres, contacts and components that count from 1."
function in_julia(text::AbstractString)
    one_more(m) = replace(m, r"\d+" => k -> string(parse(Int, k) + 1))
    text = replace(text, r"\b(?:spheres?|contact|component) \d+(?: and \d+)?\b" => one_more)
    text = replace(text, r"\bpositions\[\d+\]" => one_more)
    text = replace(text, r"\bjam_(?:create|read)\b" => "System")
    text = replace(text, r"\bjam_\w+_options\.(\w+)" => s"the option \1")
    text = replace(text, r"\bjam_get_crunch_report\b" => "report")
    text = replace(text, r"\bjam_read_checkpoint\b" => "from_checkpoint")
    text = replace(text, r"\bjam_write_checkpoint\b" => "checkpoint")
    text = replace(text, Regex("\\bjam_($CHANGING)\\b") => s"\1!")
    text = replace(text, r"\bJAM_OVERLAP_\w+" => m -> "overlap = :" * lowercase(m[13:end]))
    return replace(replace(text, r"\bjam_(\w+)\b" => s"\1"), "(sys, " => "(")
end

last_text() = in_julia(unsafe_string(jam_last_error()))

"Throws for a status below zero, else returns it. Above 0: stopped early, or a negative or imprecise answer."
function check(status::Integer)
    status >= 0 && return Int32(status)
    text = last_text()
    isempty(text) && (text = unsafe_string(jam_status_string(status)))
    if status == JAM_E_OVERLAP && !occursin("shrink", text)
        text *= "; overlap = :shrink in System scales all diameters until no pair overlaps"
    end
    throw(JamError(word(:status_code, status), text))
end

"The same for a call that returns what it found: one that was cancelled or ran out of time has written nothing, and throws."
function written(status::Integer)
    status in (JAM_CANCELLED, JAM_LIMIT) && throw(JamError(word(:status_code, status), last_text()))
    return check(status)
end

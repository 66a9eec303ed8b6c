"""The Fortran module `jam`: parameters, interoperable types, interfaces to every C function, four small helpers."""
from annotations import last_extent
from fortran_text import HEAD, TAIL
from model import TYPES

# Calls whose second form, from Fortran's own arrays, stands in TAIL.
BY_HAND = {"jam_create": "create_from_arrays"}


def fortran_type(arg):
    t, name = arg.type, arg.name
    scalar = TYPES[t.scalar][2] if t.scalar in TYPES else f"type({t.base})"
    return {
        "handle": f"type(c_ptr), value :: {name}",
        "new_handle": f"type(c_ptr), intent(out) :: {name}",
        "callback": f"type(c_funptr), value :: {name}",
        "user": f"type(c_ptr), value :: {name}",
        "struct_in": f"type({t.base}), intent(in), optional :: {name}",
        "start": f"type({t.base}), intent(in) :: {name}",
        "struct_out": f"type({t.base}), intent(inout), optional :: {name}",
        "string": f"character(kind=c_char), intent(in) :: {name}(*)",
        "view": f"type(c_ptr), intent(out) :: {name}",
        "view_len": f"integer(c_size_t), intent(out) :: {name}",
        "array_in": f"{scalar}, intent(in), optional :: {name}(*)",
        "array_out": f"{scalar}, intent(inout), optional :: {name}(*)",
        "scalar_out": f"{scalar}, intent(out), optional :: {name}",
        "len": f"{scalar}, value :: {name}",
        "scalar": f"{scalar}, value :: {name}",
        "columns": f"{scalar}, value :: {name}",
    }[arg.role]


def _comment(text, indent):
    return [f"{indent}! {line}".rstrip() for line in text.splitlines()]


def _callback_arg(a):
    if a.type.base in ("void", "char"):
        return f"type(c_ptr), value :: {a.name}"
    if a.type.stars:
        base = TYPES[a.type.base][2] if a.type.base in TYPES else f"type({a.type.base})"
        array = "(*)" if a.type.base in TYPES else ""
        return f"{base}, intent(in) :: {a.name}{array}"
    return f"{TYPES[a.type.scalar][2]}, value :: {a.name}"


def _wrap(args, indent):
    """Arguments in lines short enough for the standard."""
    lines, line = [], ""
    for piece in [a + ", " for a in args[:-1]] + args[-1:]:
        if len(line) + len(piece) > 80:
            lines.append(line)
            line = ""
        line += piece
    return ("&\n" + indent + "  ").join(lines + [line])


def _procedure(name, result, args, declare, bind, indent):
    kind = "subroutine" if result == "void" else "function"
    head = f"{indent}{kind} {name}({_wrap([a.name for a in args], indent)}) &\n{indent}    {bind}"
    if kind == "function":
        head += " result(status)"
    lines = [head, f"{indent}  import"] + [f"{indent}  {declare(a)}" for a in args]
    if kind == "function":
        lines.append(f"{indent}  {result} :: status")
    return lines + [f"{indent}end {kind} {name}"]


def _arrays(f):
    return [a for a in f.args if a.role in ("array_in", "array_out")]


def _has_wrapper(f):
    """Calls with arrays or strings go through a procedure of this module, which knows their lengths."""
    return any(a.role in ("string", "array_in", "array_out") for a in f.args)


def _wrapper_argument(a, lengths):
    if a.role == "string":
        return f"character(*), intent(in) :: {a.name}"
    if a.role in ("array_in", "array_out"):
        intent = "in" if a.role == "array_in" else "inout"
        return f"{TYPES[a.type.scalar][2]}, intent({intent}), target, contiguous, optional :: {a.name}(..)"
    text = fortran_type(a).replace(", value ::", ", intent(in) ::")
    if a.role in ("callback", "user"):
        return text.replace(" ::", ", optional ::")
    return text.replace(" ::", ", optional ::") if a.role == "len" and lengths == "optional" else text


def _c_argument(a):
    return f"type(c_ptr), value :: {a.name}" if a.role in ("array_in", "array_out") else fortran_type(a)


def _extent(f, a, api):
    """(what names the first extent, lines that find it)."""
    if a.name == "table":
        return "int(columns, c_size_t)", []
    last = last_extent(f, a, api)
    if last is None:
        return "0_c_size_t", []
    return f"{last}_c_size_t" if isinstance(last, int) else f"{last}_of_c", [last]


def _array_lines(f, a, api, lengths):
    """Pointer and length of one array, and what is refused."""
    extent = _extent(f, a, api)[0]
    length = f"size({a.name}, kind=c_size_t)"
    lines = [
        f"    at_{a.name} = c_null_ptr",
        f"    count_{a.name} = 0",
        f"    if (present({a.name})) then",
        f"      at_{a.name} = c_loc({a.name})",
        f"      count_{a.name} = {length}",
        "    end if",
    ]
    if lengths == "optional":
        lines.append(f"    if (present({a.name}_len)) count_{a.name} = {a.name}_len")
    elif lengths == "given":
        lines.append(f"    count_{a.name} = {a.name}_len")
    return lines + [
        f"    if (present({a.name})) then",
        f"      status = checked('{a.name}', shape({a.name}, kind=c_size_t), {extent}, count_{a.name})",
        "      if (status /= JAM_OK) return",
        "    end if",
    ]


def _wrapper(f, name, lengths, api):
    """A module procedure that hands pointers and lengths to C. lengths: 'given', 'optional' or 'none' among its arguments."""
    arrays = _arrays(f)
    args = [a for a in f.args if a.role != "len" or lengths != "none"]
    kind = "subroutine" if f.result.base == "void" else "function"
    head = f"  {kind} {name}({_wrap([a.name for a in args], '  ')})" + (" result(status)" if kind == "function" else "")
    lines = [head] + [f"    {_wrapper_argument(a, lengths)}" for a in args]
    if kind == "function":
        lines.append(f"    {_result(f.result)} :: status")
    for a in arrays:
        lines += [f"    type(c_ptr) :: at_{a.name}", f"    integer(c_size_t) :: count_{a.name}"]
    pointers = {"callback": ("type(c_funptr)", "c_null_funptr"), "user": ("type(c_ptr)", "c_null_ptr")}
    left_out = [a for a in f.args if a.role in pointers]
    lines += [f"    {pointers[a.role][0]} :: c_{a.name}" for a in left_out]
    for a in left_out:
        lines += [f"    c_{a.name} = {pointers[a.role][1]}", f"    if (present({a.name})) c_{a.name} = {a.name}"]
    needs = {letter for a in arrays for letter in _extent(f, a, api)[1] if isinstance(letter, str)}
    if needs:
        lines.append("    integer(c_size_t) :: n_of_c, d_of_c")
        if f.args[0].role == "handle":
            lines.append(f"    call sizes_of({f.args[0].name}, n_of_c, d_of_c)")
        else:  # a system that is made: its options hold the dimension
            lines += ["    n_of_c = 0", "    d_of_c = 3", "    if (present(o)) d_of_c = o%dim"]
    for a in arrays:
        lines += _array_lines(f, a, api, lengths)
    passed = {"array_in": "at_{}", "array_out": "at_{}", "string": "jam_c_string({})", "callback": "c_{}", "user": "c_{}"}
    values = [
        f"count_{a.name[:-4]}" if a.role == "len" and any(b.name == a.name[:-4] for b in arrays) else
        passed.get(a.role, "{}").format(a.name)
        for a in f.args
    ]
    lines.append(f"    {'call' if kind == 'subroutine' else 'status ='} c_{f.name}({_wrap(values, '    ')})")
    return lines + [f"  end {kind} {name}", ""]


def _forms(f):
    """(name, lengths) of the procedures behind one name. With one array its length is optional where it stands. With more,
    C's order needs all lengths, and a second form has none.
    """
    if len(_arrays(f)) < 2:
        return [(f.name, "optional")]
    return [(f"f_{f.name}", "none"), (f"l_{f.name}", "given")]


def _result(t):
    if t.stars:
        return "type(c_ptr)"
    return "void" if t.base == "void" else TYPES[t.scalar][2]


def emit(api):
    inits = api.inits
    out = [HEAD]
    for name, value in api.constants:
        out.append(f"  integer(c_int32_t), parameter :: {name} = {value}")
    for e in api.enums:
        out += [""] + _comment(f"{e.name}: {e.doc}", "  ")
        out += [f"  integer(c_int32_t), parameter :: {n} = {v}" for n, v, _ in e.items]
    for s in api.structs:
        out += [""] + _comment(s.doc, "  ")
        out.append(f"  type, bind(c) :: {s.name}")
        for m in s.members:
            size_known = m.name == "struct_size" and s.name not in inits  # options must be filled by jam_defaults
            null = {"pointer": "c_null_ptr", "callback": "c_null_funptr"}
            value = str(s.size) if size_known else null.get(m.type, "0")
            if m.doc:
                out += _comment(m.doc, "    ")
            out.append(f"    {TYPES[m.type][2]} :: {m.name} = {value}")
        out.append(f"  end type {s.name}")
    out += [
        "",
        "  ! call jam_defaults(o) fills any option type with the defaults of the library.",
        "  interface jam_defaults",
        f"    module procedure {_wrap(['default_' + n[4:] for n in inits], '    ')}",
        "  end interface jam_defaults",
    ]
    out += ["", "  abstract interface"]
    for c in api.callbacks:
        out += _comment(c.doc, "    ") + _procedure(c.name, _result(c.result), c.args, _callback_arg, "bind(c)", "    ")
    out += ["  end interface", "", "  interface"]
    wrapped = [f for f in api.functions if _has_wrapper(f)]
    for f in api.functions:
        if f not in wrapped and f.name not in BY_HAND:
            out += [""] + _comment(f.doc, "    ")
            out += _procedure(f.name, _result(f.result), f.args, fortran_type, f'bind(c, name="{f.name}")', "    ")
    out += ["", "  ! What the procedures of this module call."]
    for f in [f for f in api.functions if f in wrapped or f.name in BY_HAND]:
        out += _procedure(f"c_{f.name}", _result(f.result), f.args, _c_argument, f'bind(c, name="{f.name}")', "    ")
    out += ["  end interface"]
    for f in wrapped:
        if len(_forms(f)) > 1:
            out += [""] + _comment(f.doc, "  ") + [f"  interface {f.name}"]
            out += [f"    module procedure {name}" for name, _ in _forms(f)] + [f"  end interface {f.name}"]
    for f in [f for f in api.functions if f.name in BY_HAND]:
        out += [""] + _comment(f.doc, "  ")
        out += [f"  interface {f.name}", f"    procedure c_{f.name}", f"    procedure {BY_HAND[f.name]}"]
        out += [f"  end interface {f.name}"]
    # gfortran warns where a subroutine of C is private
    hidden = ["sizes_of", "checked"] + [f"c_{f.name}" for f in wrapped if f.result.base != "void"]
    hidden += [name for raw, own in BY_HAND.items() for name in (f"c_{raw}", own)]
    hidden += [name for f in wrapped for name, _ in _forms(f) if name != f.name]
    out += [""] + [f"  private :: {name}" for name in hidden]
    out += [TAIL]
    for f in wrapped:
        if len(_forms(f)) == 1:
            out += _comment(f.doc, "  ")
        for name, lengths in _forms(f):
            out += _wrapper(f, name, lengths, api)
    for s, init in inits.items():
        out += [
            f"  subroutine default_{s[4:]}(o)",
            f"    type({s}), intent(out) :: o",
            "    integer(c_int32_t) :: status",
            f"    status = {init}(o, c_sizeof(o))",
            f"  end subroutine default_{s[4:]}",
            "",
        ]
    out.append("end module jam")
    return "\n".join(line for block in out for line in block.rstrip("\n").split("\n")) + "\n"

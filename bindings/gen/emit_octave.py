"""SWIG input of Octave's module: words, members of structs, and a function for each call out of the parts of call.hpp."""
from annotations import HeaderError, columns_of
from emit_js import nested
from emit_julia_calls import is_index
from juliadoc import word_of
from model import TYPES, item_names

# In jam.i and call.hpp: packings as such, progress, texts of errors and reports.
BY_HAND = {"jam_destroy", "jam_view", "jam_set_progress", "jam_set_log", "jam_set_error", "jam_last_error", "jam_check_text",
           "jam_proof_text", "jam_status_string", "jam_stop_string"}
KINDS = {"double": "d", "int32_t": "i", "uint32_t": "u", "int64_t": "l", "uint64_t": "L"}
START = {"positions": ("n", "d"), "diameters": ("n",), "cell": ("d", "d")}  # arrays of jam_start


def octave_name(f):
    name = f.name.removeprefix("jam_").removeprefix("get_")
    return {"check_packing": "check", "diameters": "draw_diameters", "set_cell": "set_cell"}.get(name, name)


def _list(texts):
    return "{" + ", ".join(f'"{t}"' for t in texts) + "}"


def _words(api):
    for e in api.enums:
        items = ", ".join(f'{{"{word_of(n)}", {v}}}' for n, (_, v, _) in zip(item_names(e), e.items))
        yield f"static const Word words_{e.name}[] = {{{items}, {{nullptr, 0}}}};"
    for s in api.structs:
        if not s.has_pointers:
            rows = [f'{{"{m.name}", \'{"w" if m.enum else "b" if m.bool else KINDS[m.type]}\', offsetof({s.name}, {m.name}), '
                    f'{"words_" + m.enum if m.enum else "nullptr"}}}' for m in s.shown]
            yield f"static const Member members_{s.name}[] = {{{', '.join(rows)}, {{nullptr, 0, 0, nullptr}}}};"
    yield "const Word *const status_words = words_jam_status_code;\nconst Member *const progress_members = members_jam_progress;"


class Call:
    """Lines of the function of one call: what it declares, what it passes to C and what it gives back."""

    def __init__(self, f, api):
        self.f, self.api, self.inits, self.nested = f, api, api.inits, nested(f, api)
        self.lines, self.passed, self.given, self.fills = [], ["sys"] if f.on_system else [], [], []
        self.place, self.more = 0, []
        self.plain, self.changes = f.plain, f.changes
        for a in f.given:
            getattr(self, "_" + a.role)(a)

    def _next(self):
        self.place += 1
        return f"g.plain({self.place - 1})"

    def _scalar(self, a):
        value, index = self._next(), " - 1" if is_index(self.f, a) else ""
        if a.name in self.f.enums:
            made = f'{value}.is_defined() ? number_of(words_{self.f.enums[a.name]}, {value}, "{a.name}") : 0'
        elif a.name in self.f.bools:
            made = f'{value}.is_defined() && flag({value}, "{a.name}")'
        elif a.type.scalar == "double":
            made = f'{value}.is_defined() ? real({value}, "{a.name}") : 0'
        else:
            made = f'{value}.is_defined() ? whole<{a.type.scalar}>({value}, "{a.name}"){index} : 0'
        self.lines.append(f"const {a.type.scalar} {a.name} = {made};")
        self.passed.append(a.name)

    def _string(self, a):
        value = self._next()
        self.lines.append(f'const std::string {a.name} = {value}.is_defined() ? {value}.xstring_value("{a.name} must be a text") : "";')
        self.passed.append(f"{value}.is_defined() ? {a.name}.c_str() : nullptr")

    def _handle(self, a):
        self.lines.append(f'jam_system *const {a.name} = packing_of({self._next()}, "{a.name}");')
        self.passed.append(a.name)

    def _array_in(self, a):
        index = str(is_index(self.f, a)).lower()
        self.lines.append(f'const In<{a.type.scalar}> {a.name}(g, {self._next()}, "{a.name}", {_list(self.f.shapes[a.name])}, {index});')
        self.passed += [f"{a.name}.data()", f"{a.name}.size()"]

    def _struct_in(self, a):
        apart, base = self.nested.get(a.name), a.type.base
        name = f', "{base.removeprefix("jam_").removesuffix("_options")}"' if apart else ""
        self.more += [base.removeprefix("jam_").removesuffix("_options")] if apart else []
        self.lines.append(f"Options<{base}> {a.name}(g, members_{base}, {self.inits[base]}{name});")
        self.passed.append(f"&{a.name}.c")

    def _start(self, a):
        self.more += [*START]
        for name, extents in START.items():
            self.lines.append(f'const In<double> {name}(g, g.take_start("{name}", o.c.dim, o.c.n), "{name}", {_list(extents)}, false);')
        members = ", ".join(f"{name}.data(), {name}.size()" for name in START)
        self.lines.append(f"const jam_start start = {{sizeof start, 0, {members}, Given::on_progress, g.user()}};")
        self.passed.append("&start")

    def _columns(self, a):
        self.passed.append(str(len(columns_of(self.f, self.api).items)))

    def _array_out(self, a):
        if a.type.base not in TYPES:
            raise HeaderError(f"{self.f.name}: arrays of structs have no rule in Octave yet")
        table = columns_of(self.f, self.api) if a.name == "table" else None
        extents = [str(len(table.items)) if e == getattr(table, "name", None) else e for e in self.f.shapes[a.name]]
        index = str(a.type.scalar != "char" and not table and is_index(self.f, a)).lower()
        self.lines.append(f"Out<{a.type.scalar}> {a.name}({_list(extents)}, {index});")
        self.passed += [f"{a.name}.data()", f"{a.name}.size()"]
        self.fills.append(a.name)
        columns = _list(n.lower() for n in item_names(table)) if table else ""
        self.given.append(f"{a.name}.table({columns})" if table else f"{a.name}.text()" if a.type.scalar == "char" else f"{a.name}.value()")

    def _struct_out(self, a):
        base = a.type.base
        if base in self.inits:
            self.lines.append(f"{base} {a.name};\n  {self.inits[base]}(&{a.name}, sizeof {a.name});")
            self.given.append(f"map_of(&{a.name}, members_{base})")
        else:
            sized = self.api.struct(base).members[0].name == "struct_size"
            self.lines.append(f"{base} {a.name} = {{}};" + (f"\n  {a.name}.struct_size = sizeof {a.name};" if sized else ""))
            self.given.append(f"g.reported(&{a.name}, members_{base}, text_of({a.name}))")
        self.passed.append(f"&{a.name}")

    def _scalar_out(self, a):
        self.lines.append(f"{a.type.scalar} {a.name} = 0;")
        self.passed.append(f"&{a.name}")
        if a.name not in ("needed", "rows"):
            self.given.append(f"static_cast<double>({a.name})")

    def _new_handle(self, a):
        self.lines.append(f"jam_system *{a.name} = nullptr;")
        self.passed.append(f"&{a.name}")
        self.given.append(f"made({a.name})")

    def _callback(self, a):
        self.passed.append("&Given::on_progress")

    def _user(self, a):
        self.passed.append("g.user()")

    def _len(self, a):
        pass  # passed with its array

    def needed(self):
        """How many plain arguments a call needs: the last ones may be left out where they are arrays, enums or flags."""
        last = len(self.plain)
        while last and (self.plain[last - 1].role == "array_in" or self.plain[last - 1].name in [*self.f.enums, *self.f.bools, *self.f.optional]):
            last -= 1
        return last

    def text(self):
        f = self.f
        takes = self.changes or {"callback", "start"} & {a.role for a in f.args}
        structs = ", ".join(f"members_{a.type.base}" for a in f.args if a.role == "struct_in" and not self.nested.get(a.name))
        head = (f'Given g("{octave_name(f)}", sys, in, {_list(a.name for a in self.plain)}, {self.needed()}, {{{structs}}}, '
                f"{_list(self.more + ['progress'] * bool(takes))});")
        call = f"[&] {{ return {f.name}({', '.join(self.passed)}); }}"
        changes = str(self.changes).lower()
        if self.fills and f.counter:
            counter = f.counter.name
            run = f"g.fill({changes}, {call}, {counter}, {str(counter == 'rows').lower()}, {{{', '.join('&' + n for n in self.fills)}}});"
        else:
            run = f"g.run({changes}, {call});"
        report = any(a.role == "struct_out" and a.type.base not in self.inits for a in f.args)
        lines = [head, *self.lines, run, *["g.without_report();"] * (not report), f"octave_value_list out_;",
                 *(f"out_.append(octave_value({value}));" for value in self.given), "return out_;"]
        return f"static octave_value_list call_{octave_name(f)}(jam_system *sys, const octave_value_list &in) {{\n  " + "\n  ".join(lines) + "\n}"


def calls(api):
    """Of each function its Call, or None where it gives a text or a number as it is."""
    inits = api.inits.values()
    return [(f, Call(f, api) if f.result.base == "jam_status" else None)
            for f in api.functions if f.name not in BY_HAND and f.name not in inits]


def emit(api):
    made = calls(api)
    out = ["// Generated by bindings/gen/generate.py from include/jam/jam.h. Do not edit.", "%{", "namespace jam_octave {", *_words(api)]
    out += [c.text() for _, c in made if c]
    out += ["}  // namespace jam_octave", "%}"]
    methods, free = [], []
    for f, call in made:
        name = octave_name(f)
        if not call:
            given = "" if not f.on_system else "$self"
            body = f"{{ return octave_value_list(octave_value({f.name}({given}))); }}"
            (methods if f.on_system else free).append(f"octave_value_list {name}() {body}")
        elif f.on_system:
            methods.append(f"octave_value_list {name}(const octave_value_list &varargs = octave_value_list(), ...) {{ return jam_octave::call_{name}($self, varargs); }}")
        else:
            free.append(f"octave_value_list {name}(const octave_value_list &varargs = octave_value_list(), ...) {{ return jam_octave::call_{name}(nullptr, varargs); }}")
    out += ["%extend jam_system {", *("  " + m for m in methods), "}", "%inline %{", *("static " + m for m in free), "%}"]
    return "\n".join(out) + "\n"

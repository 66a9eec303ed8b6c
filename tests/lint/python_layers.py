"""Directions of imports in bindings/python/jam, those inside functions too: bindings/README.md has the layers."""
import ast

# A module imports only from layers to the left of its own; within a folder no module leads back to itself.
ORDER = (
    "raw _built_for _interrupted _api errors _formats _system system files store ensemble advice statistics _tails scaling "
    "near_jamming digits _symmetry _sum_proof radii _search plot cli __main__ __init__"
).split()
# Third-party modules besides numpy: the modules that import them, where a layer below must work without. Those in a
# folder's name may do so at once, the others inside functions only.
AT_ONCE = {"h5py": ("_formats/seal.py", "_formats/records.py", "_formats/write_packing.py")}
STANDARD_AND_NUMPY = "numpy"


def modules(folder):
    """{dotted name: path}; a package has the name of its folder."""
    found = {}
    for path in sorted(folder.rglob("*.py")):
        parts = list(path.relative_to(folder).with_suffix("").parts)
        found[".".join(parts if parts[-1] != "__init__" or len(parts) == 1 else parts[:-1])] = path
    return found


def imports(name, path, known):
    """(line, target, inside a function) of every import; a target outside of the package has no dot before it."""
    tree = ast.parse(path.read_text())
    inside = {id(x) for f in ast.walk(tree) if isinstance(f, (ast.FunctionDef, ast.Lambda)) for x in ast.walk(f)}
    here = name.split(".") if path.name == "__init__.py" and name != "__init__" else name.split(".")[:-1]
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level:
            base = here[: len(here) - node.level + 1] + (node.module.split(".") if node.module else [])
            for alias in node.names:
                whole = ".".join([*base, alias.name])
                yield node.lineno, "." + (whole if whole in known or not base else ".".join(base)), id(node) in inside
        elif isinstance(node, ast.ImportFrom):
            yield node.lineno, node.module.split(".")[0], id(node) in inside
        elif isinstance(node, ast.Import):
            for alias in node.names:
                yield node.lineno, alias.name.split(".")[0], id(node) in inside


def circles(edges):
    """Names that lead back to themselves."""

    def reached(start):
        seen, left = set(), list(edges.get(start, ()))
        while left:
            name = left.pop()
            if name not in seen:
                seen.add(name)
                left += edges.get(name, ())
        return seen

    return sorted(name for name in edges if name in reached(name))


def check(folder, standard, problem):
    """Calls problem(path, line, text) for each violation; standard: names of the standard library. Returns the imports."""
    known, edges = modules(folder), {}
    rank = {layer: k for k, layer in enumerate(ORDER)}
    for name, path in known.items():
        layer = name.split(".")[0]
        if layer not in rank:
            problem(path, 0, f"{layer} is no layer of bindings/README.md")
            continue
        for line, target, lazy in imports(name, path, known):
            if target.startswith("."):
                to = target[1:].split(".")[0]
                if to not in rank:
                    problem(path, line, f"{target} is no layer of bindings/README.md")
                elif rank[to] > rank[layer]:
                    problem(path, line, f"{layer} must not import {to}, which stands above it")
                edges.setdefault(name, set()).add(target[1:])
            elif target == "jam":
                problem(path, line, "the package's own modules are imported by relative names")
            elif target not in standard and target != STANDARD_AND_NUMPY and not lazy:
                if str(path.relative_to(folder)) not in AT_ONCE.get(target, ()):
                    problem(path, line, f"{target} is imported inside the function that needs it")
        for node in ast.walk(ast.parse(path.read_text())):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == "setattr":
                if path.name != "options.py":  # which fills structs of C by their members' names
                    problem(path, node.lineno, "setattr: a class is what its source says")
            if isinstance(node, ast.Subscript) and isinstance(node.value, ast.Call):
                if isinstance(node.value.func, ast.Name) and node.value.func.id == "globals":
                    problem(path, node.lineno, "globals(): a module holds what its source says")
    for name in circles(edges):
        problem(known[name], 0, f"{name} imports itself by way of others")
    return edges

"""Implied contacts of proof files in d = 2. jamproof.py loads this file for a packing with lines `tile` and `implied`.

More contacts than unknowns all close only if algebra gives a reason. Here it is that some follow from the others, which
Theorem A closes. Words of the file, contacts numbered from 0:

    tile c1 c2 c3 [c4]    round a triangle with two equal sides, or a parallelogram: directions of its sides are related
    implied c p1 .. pm    the contact c closes a walk over p1 .. pm (m = 2, 3), which adds up to one vector of its length

The relations are true while the contacts are closed and the tile is convex, as it is within the radius of Theorem A.
An angle is {name: whole number}. The name () is 60 degrees; (p, q) is the angle at the base of a triangle with sides
p, p, q. Of vectors of equal length, those whose directions differ by 60 degrees add up in the ring Z[exp(i pi / 3)].
"""
from jamproof import refuse

CONVEX = 2000  # sines of the corners of a tile exceed 1 / CONVEX; no contact vector moves by a millionth of a diameter
SIXTHS = ((1, 0), (0, 1), (-1, 1), (-1, 0), (0, -1), (1, -1))  # exp(i k pi / 3) = a + b exp(i pi / 3)


def plus(a, b, times=1):
    """The angle a + times b; six times 60 degrees are none."""
    total = {name: a.get(name, 0) + times * b.get(name, 0) for name in {**a, **b}}
    total[()] = total.get((), 0) % 6
    return {name: times for name, times in total.items() if times}


def walk(s, ring):
    """The contacts of a walk as (contact, half turn or none, vector); where it leads, with the sum of images."""
    ends = [s.contacts[c][:2] for c in ring]
    at = start = ends[0][0] if ends[0][1] in ends[1] else ends[0][1]
    sides, image = [], [0] * s.dim
    for c, (i, j) in zip(ring, ends):
        sign, n = 1 if at == j else -1, s.contacts[c][2]
        refuse(at not in (i, j), f"excess: contact {c} does not go on from sphere {at}")
        at, image = i if sign > 0 else j, [a + sign * b for a, b in zip(image, n)]
        sides.append((c, {(): (1 - sign) // 2 * 3}, [sign * v for v in s.vector(i, j, n)]))
    return sides, (start, at, tuple(image))


def relate(turned, p, q, angle):
    """The direction of side q is that of p and an angle: {contact: (root, angle to it)}."""
    (a, x), (b, y) = (turned.setdefault(c, (c, {})) for c, *_ in (p, q))
    angle = plus(plus(plus(angle, p[1]), x), plus(q[1], y), -1)
    if a != b:
        turned.update({c: (a, plus(z, angle)) for c, (root, z) in turned.items() if root == b})


def lay(s, turned, ring, length):
    """The angles of a tile: a parallelogram, or a triangle with two equal sides."""
    sides, (start, end, image) = walk(s, ring)
    size, corners = len(sides), []
    for (_, _, u), (_, _, v) in zip(sides, sides[1:] + sides[:1]):
        cross, squares = u[0] * v[1] - u[1] * v[0], sum(x * x for x in u) * sum(x * x for x in v)
        corners.append((cross > 0) - (cross < 0) if (CONVEX * cross) ** 2 > squares else 0)
    wrong = start != end or any(image) or set(corners) not in ({1}, {-1})
    refuse(wrong, "excess: a tile is not closed and convex")
    sigma = [length[c] for c in ring]
    if size == 4 and sigma[:2] == sigma[2:]:
        for p, q in (sides[0], sides[2]), (sides[1], sides[3]):
            relate(turned, p, q, {(): 3})
    refuse(size == 4 and sigma[:2] != sigma[2:], "excess: a tile is no triangle and no parallelogram")
    for k in range(2 if size == 3 else 0):
        p, q, opposite = (sigma[(k + m) % 3] for m in range(3))
        refuse(len({p, q, opposite}) == 3, "excess: three unequal sides")
        if p == q:  # 180 degrees less the angle between them
            outer = {(): 2} if opposite == p else {(p, opposite): 2}
        else:
            outer = {(): 3, (opposite, p if opposite == q else q): -1}
        relate(turned, sides[k], sides[k + 1], plus({}, outer, corners[0]))


def kept_contacts(s):
    """The contacts but those that the others imply."""
    implied, turned = {ring[0] for word, ring in s.tiles if word == "implied" and ring}, {}
    known = set(range(len(s.contacts))) - implied
    length = [s.sigma2(i, j) for i, j, _ in s.contacts]
    for word, ring in s.tiles:
        wrong = s.dim != 2 or not 3 <= len(ring) <= 4 or not known.issuperset(ring if word == "tile" else ring[1:])
        refuse(wrong, f"excess: {word} {ring} does not rest on known contacts")
        if word == "tile":
            lay(s, turned, ring, length)
            continue
        (i, j, n), (sides, leads), total = s.contacts[ring[0]], walk(s, ring[1:]), {}
        wrong = leads not in ((j, i, n), (i, j, tuple(-v for v in n)))
        refuse(wrong, f"excess: the walk of contact {ring[0]} leads elsewhere")
        for c, half, _ in sides:
            root, angle = turned.get(c, (c, {}))
            angle = plus(angle, half)
            key = root, length[c], frozenset((name, times) for name, times in angle.items() if name)
            total[key] = [x + y for x, y in zip(total.get(key, (0, 0)), SIXTHS[angle.get((), 0)])]
        left = [(size, a * a + a * b + b * b) for (_, size, _), (a, b) in total.items() if a or b]
        refuse(left != [(length[ring[0]], 1)], f"excess: contact {ring[0]} does not follow")
        known.add(ring[0])
    return sorted(known - implied)

"""Dimensions that the library under test has."""
import jam


def compiled(*dimensions):
    """Those of `dimensions` that are compiled in."""

    def has(dim):
        try:
            return jam.System.random(n=2, dim=dim, seed=1).dim == dim
        except jam.JamError:
            return False

    return [dim for dim in dimensions if has(dim)]

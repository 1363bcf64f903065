"""How runs of the program end whose work is done (docs/guide/command_line.md)."""

CONVERGED, TOO_SMALL, ABOVE_LIMIT, WARNED = 0, 2, 5, 6
DONE = (CONVERGED, ABOVE_LIMIT, WARNED)

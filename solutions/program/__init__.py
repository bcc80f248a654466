"""One traced program per chain: the walk along it, and the code that comes of it."""

"""One traced program per chain: the walk along it, without zeros and ones, and the code that comes of it."""

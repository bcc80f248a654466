"""Exercise files: found, read with their neighbours, loaded."""

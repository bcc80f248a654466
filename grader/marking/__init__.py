"""From readable answers to verdicts: tolerance, names, what follows from own answers."""

"""From readable answers to verdicts: tolerance, findings, what follows from a student's own answers."""

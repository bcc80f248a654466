"""Whether a variant tells right from wrong: mistakes, printed numbers, special postures."""

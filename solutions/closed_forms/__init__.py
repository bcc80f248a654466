"""Closed forms: polynomials in sines and cosines, and what they factor into."""

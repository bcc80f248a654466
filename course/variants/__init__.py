"""A student's personal numbers: drawn from the secret, recorded, and named by a code."""

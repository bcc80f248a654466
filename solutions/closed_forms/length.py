"""What is too long: counted in terms, so that the answer is the same on every machine."""


class TooLong(Exception):
    """A Jacobian, a determinant or a polynomial to factor of too many terms."""

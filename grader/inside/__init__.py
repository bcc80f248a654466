"""What stands in the student's process: the standard library, numpy and sympy, nothing of ours."""

"""What students type, read without ever being run: formulas, matrices, equations, quantities."""

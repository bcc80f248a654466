"""Where notebooks run: walls around a process that starts one process a notebook."""

"""This machine: files written whole, processes, the terminal, what is kept between runs."""
